#include <numeric>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/lab/line_detection/line_scene.hpp"
#include "server/lab/line_detection/reproduce_line_detection.hpp"
#include "tests/support/data.hpp"

namespace seeker::lab {
namespace {

TEST(Table1Scene, HasTheLinesOfTheTable) {
  // r and alpha as derived in spec S5.7.
  const std::array r_mm{1943.6, 855.5, 1241.8, 1681.5, 857.0};
  const std::array alpha_deg{-148.8, 31.5, 121.4, 119.3, 31.4};
  for (std::size_t k = 0; k < kTable1.size(); ++k) {
    EXPECT_NEAR(1000.0 * true_r_m(kTable1[k]), r_mm[k], 0.5) << kTable1[k].name;
    EXPECT_NEAR(rad_to_deg(true_alpha_rad(kTable1[k])), alpha_deg[k], 0.06) << kTable1[k].name;
  }
  Rng rng(1);
  const LaserScan scan = table1_scan(rng);
  ASSERT_TRUE(validate(scan));
  EXPECT_EQ(std::count(scan.ranges_m.begin(), scan.ranges_m.end(), kNoReturn), 360 - 89 - 9 - 25 - 29 - 9);
}

TEST(ReproduceS5, EveryConditionHoldsAndAllFilesAreWritten) {
  const auto out = std::filesystem::temp_directory_path() / "seeker-test-s5";
  std::filesystem::remove_all(out);
  ReproduceParams params;
  params.out = out;
  params.config = testing::source_file("config");  // of the recorded RPLIDAR, where SEEKER_DATA names the recordings
  params.seeds.resize(20);
  std::iota(params.seeds.begin(), params.seeds.end(), 1U);
  Report report(nullptr);
  const Status done = reproduce_line_detection(params, report);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_GE(report.checks().size(), 7U + 5U + 2U + 2U) << "rows of Table 1, threshold history, scenes";
  for (const Check& check : report.checks()) {
    EXPECT_TRUE(check.passed || check.finding) << line_of(check);
  }
  for (const char* name : {"fig3-lines.png", "fig4-fits.png", "fig-thresholds.png", "table1.csv", "thresholds.csv",
                           "history.csv", "sensitivity.csv"}) {
    EXPECT_TRUE(std::filesystem::exists(out / name)) << name;
  }
  std::filesystem::remove_all(out);
}

TEST(ReproduceS5, RefusesNoSeeds) {
  ReproduceParams params;
  params.out = std::filesystem::temp_directory_path() / "seeker-test-s5-none";
  Report report(nullptr);
  EXPECT_FALSE(reproduce_line_detection(params, report));
  std::filesystem::remove_all(params.out);
}

}  // namespace
}  // namespace seeker::lab
