#include "server/app/metrics/robot_metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <prometheus/text_serializer.h>

#include "server/app/metrics/metrics_page.hpp"

namespace seeker::app {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::Not;

class RobotMetricsTest : public ::testing::Test {
 protected:
  RobotMetricsTest() { metrics.follow(hooks); }

  void tick_at(milliseconds at) {
    hooks.on_tick({.begun = std::chrono::steady_clock::time_point(at), .estimate = milliseconds(30)});
  }
  [[nodiscard]] std::string text() const { return prometheus::TextSerializer().Serialize(metrics.Collect()); }

  RobotMetrics metrics{"robot-7", "1.2"};
  LoopHooks hooks;
};

TEST_F(RobotMetricsTest, SayWhichRobotThisIs) {
  EXPECT_THAT(text(), HasSubstr("seeker_info{robot=\"robot-7\",version=\"1.2\"} 1"));
}

TEST_F(RobotMetricsTest, CountPeriodAndPartsOfTheLoop) {
  tick_at(milliseconds(0));
  tick_at(milliseconds(100));
  EXPECT_THAT(text(), HasSubstr("seeker_loop_period_seconds_count 1"));
  EXPECT_THAT(text(), HasSubstr("seeker_loop_period_seconds_sum 0.1"));
  EXPECT_THAT(text(), HasSubstr("seeker_loop_part_seconds_bucket{part=\"estimate\",le=\"0.02\"} 0"));
  EXPECT_THAT(text(), HasSubstr("seeker_loop_part_seconds_bucket{part=\"estimate\",le=\"0.05\"} 2"));
}

TEST_F(RobotMetricsTest, ARestOnPurposeIsNoPeriod) {
  tick_at(milliseconds(0));
  hooks.on_idle();
  tick_at(milliseconds(5000));
  EXPECT_THAT(text(), HasSubstr("seeker_loop_period_seconds_count 0"));
}

TEST_F(RobotMetricsTest, TellTheWorkOnPicturesApart) {
  hooks.on_work("recogniser", milliseconds(40));
  hooks.on_work("stereo", milliseconds(90));
  EXPECT_THAT(text(), HasSubstr("seeker_vision_seconds_count{work=\"recogniser\"} 1"));
  EXPECT_THAT(text(), HasSubstr("seeker_vision_seconds_sum{work=\"stereo\"} 0.09"));
}

TEST_F(RobotMetricsTest, ShowStateMissionAndFaults) {
  EXPECT_THAT(text(), Not(HasSubstr("seeker_faults")));
  api::RobotStatus status;
  status.estop = true;
  status.battery_v = 12.5;
  status.timing = TickTiming{.ticks = 10, .late = 2, .worst = milliseconds(30)};
  status.faults.emplace_back();
  status.faults.back().id = "lidar-lost";
  status.faults.back().component = "lidar";
  status.mission = api::MissionStatus{};
  status.mission->kind = "explore";
  metrics.note(status);
  EXPECT_THAT(text(), HasSubstr("seeker_estop 1"));
  EXPECT_THAT(text(), HasSubstr("seeker_battery_volts 12.5"));
  EXPECT_THAT(text(), HasSubstr("seeker_loop_late_ticks_total 2"));
  EXPECT_THAT(text(), HasSubstr("seeker_faults 1"));
  EXPECT_THAT(text(), HasSubstr("seeker_fault{id=\"lidar-lost\",component=\"lidar\""));
  EXPECT_THAT(text(), HasSubstr("seeker_mission{kind=\"explore\""));
}

TEST_F(RobotMetricsTest, ShowTheNetworkWhileThereIsAServer) {
  server_net::ServerStats stats;
  stats.sessions = 3;
  stats.dropped[static_cast<std::size_t>(api::Topic::kScan)] = 17;
  metrics.set_server([stats] { return stats; });
  EXPECT_THAT(text(), HasSubstr("seeker_sessions 3"));
  EXPECT_THAT(text(), HasSubstr("seeker_updates_dropped_total{topic=\"scan\"} 17"));
  metrics.set_server({});
  EXPECT_THAT(text(), Not(HasSubstr("seeker_sessions")));
}

TEST(MetricsPage, IsForThisMachineAlone) {
  EXPECT_TRUE(validate(MetricsSettings{}));
  EXPECT_TRUE(validate(MetricsSettings{.address = "[::1]"}));
  for (const char* address : {"0.0.0.0", "192.168.1.4", "localhost.example.org", ""}) {
    const Status refused = validate(MetricsSettings{.address = address});
    ASSERT_FALSE(refused) << address;
    EXPECT_THAT(refused.error().message, HasSubstr("127.0.0.1"));
  }
}

TEST(MetricsPage, NamesAPortThatIsTaken) {
  const auto metrics = std::make_shared<RobotMetrics>("robot", "1");
  const auto first = MetricsPage::open({.port = 0}, metrics);
  ASSERT_TRUE(first) << first.error().message;
  ASSERT_GT((*first)->port(), 0);
  const auto second = MetricsPage::open({.port = (*first)->port()}, metrics);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::kIo);
  EXPECT_THAT(second.error().message, HasSubstr("metrics.port"));
}

}  // namespace
}  // namespace seeker::app
