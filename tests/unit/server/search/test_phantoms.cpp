// Sightings of what is not there, and how a planned search drives meanwhile.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "server/search/search_mission.hpp"
#include "tests/unit/server/search/toy_world.hpp"

namespace seeker::search {
namespace {

/// A search of two rooms without a target, in which a picture shows something `range_m` ahead that is not there.
ToyRun run_with_phantom(std::optional<double> score, double range_m) {
  auto mission = mission_of(Strategy::kPlan);
  ToyRobot robot(furnished_rooms(), {1.0, 1.0, 0.3}, true, 5);
  robot.between = [&robot, score, range_m](double t_s) {
    if (score && std::abs(t_s - 10.0) < 0.05) {
      robot.phantom.emplace();
      robot.phantom->score = *score;
      robot.phantom->range_m = range_m;
    }
  };
  return robot.run(mission, 1200.0);
}

bool has_event(const ToyRun& run, std::string_view text) {
  return std::any_of(run.events.begin(), run.events.end(),
                     [&](const SearchEvent& event) { return event.text.ends_with(text); });
}

TEST(SearchMission, ADoubtfulSightingCostsNoDetourWhereTheNextPicturesDecide) {
  const ToyRun none = run_with_phantom({}, 0.0);
  const ToyRun beyond = run_with_phantom(0.72, 8.0);
  EXPECT_TRUE(has_event(beyond, "score 0.72"));
  EXPECT_TRUE(has_event(beyond, "is farther off than targets are recognised"));
  EXPECT_EQ(beyond.path_m, none.path_m) << "farther than the recogniser reaches";
  EXPECT_EQ(beyond.end, none.end);
  const ToyRun clear = run_with_phantom(0.9, 8.0);
  EXPECT_TRUE(has_event(clear, "could not be confirmed"));
  EXPECT_GT(clear.seconds, none.seconds + 5.0);
}

TEST(SearchMission, WhatWasConfirmedWhileAnotherTargetIsApproachedIsApproachedNext) {
  auto mission = mission_of(Strategy::kPlan);
  ToyRobot robot(furnished_rooms(), {1.0, 1.0, 0.3}, true, 5);
  robot.between = [&robot](double t_s) {
    for (const auto& [at_s, bearing_rad] : {std::pair{8.0, 0.0}, {9.0, 1.5}}) {
      if (std::abs(t_s - at_s) < 0.05) {
        robot.phantom.emplace();
        robot.phantom->score = 0.97;
        robot.phantom->bearing_base_rad = bearing_rad;
      }
    }
  };
  const ToyRun run = robot.run(mission, 1200.0);
  print("two mirages", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(std::count_if(run.events.begin(), run.events.end(),
                          [](const SearchEvent& event) { return event.text.ends_with("is not there from near"); }),
            2);
}

TEST(SearchMission, DrivesThroughItsGoals) {
  const ToyRun run = run_with_phantom({}, 0.0);
  const auto goals = std::count_if(run.events.begin(), run.events.end(),
                                   [](const SearchEvent& event) { return event.kind == "goal"; });
  EXPECT_GT(goals, 10);
  EXPECT_LT(run.stops, 0.8 * static_cast<double>(goals));
}

}  // namespace
}  // namespace seeker::search
