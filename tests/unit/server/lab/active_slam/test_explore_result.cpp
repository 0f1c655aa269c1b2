#include "server/lab/active_slam/explore_result.hpp"
#include "server/lab/experiments/load_run.hpp"

#include <gtest/gtest.h>

#include "server/lab/active_slam/explore_experiment.hpp"
#include "server/lab/active_slam/explore_picture.hpp"
#include "server/lab/active_slam/reproduce_active_slam.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

ExploreResult result(const std::string& strategy, std::uint64_t seed) {
  ExploreResult r;
  r.world = "office";
  r.strategy = strategy;
  r.seed = seed;
  r.settings = "00ff00ff00ff00ff";
  r.outcome = "COMPLETE";
  r.cause = "nothing is left, \"all\" seen";
  r.robot_time_s = 100.0;
  r.wall_time_s = 0.5;
  r.path_length_m = 40.0;
  r.mean_error_m = 0.05;
  r.mean_robot_trace = 0.001;
  r.final_robot_trace = 0.0005;
  r.wall_share = 0.98;
  r.min_clearance_m = 0.1;
  return r;
}

WorldRuns runs_of_office(std::uint64_t seeds) {
  WorldRuns world;
  world.world.name = "office";
  world.world.robot = "sim";
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    for (const char* strategy : {"active", "horizon", "roam", "frontier", "gain"}) {
      world.runs.push_back(result(strategy, seed));
    }
  }
  for (ExploreResult& run : world.runs) {
    if (run.strategy == "roam") {
      run.mean_error_m = 0.5;
      run.mean_robot_trace = run.final_robot_trace = 0.1;
      run.wall_share = 0.7;
      run.outcome = "TIME_LIMIT";
    }
    run.path_length_m = run.strategy == "gain" ? 45.0 : run.path_length_m;
  }
  return world;
}

std::vector<std::string> failed(const WorldRuns& world) {
  Report report(nullptr);
  check_explorations(world, report);
  std::vector<std::string> ids;
  for (const Check& check : report.checks()) {
    if (!check.passed) {
      ids.push_back(check.id);
    }
  }
  return ids;
}

/// The runs of a strategy, to be spoilt.
template <class Change>
WorldRuns spoilt(WorldRuns world, const std::string& strategy, std::size_t count, Change&& change) {
  for (ExploreResult& run : world.runs) {
    if (run.strategy == strategy && count > 0) {
      change(run);
      --count;
    }
  }
  return world;
}

TEST(ExploreResultFile, WhatIsSavedIsLoaded) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "explore-seed-3.json";
  ExploreResult saved = result("active", 3);
  note_share(saved, 0.02, 1.5);
  ASSERT_TRUE(save(file, saved));
  const auto loaded = load_run<ExploreResult>(file);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->seed, 3U);
  EXPECT_EQ(loaded->cause, saved.cause);
  EXPECT_EQ(loaded->settings, saved.settings);
  EXPECT_EQ(loaded->wall_share, saved.wall_share);
  EXPECT_EQ(loaded->share_path_m, saved.share_path_m);
  std::filesystem::remove(file);
}

TEST(ExploreResult, KnowsThePathToEveryShareOfTheWalls) {
  ExploreResult r = result("horizon", 1);
  EXPECT_EQ(r.path_to_share_m(0.5), r.path_length_m) << "nobody looked";
  note_share(r, 0.2, 3.0);
  note_share(r, 0.1, 4.0);  // a share that sinks again was reached all the same
  note_share(r, 0.55, 9.0);
  EXPECT_EQ(r.path_to_share_m(0.0), 3.0);
  EXPECT_EQ(r.path_to_share_m(0.2), 3.0);
  EXPECT_EQ(r.path_to_share_m(0.21), 9.0);
  EXPECT_EQ(r.path_to_share_m(0.55), 9.0);
  EXPECT_EQ(r.path_to_share_m(0.56), r.path_length_m);
}

