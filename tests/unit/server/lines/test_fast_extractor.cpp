#include <gtest/gtest.h>
#include <Eigen/LU>

#include "server/lines/fast_extractor.hpp"
#include "tests/unit/server/lines/scenes.hpp"

namespace seeker::lines {
namespace {

using testing::ScannerModel;

TEST(FastExtractor, FindsTheWallsOfARectangleInOrder) {
  const LaserScan scan = scan_of(box_room(-1.0, -2.0, 4.0, 3.0), ScannerModel::full_circle(360, 0.0));
  const ScanLines found = FastExtractor().extract(scan);
  ASSERT_EQ(found.lines.size(), 4U);
  const double expected_r[] = {1.0, 2.0, 4.0, 3.0};
  const double expected_alpha[] = {kPi, -kPi / 2.0, 0.0, kPi / 2.0};
  std::vector<bool> seen(4, false);
  for (const Line& line : found.lines) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (std::abs(wrap_angle(line.alpha_rad - expected_alpha[k])) < 1e-6) {
        EXPECT_NEAR(line.r_m, expected_r[k], 1e-6);
        seen[k] = true;
      }
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 4);
  for (std::size_t k = 1; k < found.lines.size(); ++k) {
    EXPECT_LT(found.lines[k - 1].start_rad, found.lines[k].start_rad);
  }
}

TEST(FastExtractor, GivesEveryNumberOfALine) {
  // y = 2 - x / 2 from (-2, 3) to (2, 1).
  const testing::Room room{{{2.0, 1.0}, {-2.0, 3.0}}};
  const LaserScan scan = scan_of(room, ScannerModel::half_circle(361, 0.0));
  LaserScan ahead = scan_of(room, {.beams = 361, .first_rad = 0.0});
  const ScanLines found = FastExtractor().extract(ahead);
  ASSERT_EQ(found.lines.size(), 1U);
  const Line& line = found.lines.front();
  EXPECT_NEAR(*line.slope, -0.5, 1e-6);
  EXPECT_NEAR(*line.intercept_m, 2.0, 1e-6);
  EXPECT_NEAR(line.r_m, 2.0 / std::hypot(1.0, 0.5), 1e-6);
  EXPECT_NEAR(line.alpha_rad, std::atan2(1.0, 0.5), 1e-6);
  EXPECT_NEAR(line.length_m, std::sqrt(20.0), 0.1);
  EXPECT_LT((line.start - Point2(2.0, 1.0)).norm(), 0.05);
  EXPECT_LT((line.end - Point2(-2.0, 3.0)).norm(), 0.05);
  EXPECT_EQ(found.line_of_beam[line.first_beam], 0);
  EXPECT_EQ(found.line_of_beam[line.first_beam - 1], kNoLine);
  EXPECT_EQ(found.line_of_beam[line.last_beam], 0);
  EXPECT_EQ(line.points, std::count(found.line_of_beam.begin(), found.line_of_beam.end(), 0));
  EXPECT_DOUBLE_EQ(line.start_rad, ahead.angle_rad(line.first_beam));
  EXPECT_LT(line.rms_m, 1e-6);
}

TEST(FastExtractor, AVerticalLineHasNoSlope) {
  const LaserScan scan = scan_of({{{2.0, -1.0}, {2.0, 1.0}}}, ScannerModel::half_circle(361, 0.0));
  const ScanLines found = FastExtractor().extract(scan);
  ASSERT_EQ(found.lines.size(), 1U);
  EXPECT_FALSE(found.lines.front().slope);
  EXPECT_FALSE(found.lines.front().intercept_m);
}

TEST(FastExtractor, ALineAcrossTheCutOfAFullCircleStaysWhole) {
  // The wall x = -2 lies behind a scanner whose cut is at 180 degrees.
  const LaserScan scan = scan_of({{{-2.0, 1.0}, {-2.0, -1.0}}}, ScannerModel::full_circle(360, 0.0), 0.005);
  const ScanLines found = FastExtractor().extract(scan);
  ASSERT_EQ(found.lines.size(), 1U);
  const Line& line = found.lines.front();
  EXPECT_GT(line.first_beam, line.last_beam);
  EXPECT_GT(line.start_rad, line.end_rad);
  EXPECT_NEAR(line.length_m, 2.0, 0.1);
  EXPECT_EQ(line.points, 53);
}

TEST(FastExtractor, OneWildReturnDoesNotCutAWall) {
  LaserScan scan = scan_of({{{2.0, -1.5}, {2.0, 1.5}}}, ScannerModel::half_circle(361, 0.0), 0.01);
  scan.ranges_m[180] += 0.12F;
  const ScanLines found = FastExtractor().extract(scan);
  ASSERT_EQ(found.lines.size(), 1U);
  EXPECT_EQ(found.line_of_beam[180], kNoLine);
  EXPECT_NEAR(found.lines.front().r_m, 2.0, 0.005);
}

TEST(FastExtractor, UnusableBeamsAreLeftOutAndGoodOnesWeighMore) {
  LaserScan scan = scan_of({{{2.0, -1.5}, {2.0, 1.5}}}, ScannerModel::half_circle(361, 0.0), 0.005);
  scan.quality.assign(scan.ranges_m.size(), 100);
  scan.quality[180] = 0;
  scan.ranges_m[180] = 1.0F;
  FastExtractor extractor;
  const ScanLines even = extractor.extract(scan);
  ASSERT_EQ(even.lines.size(), 1U);
  EXPECT_EQ(even.line_of_beam[180], kNoLine);
  // All weight on the lower half: a line that is unsure of its direction.
  for (std::size_t k = 181; k < 361; ++k) {
    scan.quality[k] = 1;
  }
  const ScanLines uneven = extractor.extract(scan);
  ASSERT_EQ(uneven.lines.size(), 1U);
  EXPECT_GT(uneven.lines.front().covariance(1, 1), 2.0 * even.lines.front().covariance(1, 1));
}

TEST(FastExtractor, TakesScansWithoutLines) {
  FastExtractor extractor;
  LaserScan scan;
  scan.angle_step_rad = 0.01;
  scan.range_max_m = 10.0;
  EXPECT_TRUE(extractor.extract(scan).lines.empty());
  scan.ranges_m.assign(1, 2.0F);
  EXPECT_TRUE(extractor.extract(scan).lines.empty());
  scan.ranges_m.assign(361, kNoReturn);
  const ScanLines none = extractor.extract(scan);
  EXPECT_TRUE(none.lines.empty());
  EXPECT_EQ(none.line_of_beam.size(), 361U);
  EXPECT_TRUE(std::isfinite(none.range_sigma_m));
}

TEST(FastExtractor, CoincidingPointsAreNoLine) {
  LaserScan scan;
  scan.angle_step_rad = 1e-12;
  scan.range_max_m = 10.0;
  scan.ranges_m.assign(50, 2.0F);
  FastParams params;
  params.min_length_m = 0.0;
  for (const Line& line : FastExtractor(params).extract(scan).lines) {
    EXPECT_TRUE(is_finite(line));
  }
}

TEST(FastExtractor, RandomRangesNeverGiveNaN) {
  Rng rng(11);
  FastParams params;
  params.min_points = 3;
  params.min_length_m = 0.0;
  FastExtractor extractor(params);
  for (int scan_number = 0; scan_number < 300; ++scan_number) {
    LaserScan scan;
    scan.angle_min_rad = rng.uniform(-4.0, 4.0);
    scan.range_max_m = rng.uniform() < 0.5 ? 0.0 : 30.0;
    const auto n = rng.below(400);
    scan.angle_step_rad = (rng.uniform() < 0.5 ? 1.0 : -1.0) * kTwoPi / (1.0 + static_cast<double>(n));
    for (std::uint64_t k = 0; k < n; ++k) {
      const double kind = rng.uniform();
      scan.ranges_m.push_back(kind < 0.1   ? kNoReturn
                              : kind < 0.2 ? 0.0F
                              : kind < 0.6 ? 2.0F
                                           : static_cast<float>(rng.uniform(0.0, 40.0)));
    }
    for (const Line& line : extractor.extract(scan).lines) {
      EXPECT_TRUE(is_finite(line)) << "scan " << scan_number;
    }
  }
}

TEST(FastExtractor, NoiseOfTheScanIsFoundInTheScan) {
  const testing::Room room = box_room(-4.0, -3.0, 5.0, 4.0);
  FastExtractor extractor;
  for (const double sigma_m : {0.004, 0.01, 0.03}) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      sum += extractor.extract(scan_of(room, ScannerModel::full_circle(360, 0.0), sigma_m, seed)).range_sigma_m;
    }
    EXPECT_NEAR(sum / 20.0, sigma_m, 0.05 * sigma_m);
  }
}

