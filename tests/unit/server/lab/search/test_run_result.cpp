#include "server/lab/experiments/load_run.hpp"
#include "server/lab/search/run_result.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>

#include "server/lab/experiments/table.hpp"
#include "server/lab/search/hit_rate_study.hpp"
#include "server/lab/search/reproduce_search.hpp"
#include "server/lab/search/summary.hpp"

namespace seeker::lab {
namespace {

class RunResultFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string("lab-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

RunResult sample(std::uint64_t seed) {
  RunResult result;
  result.world = "paper-a";
  result.strategy = "paper";
  result.seed = seed;
  result.settings = "00ff00ff00ff00ff";
  result.found = true;
  result.outcome = "TARGET_FOUND";
  result.cause = "target 'cross' \"seen\"\n\twith a tab and a back\\slash";
  result.path_length_m = 12.25;
  result.event_hash = "0123456789012345";
  FindScore find;
  find.target = "cross";
  find.bearing_error_deg = 3.25;
  find.cells_searched = 18;
  result.first_find = find;
  result.last_find = result.first_find;
  result.last_find->position_error_m = 0.125;
  return result;
}

TEST_F(RunResultFile, WhatIsSavedIsLoaded) {
  const RunResult saved = sample(3);
  ASSERT_TRUE(save(folder_ / "seed-3.json", saved));
  const auto loaded = load_run<RunResult>(folder_ / "seed-3.json");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->seed, 3U);
  EXPECT_EQ(loaded->cause, saved.cause);
  EXPECT_EQ(loaded->settings, saved.settings);
  EXPECT_EQ(loaded->event_hash, saved.event_hash);
  EXPECT_DOUBLE_EQ(loaded->path_length_m, 12.25);
  ASSERT_TRUE(loaded->first_find && loaded->last_find);
  EXPECT_FALSE(loaded->first_find->position_error_m.has_value());
  EXPECT_DOUBLE_EQ(loaded->last_find->position_error_m.value_or(-1.0), 0.125);
  EXPECT_EQ(loaded->first_find->cells_searched, 18);
}

TEST_F(RunResultFile, ARunWithoutFindHasNone) {
  RunResult saved = sample(4);
  saved.first_find.reset();
  saved.last_find.reset();
  ASSERT_TRUE(save(folder_ / "seed-4.json", saved));
  const auto loaded = load_run<RunResult>(folder_ / "seed-4.json");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_FALSE(loaded->first_find.has_value());
}

TEST_F(RunResultFile, ANewerSchemaOrHalfAFileIsRefused) {
  RunResult newer = sample(1);
  newer.schema = 2;
  ASSERT_TRUE(save(folder_ / "newer.json", newer));
  const auto refused = load_run<RunResult>(folder_ / "newer.json");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kUnsupportedVersion);
  std::ofstream(folder_ / "half.json") << "{\n  \"schema\": 1,\n  \"world\": \"pap";
  EXPECT_FALSE(load_run<RunResult>(folder_ / "half.json"));
}

TEST(Summary, GroupsRunsByWorldAndStrategyAndNamesTheSeeds) {
  std::vector<RunResult> runs = {sample(1), sample(2), sample(4), sample(1)};
  runs[2].found = false;
  runs[3].strategy = "plan";
  const auto groups = summarise(runs);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].seeds, "1-2,4");
  EXPECT_EQ(groups[0].found, 2);
  EXPECT_EQ(groups[0].runs, 3);
  EXPECT_DOUBLE_EQ(groups[0].path_length_m, 12.25);
  EXPECT_NE(summary_csv(groups).find("paper-a,paper,\"1-2,4\",3,2"), std::string::npos) << summary_csv(groups);
}

TEST(Summary, EveryRowOfTheTableHasAsManyFieldsAsItsHeader) {
  RunResult without_find = sample(2);
  without_find.first_find.reset();
  without_find.last_find.reset();
  const std::string csv = runs_csv({sample(1), without_find});
  std::vector<long> commas;
  std::size_t begin = 0;
  while (begin < csv.size()) {
    const std::size_t end = csv.find('\n', begin);
    commas.push_back(std::count(csv.begin() + static_cast<long>(begin), csv.begin() + static_cast<long>(end), ','));
    begin = end + 1;
  }
  ASSERT_EQ(commas.size(), 3U);
  EXPECT_EQ(commas[1], commas[0]);
  EXPECT_EQ(commas[2], commas[0]);
}

