#include "server/emulator/world_host.hpp"

#include <array>
#include <limits>

#include "common/wire/outcome.hpp"
#include "tests/unit/server/emulator/worlds.hpp"

namespace seeker::emulator {
namespace {

using namespace std::chrono_literals;
using testing::hello_of;
using testing::two_robots;

RobotTime at(Duration since_start) { return RobotTime() + since_start; }

v1::EmulatorRequest advance(Duration period) {
  v1::EmulatorRequest request;
  request.set_id(9);
  request.set_advance_ns(period.count());
  return request;
}

v1::EmulatorRequest read_lidar() {
  v1::EmulatorRequest request;
  request.set_read(v1::EMULATOR_DEVICE_LIDAR);
  return request;
}

v1::EmulatorRequest activate(v1::EmulatorDevice device) {
  v1::EmulatorRequest request;
  request.set_activate(device);
  return request;
}

Errc code_of(const std::optional<v1::EmulatorReply>& reply) {
  const Status status = wire::status_of(reply.value().error());
  return status ? Errc::kInternal : status.error().code;
}

bool is_ok(const std::optional<v1::EmulatorReply>& reply) { return reply && wire::status_of(reply->error()); }

TEST(WorldHost, RefusesWhoDoesNotBelong) {
  WorldHost host(two_robots(), {});
  EXPECT_EQ(host.enter(hello_of(0, 1, 99)).error().code, Errc::kUnsupportedVersion);
  EXPECT_EQ(host.enter(hello_of(2, 1)).error().code, Errc::kNotFound);
  ASSERT_TRUE(host.enter(hello_of(0, 1)));
  EXPECT_EQ(host.enter(hello_of(0, 2)).error().code, Errc::kBusy);
  EXPECT_TRUE(host.enter(hello_of(0, 1))) << "the same program may connect again";
  host.leave(0);
  EXPECT_TRUE(host.enter(hello_of(0, 2)));
}

TEST(WorldHost, WaitsForAllItsRobots) {
  WorldHost host(two_robots(), {});
  ASSERT_TRUE(host.enter(hello_of(0, 1)));
  EXPECT_FALSE(host.handle(0, advance(100ms)));
  EXPECT_FALSE(host.next()) << "robot 1 has not come yet";
  ASSERT_TRUE(host.enter(hello_of(1, 2)));
  EXPECT_FALSE(host.handle(1, advance(100ms)));
  ASSERT_EQ(host.next(), at(100ms));
  const auto replies = host.go_on(at(100ms));
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_EQ(replies[1].second.id(), 9U);
  EXPECT_EQ(replies[1].second.now_ns(), Duration(100ms).count());
}

TEST(WorldHost, GoesOnWithoutARobotThatIsGone) {
  WorldHost host(two_robots(), {});
  ASSERT_TRUE(host.enter(hello_of(0, 1)));
  ASSERT_TRUE(host.enter(hello_of(1, 2)));
  EXPECT_FALSE(host.handle(0, advance(100ms)));
  host.leave(1);
  EXPECT_EQ(host.next(), at(100ms));
  ASSERT_TRUE(host.enter(hello_of(1, 3)));
  EXPECT_FALSE(host.next()) << "it is back";
}

TEST(WorldHost, ARobotThatIsGoneStandsStill) {
  WorldHost host(two_robots(), {});
  ASSERT_TRUE(host.enter(hello_of(0, 1)));
  ASSERT_TRUE(host.enter(hello_of(1, 2)));
  EXPECT_TRUE(is_ok(host.handle(1, activate(v1::EMULATOR_DEVICE_BASE))));
  v1::EmulatorRequest motors;
  motors.set_set_motors(true);
  EXPECT_TRUE(is_ok(host.handle(1, motors)));
  v1::EmulatorRequest drive;
  drive.mutable_set_velocity()->set_v_m_s(0.5);
  EXPECT_TRUE(is_ok(host.handle(1, drive)));
  host.leave(1);
  EXPECT_FALSE(host.handle(0, advance(10s)));
  static_cast<void>(host.go_on(*host.next()));
  EXPECT_EQ(host.world().robot(1).truth().velocity, Twist2{});
  EXPECT_EQ(host.world().robot(1).truth().path_length_m, 0.0);
}

TEST(WorldHost, AnswersNonsenseWithItsName) {
  WorldHost host(two_robots(), {});
  ASSERT_TRUE(host.enter(hello_of(0, 1)));
  EXPECT_EQ(code_of(host.handle(0, {})), Errc::kInvalidArgument);
  EXPECT_EQ(code_of(host.handle(0, advance(-1s))), Errc::kInvalidArgument);
  EXPECT_EQ(code_of(host.handle(0, advance(24h))), Errc::kInvalidArgument);
  EXPECT_EQ(code_of(host.handle(0, activate(static_cast<v1::EmulatorDevice>(77)))), Errc::kInvalidArgument);
  EXPECT_EQ(code_of(host.handle(0, read_lidar())), Errc::kNotReady) << "not active yet";
  v1::EmulatorRequest drive;
  drive.mutable_set_velocity()->set_v_m_s(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(code_of(host.handle(0, drive)), Errc::kInvalidArgument);
}

/// Scans of both robots over some ticks, as bytes; they come and call in one order or the other.
std::array<std::string, 2> play(bool backwards) {
  WorldHost host(two_robots(), {});
  const std::array<std::size_t, 2> order =
      backwards ? std::array<std::size_t, 2>{1, 0} : std::array<std::size_t, 2>{0, 1};
  std::array<std::string, 2> seen;
  for (const std::size_t robot : order) {
    EXPECT_TRUE(host.enter(hello_of(static_cast<std::uint32_t>(robot), robot + 1)));
    EXPECT_TRUE(is_ok(host.handle(robot, activate(v1::EMULATOR_DEVICE_LIDAR))));
  }
  for (int tick = 0; tick < 10; ++tick) {
    for (const std::size_t robot : order) {
      seen[robot] += host.handle(robot, read_lidar()).value().scan().SerializeAsString();
      EXPECT_FALSE(host.handle(robot, advance(100ms)));
    }
    static_cast<void>(host.go_on(host.next().value()));
  }
  return seen;
}

TEST(WorldHost, TheOrderOfTheConnectionsChangesNothing) {
  const auto forwards = play(false);
  EXPECT_GT(forwards[0].size(), 1000U);
  EXPECT_EQ(forwards, play(true));
}

}  // namespace
}  // namespace seeker::emulator