TEST(FastExtractor, WhatTheBearingsAreOffByIsNotCountedTwice) {
  // Beams that graze a wall: a bearing that is off shows in their ranges, from which the noise is estimated.
  ScannerModel model{.beams = 91, .first_rad = deg_to_rad(60.0), .step_rad = deg_to_rad(0.2)};
  model.bearing_sigma_rad = 0.0008;
  FastParams params;
  params.bearing_sigma_rad = model.bearing_sigma_rad;
  FastExtractor extractor(params);
  constexpr int kScans = 1000;
  double nees = 0.0;
  int whole = 0;  // here and there noise splits the wall
  for (std::uint64_t seed = 1; seed <= kScans; ++seed) {
    const ScanLines found = extractor.extract(scan_of({{{1.0, 0.0}, {1.0, 20.0}}}, model, 0.01, seed));
    if (found.lines.size() != 1U) {
      continue;
    }
    ++whole;
    const Line& line = found.lines.front();
    const Point2 error(line.r_m - 1.0, wrap_angle(line.alpha_rad));
    nees += error.dot(line.covariance.inverse() * error);
  }
  ASSERT_GT(whole, 9 * kScans / 10);
  // A mean of 1000 values of chi-square with 2 degrees of freedom: 2 with a standard deviation of 0.06.
  EXPECT_NEAR(nees / whole, 2.0, 0.25);
}

