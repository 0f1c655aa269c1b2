#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "toy_explorer.hpp"

namespace seeker::explore {
namespace {

/// 5 x 4 m and 3.85 x 4 m, a wall of 0.15 m with a door of 0.9 m between them.
std::vector<Wall> two_rooms() {
  return {{{0.0, 0.0}, {5.0, 0.0}},   {{0.0, 4.0}, {0.0, 0.0}},  {{5.0, 4.0}, {0.0, 4.0}},  {{5.15, 0.0}, {9.0, 0.0}},
          {{9.0, 0.0}, {9.0, 4.0}},   {{9.0, 4.0}, {5.15, 4.0}}, {{5.0, 0.0}, {5.0, 1.0}},  {{5.0, 1.0}, {5.15, 1.0}},
          {{5.15, 1.0}, {5.15, 0.0}}, {{5.0, 4.0}, {5.0, 1.9}},  {{5.0, 1.9}, {5.15, 1.9}}, {{5.15, 1.9}, {5.15, 4.0}}};
}

constexpr double kBody_m = 0.25;  ///< radius of a Pioneer

ToyRun run_in_two_rooms(const ExploreParams& params, Strategy strategy, double limit_s) {
  ToyWorld world;
  world.walls = two_rooms();
  ToyExplorer robot(world, {2.5, 1.2, 0.3}, 7);
  ExploreRequest request;
  request.strategy = maker_of(strategy);
  auto exploration = Exploration::create(request, params);
  EXPECT_TRUE(exploration);
  return robot.run(*exploration, limit_s);
}

bool has_rule(const ToyRun& run, const std::string& rule) {
  return std::any_of(run.decisions.begin(), run.decisions.end(),
                     [&](const ExploreDecision& decision) { return decision.rule == rule; });
}

TEST(ActiveStrategy, MapsTwoRoomsThroughTheirDoor) {
  const ToyRun run = run_in_two_rooms({}, Strategy::kActive, 600.0);
  ASSERT_TRUE(run.end) << "it must end by itself";
  EXPECT_EQ(run.end->kind, EndKind::kComplete) << run.end->cause;
  EXPECT_GT(run.wall_share, 0.95);
  EXPECT_GT(run.least_clearance_m, kBody_m);
  EXPECT_TRUE(has_rule(run, "one-step"));
  EXPECT_TRUE(has_rule(run, "wall"));
}

TEST(ActiveStrategy, TellsEveryControlWithItsTermsAndChoosesTheBest) {
  const ToyRun run = run_in_two_rooms({}, Strategy::kActive, 15.0);
  ASSERT_FALSE(run.decisions.empty());
  const ExploreDecision& first = run.decisions.front();
  EXPECT_EQ(first.number, 1U);
  EXPECT_EQ(first.rule, "one-step");
  EXPECT_EQ(first.candidates.size(), 19U) << "4 speeds by 5 turning speeds without standing still";
  ASSERT_TRUE(first.chosen);
  for (const DecisionCandidate& candidate : first.candidates) {
    EXPECT_TRUE(!candidate.refused.empty() || candidate.score <= first.candidates[*first.chosen].score);
    EXPECT_TRUE(std::isfinite(candidate.score));
  }
}

TEST(ActiveStrategy, LooksAtTheWallsBeforeItFirstMoves) {
  ExploreParams params;
  params.one_step.first_look_s = 8.0;
  const ToyRun looking = run_in_two_rooms(params, Strategy::kActive, 7.0);
  EXPECT_TRUE(looking.decisions.empty());
  const ToyRun run = run_in_two_rooms(params, Strategy::kActive, 15.0);
  EXPECT_FALSE(run.decisions.empty()) << "but not for ever";
}

TEST(ActiveStrategy, EndsAsThePaperHasItWithoutPaths) {
  ExploreParams params;
  params.one_step.escape_by_path = false;
  const ToyRun run = run_in_two_rooms(params, Strategy::kActive, 600.0);
  ASSERT_TRUE(run.end);
  EXPECT_FALSE(has_rule(run, "frontier"));
  EXPECT_LT(run.wall_share, 0.9) << "no wall leads through this door";
}

TEST(ActiveStrategy, ExploresWithoutStandingStillToo) {
  ExploreParams params;
  params.one_step.stop_and_go = false;
  const ToyRun run = run_in_two_rooms(params, Strategy::kActive, 600.0);
  ASSERT_TRUE(run.end);
  EXPECT_GT(run.wall_share, 0.95);
  EXPECT_GT(run.least_clearance_m, kBody_m);
}

TEST(ActiveStrategy, InAHallItDrivesStraightUntilItSeesAWall) {
  ToyWorld world;
  world.walls = box(-4.0, -30.0, 30.0, 30.0);
  ToyExplorer robot(world, {10.0, 0.0, kPi}, 3);
  ExploreRequest request;
  request.strategy = maker_of(Strategy::kActive);
  auto exploration = Exploration::create(request, {});
  ASSERT_TRUE(exploration);
  const ToyRun run = robot.run(*exploration, 55.0);
  EXPECT_LT(run.pose.x_m, 6.0) << "the wall is at -4 m and the laser sees 8 m";
  EXPECT_NEAR(run.pose.y_m, 0.0, 0.5);
  EXPECT_GT(run.segments, 0U);
}

TEST(RoamStrategy, DrivesStraightThenTurnsAndNeverTouches) {
  const ToyRun run = run_in_two_rooms({}, Strategy::kRoam, 150.0);
  EXPECT_FALSE(run.end) << "somebody else ends it";
  EXPECT_GT(run.path_m, 8.0);
  EXPECT_GT(run.least_clearance_m, kBody_m);
  EXPECT_TRUE(has_rule(run, "roam"));
  EXPECT_GT(std::count(run.phases.begin(), run.phases.end(), "turn"), 2);
  const ToyRun again = run_in_two_rooms({}, Strategy::kRoam, 150.0);
  EXPECT_EQ(again.pose, run.pose) << "deterministic";
}

}  // namespace
}  // namespace seeker::explore
