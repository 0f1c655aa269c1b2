// What sends an exploration home or holds it: certainty, battery, time, a lost robot.

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/matchers.hpp"
#include "tests/unit/server/explore/explorations.hpp"

namespace seeker::explore {
namespace {

using seeker::testing::Point2Near;

/// Twice the variance that an exploration goes on with.
constexpr double kUncertain_m2 = 2.0 * GuardParams{}.max_position_sigma_m * GuardParams{}.max_position_sigma_m;

TEST(Exploration, AnUncertainRobotGoesBackAndExploresOnWhenItIsCertain) {
  auto exploration = exploration_of(request_of(Strategy::kFrontier));
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 11);
  ToyExplorer::Hooks hooks;
  hooks.input = [&](double /*t_s*/, ExploreInput& input) {
    // Certain in the first room only.
    const double x = input.pose.map_T_base.x_m;
    input.pose.covariance = Matrix3::Identity() * (x > 3.0 ? kUncertain_m2 : 1e-4);
  };
  const ToyRun run = robot.run(exploration, 900.0, hooks);
  print("uncertain", run);
  EXPECT_TRUE(has_event(run, "uncertain"));
  EXPECT_TRUE(has_event(run, "certain"));
  ASSERT_TRUE(run.end.has_value());
  // It becomes uncertain at the same place again and again: that ends it too.
  EXPECT_EQ(run.end->kind, EndKind::kUncertain);
}

TEST(Exploration, CertaintyThatDoesNotComeBackEndsIt) {
  ExploreParams params;
  params.guard.regain_time_s = 40.0;
  auto exploration = exploration_of(request_of(Strategy::kFrontier), params);
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 12);
  ToyExplorer::Hooks hooks;
  hooks.input = [](double t_s, ExploreInput& input) {
    input.pose.covariance = Matrix3::Identity() * (t_s > 15.0 ? kUncertain_m2 : 1e-4);
  };
  const ToyRun run = robot.run(exploration, 200.0, hooks);
  print("not regained", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kUncertain);
  EXPECT_GT(run.seconds, 55.0);
  EXPECT_LT(run.seconds, 90.0) << "the way back takes as long as the way there, and there it waits for 40 s";
  EXPECT_NE(std::find(run.phases.begin(), run.phases.end(), "regain"), run.phases.end());
}

TEST(Exploration, ALongWayBackToCertaintyMayTakeLong) {
  ExploreParams params;
  params.guard.regain_time_s = 20.0;  // it takes half a minute
  auto exploration = exploration_of(request_of(Strategy::kFrontier), params);
  ToyWorld world;
  world.walls = box(0, 0, 24, 2);
  ToyExplorer robot(world, {1.0, 1.0, 0.0}, 21);
  ToyExplorer::Hooks hooks;
  hooks.input = [astray = false, done = false](double /*t_s*/, ExploreInput& input) mutable {
    const double x = input.pose.map_T_base.x_m;
    astray = !done && (astray || x > 12.0);
    done = done || (astray && x < 2.0);  // there it is sure again, and stays so
    input.pose.covariance = Matrix3::Identity() * (astray && !done ? kUncertain_m2 : 1e-4);
  };
  const ToyRun run = robot.run(exploration, 600.0, hooks);
  print("long way back", run);
  EXPECT_TRUE(has_event(run, "certain"));
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete) << run.end->cause;
}

TEST(Exploration, ABatteryAtItsReserveSendsTheRobotHome) {
  ExploreRequest request = request_of(Strategy::kFrontier);
  request.return_to_start = true;
  auto exploration = exploration_of(request);
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 13);
  ToyExplorer::Hooks hooks;
  hooks.input = [](double t_s, ExploreInput& input) {
    const bool sag = t_s > 1.0 && t_s < 3.0;  // of accelerating motors
    input.battery_v = sag || t_s > 6.0 ? 11.0 : 12.5;
  };
  const ToyRun run = robot.run(exploration, 300.0, hooks);
  print("battery", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kBattery);
  EXPECT_GT(run.seconds, 11.0);
  EXPECT_EQ(std::count_if(run.events.begin(), run.events.end(), [](const auto& e) { return e.kind == "battery"; }), 1);
  EXPECT_THAT(run.pose.translation(), Point2Near(Point2(1.0, 1.0), 0.2));
}

