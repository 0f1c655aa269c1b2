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
                         ::testing::Values(Strategy::kFrontier, Strategy::kGain, Strategy::kHorizon),
                         [](const auto& param) { return std::string(to_string(param.param)); });

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
