// What can be changed of a robot while it runs: rates, thresholds, states and types of its components.

#include <algorithm>

#include <gtest/gtest.h>

#include "server/app/composition/robot_assembly.hpp"
#include "server/app/robot/robot.hpp"
#include "tests/support/data.hpp"

namespace seeker::app {
namespace {

class ComponentChanges : public ::testing::Test {
 protected:
  void start(const std::vector<std::string>& settings = {}) {
    const RobotOptions options = load_robot_options(testing::source_file("config/robots/sim.yaml"), settings).value();
    loop = std::make_unique<RobotLoop>(options.loop, assemble(options).value().parts, hub);
    loop->hooks().on_event = [this](const api::Event& event) { events.push_back(event); };
    loop->start();
  }
  void ticks(int count) {
    for (int k = 0; k < count; ++k) {
      wall += std::chrono::milliseconds(100);
      loop->tick(wall);
    }
  }
  [[nodiscard]] ComponentCommands& components() const { return loop->commands().components(); }
  [[nodiscard]] api::ComponentInfo component(const std::string& name) const {
    for (api::ComponentInfo& info : loop->diagnostics().components().list(loop->now())) {
      if (info.name == name) {
        return std::move(info);
      }
    }
    return {};
  }
  [[nodiscard]] api::ComponentPort port(const std::string& name, const std::string& port) const {
    for (const api::ComponentPort& one : component(name).ports) {
      if (one.name == port) {
        return one;
      }
    }
    return {};
  }
  [[nodiscard]] Status begin(const std::string& id, const api::MissionTask& task) {
    api::MissionRequest request;
    request.id = id;
    request.task = task;
    const Result<api::MissionId> started = loop->commands().start_mission(request, "tester");
    return started ? Status() : Status(tl::unexpected<Error>(started.error()));
  }
  [[nodiscard]] static api::SearchMission search_mission() {
    api::SearchMission search;
    api::TargetSpec& target = search.targets.emplace_back();
    target.name = "board";
    target.picture = Image(32, 32, 1);
    for (int v = 0; v < 32; ++v) {
      for (int u = 0; u < 32; ++u) {
        *target.picture.at(u, v) = (u / 8 + v / 8) % 2 == 0 ? 20 : 230;
      }
    }
    return search;
  }
  [[nodiscard]] static api::GotoMission go() {
    return {.waypoints = {Point2(1, 0)}, .final_heading_rad = std::nullopt, .keep_out = {}};
  }
  [[nodiscard]] bool logged(const std::string& kind, const std::string& text) const {
    return std::any_of(events.begin(), events.end(), [&](const api::Event& event) {
      return event.kind == kind && event.text.find(text) != std::string::npos;
    });
  }

