#include "server/emulator/emulator_server.hpp"

#include <array>
#include <thread>

#include <boost/asio/connect.hpp>
#include <boost/asio/write.hpp>

#include "server/drivers/emulator/emulator_devices.hpp"
#include "tests/support/net/chaos_proxy.hpp"
#include "tests/unit/server/emulator/worlds.hpp"

namespace seeker::emulator {
namespace {

using namespace std::chrono_literals;
using testing::two_robots;

/// A served world, until the end of the test.
class Served {
 public:
  explicit Served(std::uint16_t wanted_port = 0, std::uint64_t world_id = 1)
      : host_(two_robots(), {.world_id = world_id}), server_(host_, {.port = wanted_port}) {
    const Result<std::uint16_t> opened = server_.listen();
    EXPECT_TRUE(opened);
    port = opened.value_or(0);
    thread_ = std::thread([this] { server_.run(); });
  }
  ~Served() {
    server_.stop();
    thread_.join();
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  std::uint16_t port = 0;

 private:
  WorldHost host_;
  EmulatorServer server_;
  std::thread thread_;
};

drivers::EmulatorParams params_of(std::uint16_t port, std::uint32_t robot) {
  drivers::EmulatorParams params;
  params.port = port;
  params.robot = robot;
  params.retry_period = 5ms;
  params.max_retry_period = 20ms;
  return params;
}

std::shared_ptr<drivers::EmulatorLink> link_to(std::uint16_t port, std::uint32_t robot) {
  auto link = drivers::EmulatorLink::connect(params_of(port, robot));
  EXPECT_TRUE(link) << link.error().message;
  return *link;
}

/// Finishes a tick and waits for the next one.
void next_tick(drivers::Clock& clock) {
  EXPECT_TRUE(clock.advance(100ms));
  for (;;) {
    const Result<bool> there = clock.await(100ms);
    ASSERT_TRUE(there) << there.error().message;
    if (*there) {
      return;
    }
  }
}

struct Seen {
  std::vector<LaserScan> scans;
  std::vector<SonarScan> sonars;
  std::vector<drivers::OdometrySample> odometry;
  friend bool operator==(const Seen&, const Seen&) = default;
};

template <class Parts>
Seen drive(Parts& robot, int ticks, double omega_rad_s) {
  Seen seen;
  EXPECT_TRUE(robot.base->activate());
  EXPECT_TRUE(robot.lidar->activate());
  EXPECT_TRUE(robot.sonar->activate());
  EXPECT_TRUE(robot.base->set_motors(true));
  for (int i = 0; i < ticks; ++i) {
    seen.odometry.push_back(robot.base->read().value().value());
    seen.scans.push_back(robot.lidar->read().value().value());
    seen.sonars.push_back(robot.sonar->read().value().value());
    EXPECT_TRUE(robot.base->set_velocity({0.4, omega_rad_s}, robot.clock->now()));
    next_tick(*robot.clock);
  }
  robot.clock->let_go();
  return seen;
}

TEST(EmulatorServer, OverTheWireItIsTheSameRunAsInOneProcess) {
  std::array<Seen, 2> remote;
  {
    const Served served;
    std::thread other([&] {
      drivers::EmulatorDevices devices = drivers::make_emulator_devices(link_to(served.port, 1));
      remote[1] = drive(devices, 20, -0.3);
    });
    drivers::EmulatorDevices devices = drivers::make_emulator_devices(link_to(served.port, 0));
    remote[0] = drive(devices, 30, 0.2);
    other.join();
  }
  drivers::SharedDevices local = two_robots();
  std::array<Seen, 2> here;
  std::thread other([&] { here[1] = drive(local.robots[1], 20, -0.3); });
  here[0] = drive(local.robots[0], 30, 0.2);
  other.join();
  EXPECT_EQ(remote[0], here[0]);
  EXPECT_EQ(remote[1], here[1]);
}

TEST(EmulatorServer, PicturesTravel) {
  const Served served;
  drivers::EmulatorDevices devices = drivers::make_emulator_devices(link_to(served.port, 0));
  EXPECT_EQ(devices.camera->grab().error().code, Errc::kNotReady);
  ASSERT_TRUE(devices.camera->activate());
  ASSERT_TRUE(devices.stereo->activate());
  const Result<CameraFrame> omni = devices.camera->grab();
  ASSERT_TRUE(omni);
  EXPECT_EQ(omni->image.width_px(), sim::OmniModel{}.width_px);
  const Result<StereoFrame> pair = devices.stereo->grab();
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->left.width_px(), devices.stereo->geometry().width_px);
  EXPECT_NE(pair->left, pair->right);
}

TEST(EmulatorServer, RefusalsReachTheRobot) {
  const Served served;
  const auto first = link_to(served.port, 0);
  EXPECT_EQ(drivers::EmulatorLink::connect(params_of(served.port, 0)).error().code, Errc::kBusy);
  const auto refused = drivers::EmulatorLink::connect(params_of(served.port, 5));
  EXPECT_EQ(refused.error().code, Errc::kNotFound);
  EXPECT_NE(refused.error().message.find("there is no 5"), std::string::npos) << refused.error().message;
}

TEST(EmulatorServer, ARobotWhoseProgramEndsIsNotWaitedFor) {
  const Served served;
  drivers::EmulatorDevices stays = drivers::make_emulator_devices(link_to(served.port, 0));
  { const auto goes = link_to(served.port, 1); }
  next_tick(*stays.clock);
  const auto again = link_to(served.port, 1);
  EXPECT_GE(again->now(), RobotTime() + 100ms);
}

void send_raw(std::uint16_t port, const std::string& bytes) {
  boost::asio::io_context io;
  boost::asio::ip::tcp::socket socket(io);
  socket.connect({boost::asio::ip::make_address("127.0.0.1"), port});
  boost::asio::write(socket, boost::asio::buffer(bytes));
  // Whatever the emulator makes of it, it ends the connection.
  std::array<char, 256> rest{};
  boost::system::error_code ended;
  while (!ended) {
    socket.read_some(boost::asio::buffer(rest), ended);
  }
}

TEST(EmulatorServer, HostileBytesHarmNobody) {
  const Served served;
  drivers::EmulatorDevices robot = drivers::make_emulator_devices(link_to(served.port, 0));
  drivers::EmulatorDevices other = drivers::make_emulator_devices(link_to(served.port, 1));
  other.clock->let_go();
  send_raw(served.port, std::string("\xff\xff\xff\xff", 4) + std::string(5000, 'x'));  // too large a frame
  send_raw(served.port, std::string("\0\0\0\x04zzzz", 8));                             // no message
  send_raw(served.port, std::string("\0\0\0\0", 4));                                   // an empty one: no hello
  send_raw(served.port, "GET / HTTP/1.1\r\n\r\n");
  next_tick(*robot.clock);
  EXPECT_EQ(robot.clock->now(), RobotTime() + 100ms);
}

TEST(EmulatorLink, ComesBackAfterACut) {
  const Served served;
  seeker::testing::ChaosProxy proxy(served.port);
  drivers::EmulatorDevices robot = drivers::make_emulator_devices(link_to(proxy.port(), 0));
  drivers::EmulatorDevices other = drivers::make_emulator_devices(link_to(served.port, 1));
  ASSERT_TRUE(robot.base->activate());
  other.clock->let_go();
  next_tick(*robot.clock);
  EXPECT_TRUE(robot.clock->reachable());
  proxy.cut();
  while (robot.base->read()) {
  }
  EXPECT_EQ(robot.clock->reachable().error().code, Errc::kLinkLost);
  next_tick(*robot.clock);  // is cut, connects again, and is in the same world
  next_tick(*robot.clock);
  EXPECT_GE(robot.clock->now(), RobotTime() + 200ms);
  EXPECT_TRUE(robot.base->read()) << "its devices are as they were";
}

TEST(EmulatorLink, DoesNotGoOnInAnotherWorld) {
  auto served = std::make_unique<Served>(0, 1);
  const std::uint16_t port = served->port;
  drivers::EmulatorDevices robot = drivers::make_emulator_devices(link_to(port, 0));
  served.reset();
  const Served again(port, 2);
  ASSERT_TRUE(robot.clock->advance(100ms));
  Result<bool> there = false;
  while (there && !*there) {
    there = robot.clock->await(100ms);
  }
  ASSERT_FALSE(there);
  EXPECT_EQ(there.error().code, Errc::kCancelled);
  EXPECT_EQ(robot.clock->reachable().error().code, Errc::kCancelled);
}

TEST(EmulatorLink, SaysWhatToStartWhereNobodyAnswers) {
  std::uint16_t port = 0;
  {
    const Served served;
    port = served.port;
  }
  const auto link = drivers::EmulatorLink::connect(params_of(port, 0));
  ASSERT_FALSE(link);
  EXPECT_NE(link.error().message.find("start seeker-emulator"), std::string::npos) << link.error().message;
}

}  // namespace
}  // namespace seeker::emulator