TEST(Exploration, RobotThatIsToComeBackIsHomeBeforeItsTimeIsUp) {
  constexpr double kLimit_s = 90.0;
  ToyWorld corridor;
  corridor.walls = box(0, 0, 60, 3);
  for (const bool comes_back : {true, false}) {
    ExploreRequest request = request_of(Strategy::kFrontier);
    request.return_to_start = comes_back;
    auto exploration = exploration_of(request);
    ToyExplorer robot(corridor, {1.0, 1.0, 0.3}, 13, 5.0);
    ToyExplorer::Hooks hooks;
    hooks.input = [](double t_s, ExploreInput& input) { input.time_left_s = kLimit_s - t_s; };
    const ToyRun run = robot.run(exploration, kLimit_s, hooks);
    print("time", run);
    EXPECT_EQ(has_event(run, "time"), comes_back);
    EXPECT_EQ(run.end.has_value(), comes_back) << "who need not come back has all the time";
    if (comes_back && run.end) {
      EXPECT_EQ(run.end->kind, EndKind::kTimeLimit);
      EXPECT_THAT(run.pose.translation(), Point2Near(Point2(1.0, 1.0), 0.2));
      EXPECT_GT(run.path_m, 10.0) << "it has explored meanwhile";
    }
  }
}

TEST(Exploration, ResumedExplorationComesBackToWhereItHadBegun) {
  ExploreRequest request = request_of(Strategy::kFrontier);
  request.return_to_start = true;
  auto exploration = exploration_of(request);
  exploration.remember_start({2.5, 1.5});
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 6);
  const ToyRun run = robot.run(exploration, 600.0);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_THAT(run.pose.translation(), Point2Near(Point2(2.5, 1.5), 0.2));
}

TEST(Exploration, ALostRobotStandsAndGoesOnWhenItIsFound) {
  auto exploration = exploration_of(request_of(Strategy::kFrontier));
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 14);
  ToyExplorer::Hooks hooks;
  hooks.input = [&](double t_s, ExploreInput& input) {
    if (t_s > 10.0 && t_s < 40.0) {
      input.pose.quality = LocalisationQuality::kLost;
    }
  };
  const ToyRun run = robot.run(exploration, 600.0, hooks);
  print("lost", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_NE(std::find(run.phases.begin(), run.phases.end(), "stopped"), run.phases.end());
}

TEST(Exploration, ARobotLostForGoodEndsAsUncertain) {
  auto exploration = exploration_of(request_of(Strategy::kFrontier));
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 15);
  ToyExplorer::Hooks hooks;
  hooks.input = [](double t_s, ExploreInput& input) {
    input.pose.quality = t_s > 5.0 ? LocalisationQuality::kLost : LocalisationQuality::kLocalised;
    input.pose.cause = "test";
  };
  const ToyRun run = robot.run(exploration, 600.0, hooks);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kUncertain);
  EXPECT_NE(run.end->cause.find("test"), std::string::npos);
  EXPECT_NEAR(run.seconds, 185.0, 1.0);
}

TEST(Exploration, LostOnTheWayHomeItStillTellsWhyItEnded) {
  ExploreRequest request = request_of(Strategy::kFrontier);
  request.return_to_start = true;
  auto exploration = exploration_of(request);
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 18);
  ToyExplorer::Hooks hooks;
  hooks.input = [](double t_s, ExploreInput& input) {
    input.pose.quality = t_s > 26.5 ? LocalisationQuality::kLost : LocalisationQuality::kLocalised;
    input.pose.cause = "test";
  };
  const ToyRun run = robot.run(exploration, 600.0, hooks);
  print("lost on the way home", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_NE(run.end->cause.find("not back at the start"), std::string::npos) << run.end->cause;
  EXPECT_NE(run.end->cause.find("test"), std::string::npos) << run.end->cause;
}

}  // namespace
}  // namespace seeker::explore
