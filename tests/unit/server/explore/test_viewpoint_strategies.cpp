#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "server/explore/place_strategy.hpp"
#include "server/explore/view_gain.hpp"
#include "tests/unit/server/explore/toy_worlds.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::explore {
namespace {

ToyRun run_in(const ToyWorld& world, const Pose2& start, Strategy strategy, std::uint64_t seed) {
  ExploreRequest request;
  request.strategy = maker_of(strategy);
  auto exploration = Exploration::create(request, {});
  EXPECT_TRUE(exploration.has_value());
  ToyExplorer robot(world, start, seed, 6.0);
  ToyRun run = robot.run(*exploration, 900.0);
  std::cout << to_string(strategy) << ": " << (run.end ? run.end->cause : "no end") << "; " << run.path_m << " m, "
            << run.seconds << " s, walls " << run.wall_share << ", " << run.decisions.size() << " decisions\n";
  return run;
}

class ViewpointStrategy : public ::testing::TestWithParam<Strategy> {};

TEST_P(ViewpointStrategy, MapsAnOfficeAndEnds) {
  const ToyRun run = run_in(office(), {9.0, 5.0, 1.5}, GetParam(), 5);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_GT(run.wall_share, 0.97);
  EXPECT_GT(run.least_clearance_m, 0.25);
  EXPECT_LT(run.path_m, 120.0);
}

TEST_P(ViewpointStrategy, MapsARingAndEnds) {
  const ToyRun run = run_in(ring(), {1.0, 1.0, 0.0}, GetParam(), 6);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_GT(run.wall_share, 0.97);
  EXPECT_LT(run.path_m, 60.0);
}

TEST_P(ViewpointStrategy, TurnsRoundBeforeItIsOverWhereItBegan) {
  ToyWorld world;
  world.walls = joined(box(-5, -5, 5, 5), box(-0.35, -0.35, 0.35, 0.35));
  const ToyRun run = run_in(world, {}, GetParam(), 9);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_NE(std::find(run.phases.begin(), run.phases.end(), "turn"), run.phases.end());
  EXPECT_GT(run.seconds, 10.0);
  EXPECT_EQ(run.end->kind, EndKind::kUnreachable) << "there is no floor to drive on";
}

TEST_P(ViewpointStrategy, TellsWhyItChose) {
  const ToyRun run = run_in(two_rooms(), {1.0, 1.0, 0.3}, GetParam(), 7);
  ASSERT_FALSE(run.decisions.empty());
  for (const ExploreDecision& decision : run.decisions) {
    EXPECT_EQ(decision.rule, to_string(GetParam()));
    EXPECT_FALSE(decision.why.empty());
    EXPECT_LE(decision.candidates.size(), kMaxDecisionCandidates);
    if (decision.chosen) {
      ASSERT_LT(*decision.chosen, decision.candidates.size());
      EXPECT_TRUE(decision.candidates[*decision.chosen].refused.empty());
    }
  }
}

TEST_P(ViewpointStrategy, SameInputsGiveTheSameWay) {
  const ToyRun first = run_in(two_rooms(), {1.0, 1.0, 0.3}, GetParam(), 8);
  const ToyRun second = run_in(two_rooms(), {1.0, 1.0, 0.3}, GetParam(), 8);
  EXPECT_EQ(first.decisions, second.decisions);
  EXPECT_EQ(first.pose, second.pose);
}

INSTANTIATE_TEST_SUITE_P(All, ViewpointStrategy,
                         ::testing::Values(Strategy::kFrontier, Strategy::kGain, Strategy::kHorizon, Strategy::kTour),
                         [](const auto& param) { return std::string(to_string(param.param)); });

/// A place, 0.5 m off the unknown on its right, among others.
Opening border_at(const Point2& p_map, std::uint64_t id) {
  Opening opening;
  opening.id = id;
  opening.p_map = p_map;
  opening.size_m = 1.0;
  opening.map_T_view = {p_map.x() - 0.5, p_map.y(), 0.0};
  return opening;
}

TEST(HorizonChooser, APlaceThatShowsAllThatIsLeftNeedsNoFurtherDrive) {
  // Both borders are in view from the far place's viewpoint; the near one shows only itself.
  const auto occupancy = nav::ascii_map(std::vector<std::string>(40, std::string(60, '.') + std::string(20, ' ')), 0.1);
  const auto cost = nav::CostMap::build(occupancy);
  ASSERT_TRUE(cost.has_value());
  const Pose2 robot{3.0, 2.0, 0.0};
  const auto reachable = nav::reachable_floor(*cost, robot.translation(), 0.2);
  const auto costs = nav::DistanceField::build(*cost, robot.translation());
  ASSERT_TRUE(reachable && costs);
  const nav::FloorView floor{occupancy, *cost, *reachable, 1, {}};
  nav::FloorSource floors({}, {}, 0.2, 1.0);
  const std::vector<MapSegment> none;
  const StrategyInput input{
      {{}, robot, nullptr, nullptr, floors}, {}, Matrix3::Identity() * 1e-4, none, 1, {}, nullptr};
  Opening both = border_at({5.9, 2.0}, 1);
  both.map_T_view = {4.0, 2.0, 0.0};
  Opening one = border_at({5.9, 2.6}, 2);
  one.map_T_view = {5.2, 2.6, 1.5};  // away from the other
  for (Opening* opening : {&both, &one}) {
    opening->cost = *costs->cost_to(opening->map_T_view.translation());
  }
  const std::vector<Opening> open{both, one};
  const auto chooser = make_horizon_chooser({});
  const PlaceChoice choice = chooser->choose({input, floor, *costs, open});
  ASSERT_TRUE(choice.opening.has_value());
  EXPECT_EQ(choice.opening->id, 1U) << choice.decision.why;
  EXPECT_NE(choice.decision.why.find("best of 1 drives"), std::string::npos) << choice.decision.why;
}

TEST(ViewGain, CountsUnknownFloorInSightAndFacesIt) {
  // A room whose right half nobody has seen; behind the left wall nobody has been either.
  const auto map = nav::CostMap::build(nav::ascii_map({"################", "#.......        ", "#.......        ",
                                                       "#.......        ", "#.......        ", "################"},
                                                      0.5));
  ASSERT_TRUE(map.has_value());
  SensorModel sensor;
  sensor.range_m = 3.0;
  const ViewGain gain = view_gain(*map, {3.5, 1.5}, sensor);
  // Half a metre of floor, then 2.5 m of a strip 2 m wide.
  EXPECT_NEAR(gain.area_m2, 4.8, 0.5);
  EXPECT_NEAR(gain.heading_rad, 0.0, 0.8);
  const ViewGain none = view_gain(*map, {0.8, 1.5}, sensor);
  EXPECT_NEAR(none.area_m2, 0.0, 1e-9);
}

}  // namespace
}  // namespace seeker::explore