TEST(ExploreCurves, AreReadBackAsWritten) {
  const std::vector<ExploreSample> samples = {{0.0, 0.0, 1e-9, 0.0, 1e-9, 0.0, 0.0, 0.0},
                                              {1.5, 0.123456789, 2e-4, 3e-5, 0.5, 12.25, 0.75, 31.5}};
  const auto back = parse_curves(curves_csv(samples));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, samples);
}

TEST(ExploreCurves, WhatIsNoneIsRefusedWithItsLine) {
  EXPECT_FALSE(parse_curves("time_s,error_m\n1,2\n"));
  const std::string text = curves_csv({{}});
  const auto broken = parse_curves(text + "1,2,3\n");
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().message.find("line 3"), std::string::npos) << broken.error().message;
}

class ExploreFiles : public LabFiles {};

TEST_F(ExploreFiles, CurvesOfASeedAreNamedByTheirStrategies) {
  ExploreSpec tour;
  tour.world_file = "office.yaml";
  tour.strategy = api::ExploreStrategy::kTour;
  tour.seed = 3;
  ExploreSpec other = tour;
  other.seed = 4;
  const std::vector<ExploreSample> samples = {{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}};
  std::filesystem::create_directories(explore_file(folder(), tour, ".csv").parent_path());
  std::ofstream(explore_file(folder(), tour, ".csv")) << curves_csv(samples);
  const auto curves = curves_of_seed({tour, other}, 3, folder());
  ASSERT_TRUE(curves) << curves.error().message;
  ASSERT_EQ(curves->size(), 1U);
  EXPECT_EQ(curves->front().name, "tour");
  EXPECT_EQ(curves->front().samples, samples);
  EXPECT_FALSE(curves_of_seed({tour, other}, 4, folder())) << "that run has not been made";
}

TEST_F(ExploreFiles, TablesAreWrittenBesideEachOther) {
  const std::vector<ExploreResult> runs = {result("tour", 3)};
  const Table summary = explore_summary_table(runs);
  ASSERT_TRUE(write_explore_tables(folder(), summary, runs));
  EXPECT_EQ(read(folder() / "table.csv"), summary.csv());
  EXPECT_EQ(read(folder() / "table.md"), summary.markdown());
  EXPECT_EQ(read(folder() / "runs.csv"), explore_runs_table(runs).csv());
}

TEST(ExploreCurves, MeansAreOverTimeAndFinalsAreTheLast) {
  ExploreResult r;
  add_curves({{0.0, 0.1, 1.0, 0.2, 2.0, 0.0, 0.0, 4.0}, {1.0, 0.3, 3.0, 0.4, 8.0, 5.0, 0.5, 9.0}}, r);
  EXPECT_NEAR(r.mean_error_m, 0.2, 1e-12);
  EXPECT_NEAR(r.max_error_m, 0.3, 1e-12);
  EXPECT_NEAR(r.mean_robot_trace, 2.0, 1e-12);
  EXPECT_NEAR(r.final_robot_trace, 3.0, 1e-12);
  EXPECT_NEAR(r.mean_feature_trace, 0.3, 1e-12);
  EXPECT_NEAR(r.final_full_trace, 8.0, 1e-12);
  EXPECT_NEAR(r.floor_m2, 9.0, 1e-12);
}

TEST(ExploreTables, HaveMeanAndSpreadPerWorldAndStrategy) {
  const MeanSpread spread = mean_spread({1.0, 2.0, 3.0});
  EXPECT_NEAR(spread.mean, 2.0, 1e-12);
  EXPECT_NEAR(spread.sigma, 1.0, 1e-12);
  EXPECT_EQ(mean_spread({4.0}).sigma, 0.0);
  const Table table = explore_summary_table(runs_of_office(3).runs);
  EXPECT_NE(table.csv().find("office,active,1-3,3/3,98.0 +- 0.0,"), std::string::npos) << table.csv();
  EXPECT_NE(table.csv().find("office,roam,1-3,0/3,70.0 +- 0.0,"), std::string::npos) << table.csv();
  EXPECT_NE(table.markdown().find("| --- |"), std::string::npos);
}

TEST(S1Checks, GoodRunsPassEverything) { EXPECT_TRUE(failed(runs_of_office(20)).empty()); }

