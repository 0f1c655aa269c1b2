#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "server/lab/efficiency/reproduce_efficiency.hpp"

namespace seeker::lab {
namespace {

ExploreResult run_of(const std::string& strategy, std::uint64_t seed, double path_m, double time_s) {
  ExploreResult run;
  run.world = "office";
  run.strategy = strategy;
  run.seed = seed;
  run.outcome = "COMPLETE";
  run.path_length_m = path_m;
  run.robot_time_s = time_s;
  run.wall_share = 0.98;
  run.mean_error_m = 0.01;
  run.floor_m2 = 190.0;
  return run;
}

/// A world with limits in which `tour` stays well below both.
EfficiencyRuns office() {
  EfficiencyRuns world;
  world.world = {.name = "office", .robot = "sim", .path_share = 0.85, .time_share = 0.75};
  world.open_tour_m = 100.0;
  world.floor_m2 = 200.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    world.runs.push_back(run_of("frontier", seed, 150.0, 400.0));
    world.runs.push_back(run_of("tour", seed, 120.0, 280.0));
  }
  return world;
}

template <class Change>
EfficiencyRuns changed(EfficiencyRuns world, const std::string& strategy, Change&& change) {
  for (ExploreResult& run : world.runs) {
    if (run.strategy == strategy) {
      change(run);
    }
  }
  return world;
}

std::vector<std::string> verdicts(const EfficiencyRuns& world) {
  Report report(nullptr);
  check_efficiency(world, report);
  std::vector<std::string> all;
  std::transform(report.checks().begin(), report.checks().end(), std::back_inserter(all),
                 [](const Check& check) { return verdict_of(check) + " " + check.id; });
  return all;
}

TEST(EfficiencyTable, HasTheRatioOfEachMeanPathToTheYardstick) {
  EfficiencyRuns world = office();
  world.runs.erase(world.runs.begin() + 4, world.runs.end());  // two seeds are left
  world.runs[2].path_length_m = 170.0;
  world.runs[2].contacts = 1;
  world.runs[2].outcome = "TIME_LIMIT";
  const std::string csv = efficiency_table({world}).csv();
  const std::string tour = "office,tour,2,120.0 +- 0.0,280 +- 0,1.20,98.0 +- 0.0,95.0 +- 0.0,0.0100 +- 0.0000,0,2/2\n";
  const std::string frontier =
      "office,frontier,2,160.0 +- 14.1,400 +- 0,1.60,98.0 +- 0.0,95.0 +- 0.0,0.0100 +- 0.0000,1,1/2\n";
  EXPECT_NE(csv.find(tour + frontier), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3) << "no rows of strategies that were not run";
}

TEST(EfficiencyTable, NamesNoRatioWithoutAYardstick) {
  EfficiencyRuns world = office();
  world.open_tour_m = 0.0;
  const std::string csv = efficiency_table({world}).csv();
  EXPECT_NE(csv.find("office,tour,3,120.0 +- 0.0,280 +- 0,-,"), std::string::npos) << csv;
}

TEST(EfficiencyChecks, GoodRunsPassEverything) {
  EXPECT_EQ(verdicts(office()),
            (std::vector<std::string>{"PASS E-PATH", "PASS E-TIME", "PASS E-WALLS", "PASS E-ERROR", "PASS E-CONTACT"}));
}

TEST(EfficiencyChecks, EachLimitFailsByItself) {
  EXPECT_EQ(verdicts(changed(office(), "tour", [](ExploreResult& run) { run.path_length_m = 130.0; })),
            (std::vector<std::string>{"FAIL E-PATH", "PASS E-TIME", "PASS E-WALLS", "PASS E-ERROR", "PASS E-CONTACT"}));
  EXPECT_EQ(verdicts(changed(office(), "tour", [](ExploreResult& run) { run.robot_time_s = 310.0; })),
            (std::vector<std::string>{"PASS E-PATH", "FAIL E-TIME", "PASS E-WALLS", "PASS E-ERROR", "PASS E-CONTACT"}));
  EXPECT_EQ(verdicts(changed(office(), "tour", [](ExploreResult& run) { run.wall_share = 0.96; })),
            (std::vector<std::string>{"PASS E-PATH", "PASS E-TIME", "FAIL E-WALLS", "PASS E-ERROR", "PASS E-CONTACT"}));
  EXPECT_EQ(verdicts(changed(office(), "tour", [](ExploreResult& run) { run.mean_error_m = 0.03; })),
            (std::vector<std::string>{"PASS E-PATH", "PASS E-TIME", "PASS E-WALLS", "FAIL E-ERROR", "PASS E-CONTACT"}));
  EXPECT_EQ(verdicts(changed(office(), "frontier", [](ExploreResult& run) { run.contacts = 1; })),
            (std::vector<std::string>{"PASS E-PATH", "PASS E-TIME", "PASS E-WALLS", "PASS E-ERROR", "FAIL E-CONTACT"}));
}

TEST(EfficiencyChecks, OnlySeedsOfBothStrategiesAreCompared) {
  EfficiencyRuns world = office();
  world.runs.push_back(run_of("tour", 9, 1000.0, 9000.0));
  EXPECT_EQ(verdicts(world).front(), "PASS E-PATH");
  std::erase_if(world.runs, [](const ExploreResult& run) { return run.strategy == "frontier"; });
  EXPECT_EQ(verdicts(world), (std::vector<std::string>{"PASS E-WALLS", "PASS E-ERROR", "PASS E-CONTACT"}));
}

TEST(EfficiencyChecks, AWorldWithoutLimitsIsNotJudged) {
  EfficiencyRuns world = changed(office(), "tour", [](ExploreResult& run) {
    run.path_length_m = 200.0;
    run.wall_share = 0.9;
  });
  world.world.path_share = world.world.time_share = 0.0;
  EXPECT_FALSE(world.world.judged());
  EXPECT_EQ(verdicts(world), (std::vector<std::string>{"FINDING E-WALLS", "PASS E-ERROR", "PASS E-CONTACT"}));
}

TEST(EfficiencyWorlds, AreJudgedWhereTheBuildingIsLarge) {
  std::vector<std::string> judged;
  for (const EfficiencyWorld& world : efficiency_worlds()) {
    if (world.judged()) {
      judged.push_back(world.name);
    }
  }
  EXPECT_EQ(judged, (std::vector<std::string>{"office", "hospital"}));
}

TEST(ReproduceParams, TakeAllOrWhatIsNamed) {
  ReproduceParams params;
  EXPECT_TRUE(params.takes_world("demo"));
  EXPECT_TRUE(params.takes_strategy("tour"));
  params.worlds = {"office"};
  params.strategies = {"gain", "tour"};
  EXPECT_FALSE(params.takes_world("demo"));
  EXPECT_TRUE(params.takes_world("office"));
  EXPECT_TRUE(params.takes_strategy("tour"));
  EXPECT_FALSE(params.takes_strategy("frontier"));
}

}  // namespace
}  // namespace seeker::lab