  UpdateHub hub;
  std::unique_ptr<RobotLoop> loop;
  std::vector<api::Event> events;
  WallTime wall;
};

TEST_F(ComponentChanges, ARunningSearchTakesANewRateAndANewThreshold) {
  start();
  ASSERT_TRUE(begin("search", search_mission()));
  ticks(30);
  EXPECT_NEAR(component("lidar").rate_hz, 10.0, 0.5);
  const auto before = loop->missions().behaviour()->recogniser();
  ASSERT_NE(before, nullptr);
  const auto slower = components().set("lidar", {"period_s=0.5"});
  ASSERT_TRUE(slower) << slower.error().message;
  const auto stricter = components().set("recogniser", {"templates.accept_ncc=0.95"});
  ASSERT_TRUE(stricter) << stricter.error().message;
  EXPECT_NE(loop->missions().behaviour()->recogniser(), before) << "it was made again";
  EXPECT_TRUE(loop->missions().running()) << "the search goes on";
  ticks(200);
  EXPECT_NEAR(port("pose", "scan").rate_hz, 2.0, 0.2);
  EXPECT_TRUE(logged("component-set", "sim.devices.lidar_period_s is 0.5 now"));
  const auto refused = components().set("lidar", {"period_s=often"});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("sim.devices.lidar_period_s"), std::string::npos) << refused.error().message;
}

TEST_F(ComponentChanges, AnEstimatorIsExchangedBetweenMissionsAndItsMapBeginsAnew) {
  start();
  ASSERT_TRUE(begin("first", go()));
  ticks(20);
  EXPECT_EQ(components().exchange("pose", "scan_match").error().code, Errc::kBusy);
  loop->commands().stop();
  ticks(20);
  ASSERT_GT(loop->status().pose.map_T_base.x_m, 0.2);
  ASSERT_TRUE(loop->status().line_map);
  const std::uint32_t epoch = loop->status().pose.map_epoch;
  const Status exchanged = components().exchange("pose", "scan_match");
  ASSERT_TRUE(exchanged) << exchanged.error().message;
  EXPECT_EQ(component("pose").type, "scan_match");
  const api::RobotStatus status = loop->status();
  EXPECT_NE(status.pose.map_epoch, epoch);
  EXPECT_TRUE(is_placed(status.pose.quality)) << status.pose.cause;
  EXPECT_NEAR(status.pose.map_T_base.x_m, 0.0, 1e-6) << "the new map begins where the robot is";
  EXPECT_FALSE(status.line_map);
  EXPECT_TRUE(logged("component-exchanged", "a new map begins"));
  EXPECT_EQ(components().exchange("pose", "magic").error().code, Errc::kInvalidArgument);
  ASSERT_TRUE(begin("second", go()));
  ticks(200);
  EXPECT_NEAR(loop->status().pose.map_T_base.x_m, 1.0, 0.3);
  ASSERT_TRUE(components().exchange("pose", "line_slam"));
  EXPECT_TRUE(loop->status().line_map);
}

TEST_F(ComponentChanges, ARecogniserThatDoesNotStartLeavesTheRestRunning) {
  start({"search.solids.model=no-such-model.yaml"});
  EXPECT_EQ(component("recogniser").state, api::ComponentState::kError);
  EXPECT_EQ(component("lidar").state, api::ComponentState::kActive);
  const Status search = begin("search", search_mission());
  ASSERT_FALSE(search);
  EXPECT_NE(search.error().message.find("recogniser is not active"), std::string::npos) << search.error().message;
  ASSERT_TRUE(begin("drive", go()));
  ticks(60);
  EXPECT_GT(loop->status().odom_T_base.x_m, 0.5);
}

TEST_F(ComponentChanges, AnInactiveComponentHoldsTheRobotStillUntilItIsActive) {
  start();
  ASSERT_TRUE(begin("drive", go()));
  ticks(5);
  ASSERT_TRUE(components().switch_to("lidar", false));
  EXPECT_EQ(component("lidar").state, api::ComponentState::kInactive);
  ticks(20);
  const double there_m = loop->status().odom_T_base.x_m;
  ticks(20);
  EXPECT_NEAR(loop->status().odom_T_base.x_m, there_m, 1e-3);
  EXPECT_FALSE(loop->status().faults.empty());
  ASSERT_TRUE(components().switch_to("lidar", true));
  EXPECT_TRUE(loop->status().faults.empty());
  ASSERT_TRUE(loop->commands().command_mission(api::MissionCommand::kResume, "tester"));
  ticks(100);
  EXPECT_GT(loop->status().odom_T_base.x_m, 0.8);
}

TEST_F(ComponentChanges, TheRobotFileSaysWhoFeedsWhom) {
  start({"connections.map.ranges=sonar", "connections.safety.echoes=none", "estimator=odometry"});
  ticks(10);
  EXPECT_EQ(port("map", "echoes").connected, std::vector<std::string>{"sonar.echoes"});
  EXPECT_TRUE(port("map", "scan").connected.empty());
  EXPECT_TRUE(port("safety", "echoes").connected.empty());
  EXPECT_EQ(port("safety", "scan").connected, std::vector<std::string>{"lidar.scan"});
  EXPECT_TRUE(port("map", "map").age) << "the echoes are mapped";
}

}  // namespace
}  // namespace seeker::app
