// A robot whose tick lasts for long: what stops it does not wait for the next one.

#include "tests/integration/link/linked_robot.hpp"

namespace seeker::testing {
namespace {

/// A tick of 0.1 s of robot time takes more than a quarter of an hour.
constexpr double kSlow = 1e-4;
constexpr std::chrono::seconds kAnswered{60};

TEST(BetweenTicks, TheRobotIsStoppedAndItsClientIsAnswered) {
  const log::ScopedSink quiet{[](const log::Line&) {}};
  const auto maps = std::filesystem::path(::testing::TempDir()) / "between_ticks";
  LinkedRobot robot(kSlow, maps, on_port(0));
  rpc::ClientParams params;
  params.client_name = "tester";
  params.connect_timeout = params.call_timeout = kAnswered;
  const auto client = rpc::RobotClient::connect({"127.0.0.1", robot.port()}, params).value();
  const auto started = rpc::wait<api::MissionAccepted>(
      [&](auto reply) { client->start_mission(to_and_fro("long", 1), reply); }, kAnswered);
  ASSERT_TRUE(started) << started.error().message;
  ASSERT_TRUE(rpc::wait<void>([&](auto reply) { client->stop(reply); }, kAnswered));
  const auto mission = rpc::wait<api::MissionStatus>([&](auto reply) { client->get_mission(reply); }, kAnswered);
  ASSERT_TRUE(mission && mission->end);
  EXPECT_EQ(mission->end->outcome, api::Outcome::kOperator);
}

}  // namespace
}  // namespace seeker::testing
