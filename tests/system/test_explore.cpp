// Explorations of simulated worlds: every part of the robot but the network.

#include <algorithm>

#include "tests/system/simulated_robot.hpp"

namespace seeker::testing {
namespace {

api::MissionRequest explore_by(api::ExploreStrategy strategy) {
  api::MissionRequest request;
  request.id = "explore";
  request.task = api::ExploreMission{strategy, std::nullopt, {}, false};
  return request;
}

TEST(ExploreSystem, DemoWorldIsMappedToItsEndWithoutAContact) {
  SimulatedRobot robot;
  std::vector<ExploreDecision> decisions;
  robot.loop->hooks().on_mission = [&](const api::MissionStatus& status) {
    if (status.decision) {
      decisions.push_back(*status.decision);
    }
  };
  ASSERT_TRUE(robot.loop->commands().start_mission(explore_by(api::ExploreStrategy::kFrontier), "test"));
  robot.run(1800.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kComplete) << robot.end().cause;
  EXPECT_EQ(robot.simulation->truth().contacts, 0);
  EXPECT_GT(robot.loop->robot_map().status()->segments, 10U);
  ASSERT_GT(decisions.size(), 3U);
  for (std::size_t k = 0; k < decisions.size(); ++k) {
    EXPECT_EQ(decisions[k].number, k + 1) << "each is reported once";
  }
}

TEST(ExploreSystem, SearchThatExploresAlsoDrivesForTheMap) {
  SimulatedRobot robot({"sim.world=../worlds/no-target.yaml"});
  api::MissionRequest request = search_for("cross");
  std::get<api::SearchMission>(request.task).explore = true;
  ASSERT_TRUE(robot.loop->commands().start_mission(request, "test"));
  robot.run(1800.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kNotFoundAreaCovered) << robot.end().cause;
  EXPECT_EQ(robot.simulation->truth().contacts, 0);
  const auto visits = std::count_if(robot.events.begin(), robot.events.end(), [](const api::Event& event) {
    return event.kind == "goal" && event.text.starts_with("open wall");
  });
  EXPECT_GT(visits, 0);
}

TEST(ExploreSystem, RobotWithoutAMapOfSegmentsRefusesWithTheRemedy) {
  SimulatedRobot robot({"estimator=odometry"});
  const Result<api::MissionId> refused =
      robot.loop->commands().start_mission(explore_by(api::ExploreStrategy::kFrontier), "test");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kRefused);
  EXPECT_NE(refused.error().message.find("--set estimator=line_slam"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace seeker::testing
