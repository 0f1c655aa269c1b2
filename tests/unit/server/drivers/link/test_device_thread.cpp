#include "server/drivers/link/device_thread.hpp"

#include <condition_variable>

#include <gtest/gtest.h>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

namespace seeker::drivers {
namespace {

using boost::asio::ip::tcp;

/// Greets with one byte, repeats what it hears, and says farewell with another. All calls come under the lock of its
/// thread.
class EchoSession final : public DeviceSession {
 public:
  static constexpr std::uint8_t kGreeting = 0x01;
  static constexpr std::uint8_t kFarewell = 0x02;
  static constexpr std::uint8_t kGiveUp = 0xFF;

  void open(RobotTime now) override {
    ++statistics_.connects;
    opened_at_ = now;
    gave_up_ = false;
    actions_ = {SetBaud{19200}, WriteBytes{{kGreeting}}};
  }
  void receive(std::span<const std::uint8_t> bytes, RobotTime /*now*/) override {
    statistics_.bytes_in += bytes.size();
    gave_up_ = bytes.back() == kGiveUp;
    actions_.emplace_back(WriteBytes{{bytes.begin(), bytes.end()}});
  }
  void pass(RobotTime now) override {
    passed_ = true;
    wake_ = now + std::chrono::hours(1);
  }
  [[nodiscard]] RobotTime wake() const override { return wake_; }
  [[nodiscard]] std::vector<LineAction> take_actions() override { return std::exchange(actions_, {}); }
  void close(RobotTime /*now*/) override { actions_.emplace_back(WriteBytes{{kFarewell}}); }
  [[nodiscard]] Status state() const override {
    return gave_up_ ? fail(Errc::kLinkLost, "it gave up; ask it again") : Status();
  }
  [[nodiscard]] bool wants_reopen() const override { return gave_up_; }
  [[nodiscard]] LinkStatistics statistics() const override { return statistics_; }

  void say(std::uint8_t byte) { actions_.emplace_back(WriteBytes{{byte}}); }
  void wake_at(RobotTime when) { wake_ = when; }
  [[nodiscard]] bool passed() const { return passed_; }

 private:
  std::vector<LineAction> actions_;
  RobotTime opened_at_;
  RobotTime wake_ = robot_time_s(1e6);
  bool passed_ = false;
  bool gave_up_ = false;
  LinkStatistics statistics_;
};

/// A device on a TCP port of this computer.
class Device {
 public:
  tcp::socket accept() { return acceptor_.accept(); }
  [[nodiscard]] DeviceThreadParams params() const {
    DeviceThreadParams params;
    params.line = {"", "127.0.0.1", acceptor_.local_endpoint().port()};
    params.first_reopen = std::chrono::milliseconds(1);
    params.longest_reopen = std::chrono::milliseconds(5);
    return params;
  }
  void close() { acceptor_.close(); }

 private:
  boost::asio::io_context io_{1};
  tcp::acceptor acceptor_{io_, tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0)};
};

std::uint8_t read_byte(tcp::socket& socket) {
  std::array<std::uint8_t, 1> byte{};
  boost::asio::read(socket, boost::asio::buffer(byte));
  return byte[0];
}

void write_byte(tcp::socket& socket, std::uint8_t byte) { boost::asio::write(socket, boost::asio::buffer(&byte, 1)); }

RobotTime now() {
  static const auto kStart = std::chrono::steady_clock::now();
  return RobotTime(std::chrono::steady_clock::now() - kStart);
}

struct DeviceThreadTest : testing::Test {
  Device device;
  std::shared_ptr<EchoSession> session = std::make_shared<EchoSession>();
  DeviceThread thread{"device", device.params(), session, now};
};

TEST_F(DeviceThreadTest, CarriesBytesBothWaysAndSaysFarewell) {
  thread.start();
  tcp::socket host = device.accept();
  EXPECT_EQ(read_byte(host), EchoSession::kGreeting);
  write_byte(host, 0x42);
  EXPECT_EQ(read_byte(host), 0x42);
  EXPECT_TRUE(thread.state());
  EXPECT_EQ(thread.statistics().bytes_in, 1U);
  thread.stop();
  EXPECT_EQ(read_byte(host), EchoSession::kFarewell);
}

TEST_F(DeviceThreadTest, CarriesOutWhatIsWantedFromAnotherThreadAtOnce) {
  thread.start();
  tcp::socket host = device.accept();
  EXPECT_EQ(read_byte(host), EchoSession::kGreeting);
  thread.with([&] { session->say(0x77); });
  EXPECT_EQ(read_byte(host), 0x77);
}

TEST_F(DeviceThreadTest, ServesTheSessionsTimers) {
  thread.start();
  tcp::socket host = device.accept();
  EXPECT_EQ(read_byte(host), EchoSession::kGreeting);
  thread.with([&] { session->wake_at(now() + std::chrono::milliseconds(20)); });
  while (!thread.look([&] { return session->passed(); })) {
    std::this_thread::yield();
  }
}

TEST_F(DeviceThreadTest, OpensALineAgainThatTheOtherSideClosed) {
  thread.start();
  {
    tcp::socket host = device.accept();
    EXPECT_EQ(read_byte(host), EchoSession::kGreeting);
  }
  tcp::socket again = device.accept();
  EXPECT_EQ(read_byte(again), EchoSession::kGreeting);
  EXPECT_EQ(thread.statistics().connects, 2U);
}

TEST_F(DeviceThreadTest, OpensALineAgainThatTheSessionGaveUp) {
  thread.start();
  tcp::socket host = device.accept();
  EXPECT_EQ(read_byte(host), EchoSession::kGreeting);
  write_byte(host, EchoSession::kGiveUp);
  tcp::socket again = device.accept();
  EXPECT_EQ(read_byte(again), EchoSession::kGreeting);
}

TEST_F(DeviceThreadTest, SaysWhyThereIsNoLine) {
  device.close();
  thread.start();
  std::string why;
  while (why.find("no device answers at tcp://127.0.0.1:") == std::string::npos) {
    const Status state = thread.state();
    ASSERT_FALSE(state);
    why = state.error().message;
  }
}

TEST_F(DeviceThreadTest, StartsAgainAfterItWasStopped) {
  for (int round = 0; round < 2; ++round) {
    thread.start();
    tcp::socket host = device.accept();
    EXPECT_EQ(read_byte(host), EchoSession::kGreeting);
    thread.stop();
    EXPECT_EQ(read_byte(host), EchoSession::kFarewell);
  }
}

TEST(DeviceThread, NamesTheRemedyForASerialPortThatIsNotThere) {
  DeviceThreadParams params;
  params.line = {"/dev/no-such-port", "", 0};
  DeviceThread thread("device", params, std::make_shared<EchoSession>(), now);
  thread.start();
  std::string why;
  while (why.find("plug the device in") == std::string::npos) {
    const Status state = thread.state();
    ASSERT_FALSE(state);
    why = state.error().message;
  }
}

}  // namespace
}  // namespace seeker::drivers