TEST(Checks, ALayoutPassesOnlyWhenEveryRunFoundTheTargetWithinTheLimits) {
  EXPECT_TRUE(check_layout({sample(1), sample(2)}, 20).passed);
  EXPECT_FALSE(check_layout({}, 20).passed);

  RunResult lost = sample(2);
  lost.found = false;
  EXPECT_FALSE(check_layout({sample(1), lost}, 20).passed);

  RunResult oblique = sample(2);
  oblique.last_find->bearing_error_deg = 5.1;
  EXPECT_FALSE(check_layout({sample(1), oblique}, 20).passed);

  RunResult away = sample(2);
  away.last_find->position_error_m = 0.31;
  EXPECT_FALSE(check_layout({sample(1), away}, 20).passed);
}

TEST(Checks, ThePrintedRobotIsComparedFigureByFigure) {
  RunResult late = sample(2);
  late.first_find->cells_searched = 22;
  late.first_find->bearing_error_deg = 5.5;
  const std::vector<Check> rows = check_printed_robot({sample(1), late}, {"paper-a", 20, 4.0});
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_TRUE(rows[0].passed);
  EXPECT_THAT(line_of(rows[1]), ::testing::HasSubstr("quantity=cells printed=20 ours=20.0 range=18..22"));
  EXPECT_TRUE(rows[1].passed) << "the printed cell lies among ours";
  EXPECT_THAT(line_of(rows[2]), ::testing::HasSubstr("printed=4 ours=4.4 worst=5.5 limit=5"));
  EXPECT_EQ(verdict_of(rows[2]), "FAIL");
  late.localisation_error_deg = 0.6;
  EXPECT_EQ(verdict_of(check_printed_robot({sample(1), late}, {"paper-a", 20, 4.0})[2]), "FINDING")
      << "the heading of the wheels explains it";
  EXPECT_EQ(verdict_of(check_printed_robot({sample(1), late}, {"paper-b", 17, 3.0})[1]), "FINDING");
  EXPECT_FALSE(check_printed_robot({}, {"paper-a", 20, 4.0})[0].passed);
}

TEST(Checks, AWorldWithoutTargetMustEndWithNothingFound) {
  RunResult ended = sample(1);
  ended.found = false;
  ended.outcome = "NOT_FOUND_AREA_COVERED";
  EXPECT_TRUE(check_empty("sim", {ended}).passed);
  RunResult mistaken = ended;
  mistaken.false_finds = 1;
  EXPECT_FALSE(check_empty("sim", {ended, mistaken}).passed);
  EXPECT_FALSE(check_empty("sim", {}).passed);
}

TEST(Checks, ALineNamesIdAndFigures) {
  EXPECT_EQ(line_of({.id = "R5", .passed = true, .figures = {{"bearing_deg", "3.2"}, {"limit", "5"}}}),
            "PASS R5 bearing_deg=3.2 limit=5");
}

TEST(Checks, ThePrintedBearingsAreReproduced) {
  Report report(nullptr);
  check_bearings(report);
  EXPECT_EQ(report.checks().size(), 2U);
  EXPECT_TRUE(report.passed());
}

TEST(HitRateFit, RecoversTheCurveThatTheHitsWereDrawnFrom) {
  search::HitRate truth;
  truth.best = 0.9;
  truth.half_size_px = 10.0;
  truth.size_slope_px = 2.0;
  std::vector<HitRateBin> bins;
  for (double range_m = 0.5; range_m < 5.0; range_m += 0.25) {
    constexpr int kPictures = 1000;
    HitRateBin bin;
    bin.range_m = range_m;
    bin.pictures = kPictures;
    bin.hits = static_cast<int>(std::lround(kPictures * truth.probability(range_m, 0.3)));
    bins.push_back(bin);
  }
  const search::HitRate fit = fit_hit_rate(bins, 0.3, search::HitRate{});
  for (double range_m = 0.6; range_m < fit.max_range_m; range_m += 0.2) {
    EXPECT_NEAR(fit.probability(range_m, 0.3), truth.probability(range_m, 0.3), 0.03) << range_m;
  }
}

}  // namespace
}  // namespace seeker::lab