TEST(S1Checks, EachFigureIsCountedAloneOnEighteenOfTwentySeeds) {
  const WorldRuns good = runs_of_office(20);
  const auto bad_error = [](ExploreResult& r) { r.mean_error_m = 0.01; };
  EXPECT_TRUE(failed(spoilt(good, "roam", 2, bad_error)).empty());
  EXPECT_EQ(failed(spoilt(good, "roam", 3, bad_error)), std::vector<std::string>{"S1-ROAM"});
  EXPECT_EQ(failed(spoilt(good, "roam", 3, [](ExploreResult& r) { r.mean_robot_trace = 1e-9; })),
            std::vector<std::string>{"S1-ROAM"});
  EXPECT_EQ(failed(spoilt(good, "roam", 3, [](ExploreResult& r) { r.wall_share = 0.99; })),
            std::vector<std::string>{"S1-ROAM"});
  EXPECT_EQ(failed(spoilt(good, "roam", 10, bad_error)), (std::vector<std::string>{"R1", "S1-ROAM"}));
}

TEST(S1Checks, IncompleteMapsAndLargeErrorsFail) {
  const WorldRuns good = runs_of_office(20);
  const auto incomplete = [](ExploreResult& r) { r.wall_share = 0.96; };
  EXPECT_TRUE(failed(spoilt(good, "active", 2, incomplete)).empty());
  EXPECT_EQ(failed(spoilt(good, "active", 3, incomplete)), std::vector<std::string>{"S1-MAP"});
  EXPECT_EQ(failed(spoilt(good, "active", 3, [](ExploreResult& r) { r.mean_error_m = 0.21; })),
            std::vector<std::string>{"S1-MAP"});
}

TEST(S1Checks, OneContactFails) {
  EXPECT_EQ(failed(spoilt(runs_of_office(20), "gain", 1, [](ExploreResult& r) { r.contacts = 1; })),
            std::vector<std::string>{"S1-CONTACT"});
}

TEST(S1Checks, HorizonMustNotDriveFartherThanTheBestBaseline) {
  const WorldRuns good = runs_of_office(5);
  EXPECT_EQ(failed(spoilt(good, "horizon", 5, [](ExploreResult& r) { r.path_length_m = 41.0; })),
            std::vector<std::string>{"S1-HORIZON"});
  // What it drives for more than the baseline's map is its own affair.
  EXPECT_TRUE(failed(spoilt(good, "horizon", 5, [](ExploreResult& r) {
                r.path_length_m = 60.0;
                note_share(r, 0.97, 40.0);
              })).empty());
  // A shorter way to less of a map does not count.
  EXPECT_EQ(failed(spoilt(good, "horizon", 5,
                          [](ExploreResult& r) {
                            r.path_length_m = 10.0;
                            r.wall_share = 0.9;
                          })),
            (std::vector<std::string>{"S1-MAP", "S1-HORIZON"}));
}

TEST(ExploreFigures, AreDrawnForRunsOfAnyLength) {
  EXPECT_GT(error_figure("none", {}).width_px(), 0);
  EXPECT_GT(floor_figure("none", {}).width_px(), 0);
  const Image traces = trace_figure("two", {{"active", {{0, 0, 1, 2, 3, 4}, {1, 0, 1, 2, 3, 4}}}, {"roam", {}}});
  EXPECT_GT(traces.height_px(), 900);
}

TEST(ExploreFigures, MapShowsWhatIsMissingInItsPlace) {
  ExploreRecord record;
  record.world.max_corner = {10.0, 10.0};
  record.walls.missing.push_back({{5.0, 5.0}, Point2::UnitY(), 4.0});
  const Image image = draw_exploration(record, "missing");
  int red = 0;
  for (int v = 0; v < image.height_px() - 50; ++v) {
    for (int u = 0; u < image.width_px(); ++u) {
      const std::uint8_t* rgb = image.at(u, v);
      red += rgb[0] > 180 && rgb[1] < 90 && rgb[2] < 90 ? 1 : 0;
    }
  }
  EXPECT_GT(red, 500);
}

}  // namespace
}  // namespace seeker::lab