TEST(FastExtractor, AnOpenDoorIsNoCornerOfTheWall) {
  // Through the doors of 0.9 m the beams return nothing: left and right of them are neighbours among the returns.
  const testing::Room room{{{2.0, -3.0}, {2.0, -1.35}}, {{2.0, -0.45}, {2.0, 0.45}}, {{2.0, 1.35}, {2.0, 3.0}}};
  FastExtractor extractor;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const ScanLines found = extractor.extract(scan_of(room, ScannerModel::half_circle(181, 0.0), 0.01, seed));
    ASSERT_GE(found.lines.size(), 3U);
    for (const Line& line : found.lines) {
      EXPECT_LT(line.length_m, 1.7) << "seed " << seed;
    }
  }
}

TEST(FastExtractor, NoiseThatGrowsWithRangeIsNoticed) {
  ScannerModel model = ScannerModel::full_circle(1440, 0.0);
  model.slope = 0.01;
  const LaserScan scan = scan_of(box_room(-0.8, -1.0, 12.0, 9.0), model, 0.003);
  FastExtractor extractor;
  ASSERT_FALSE(extractor.extract(scan).lines.empty());
  EXPECT_NEAR(extractor.noise().sigma_m(10.0), 0.1, 0.025);
  EXPECT_LT(extractor.noise().sigma_m(1.0), 0.025);
}

TEST(FastExtractor, AFewBeamsBelieveTheNominalNoise) {
  const LaserScan scan = scan_of({{{2.0, -1.0}, {2.0, 1.0}}}, ScannerModel::half_circle(25, 0.0), 0.0);
  FastParams params;
  params.noise.nominal_sigma_m = 0.023;
  FastExtractor extractor(params);
  EXPECT_DOUBLE_EQ(extractor.extract(scan).range_sigma_m, 0.023);
}

TEST(FastExtractor, FarLinesOfManyBeamsKeepTheirDigits) {
  // 8192 beams, the first wall 60 m away: the worst case of the running sums.
  ScannerModel model{.beams = 8192, .first_rad = -kPi / 2.0, .step_rad = kPi / 8192.0, .range_max_m = 100.0};
  const LaserScan scan = scan_of(box_room(-5.0, -60.0, 50.0, 60.0), model);
  for (const Line& line : FastExtractor().extract(scan).lines) {
    const double quarter = std::remainder(line.alpha_rad, kPi / 2.0);
    EXPECT_NEAR(quarter, 0.0, 2e-5);
  }
}

}  // namespace
}  // namespace seeker::lines
