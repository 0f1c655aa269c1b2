#include "server/lines/regression_extractor.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/core/pose2.hpp"
#include "server/lines/make_extractor.hpp"
#include "tests/unit/server/lines/scenes.hpp"

namespace seeker::lines {
namespace {

using testing::ScannerModel;

LaserScan box_scan(std::uint64_t seed = 1) {
  return scan_of(box_room(-2.0, -2.5, 3.0, 2.0), ScannerModel::half_circle(181, 0.0), 0.01, seed);
}

const Line* line_towards(const ScanLines& found, double alpha_rad) {
  for (const Line& line : found.lines) {
    if (std::abs(wrap_angle(line.alpha_rad - alpha_rad)) < 0.1) {
      return &line;
    }
  }
  return nullptr;
}

TEST(RegressionExtractor, FindsTheWallsOfARoom) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ScanLines found = RegressionExtractor().extract(box_scan(seed));
    EXPECT_EQ(found.lines.size(), 3U) << "seed " << seed;
    const Line* ahead = line_towards(found, 0.0);
    ASSERT_NE(ahead, nullptr) << "seed " << seed;
    EXPECT_NEAR(ahead->r_m, 3.0, 0.02);
    EXPECT_NEAR(ahead->alpha_rad, 0.0, 0.02);
    EXPECT_NEAR(ahead->length_m, 4.5, 0.25) << "seed " << seed;
  }
}

TEST(RegressionExtractor, CutsNeighboursWhereTheirLinesMeet) {
  // A corner of 150 degrees: the windows about it turn slowly, so that the runs on both walls reach over it.
  const testing::Room room{{{2.0, -1.5}, {2.0, 0.0}}, {{2.0, 0.0}, {1.25, 1.3}}};
  const ScanLines found = RegressionExtractor().extract(scan_of(room, ScannerModel::half_circle(361, 0.0), 0.01, 3));
  ASSERT_EQ(found.lines.size(), 2U);
  EXPECT_NEAR(found.lines[0].end.y(), 0.0, 0.08);
  EXPECT_NEAR(found.lines[1].start.y(), 0.0, 0.08);
  EXPECT_LE(found.lines[0].last_beam, found.lines[1].first_beam);
}

TEST(RegressionExtractor, FindsNoWallAcrossACornerThatIsNear) {
  // The windows about a near corner turn so slowly that neighbours agree; a chord would have inliers at both its ends.
  Rng rng(1);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const double ahead_m = rng.uniform(0.35, 1.0);
    const double left_m = rng.uniform(0.35, 1.0);
    const Pose2 base_T_room{0.0, 0.0, rng.uniform(-1.0, 1.0)};
    const Point2 meet = base_T_room * Point2(ahead_m, left_m);
    const testing::Room corner{{base_T_room * Point2(ahead_m, -2.0), meet}, {meet, base_T_room * Point2(-2.0, left_m)}};
    const ScanLines found =
        RegressionExtractor().extract(scan_of(corner, ScannerModel::half_circle(181, 0.0), 0.01, seed));
    for (const Line& line : found.lines) {
      const double off_axis_rad = std::remainder(line.alpha_rad - base_T_room.theta_rad, std::numbers::pi / 2.0);
      EXPECT_NEAR(off_axis_rad, 0.0, 0.2) << "walls at " << ahead_m << ", " << left_m << " m, seed " << seed;
    }
  }
}

TEST(RegressionExtractor, JoinsAWallAcrossABeamWithoutReturn) {
  LaserScan scan = scan_of({{{1.5, -1.0}, {1.5, 1.0}}}, ScannerModel::half_circle(181, 0.0), 0.005);
  scan.ranges_m[90] = kNoReturn;
  EXPECT_EQ(RegressionExtractor().extract(scan).lines.size(), 1U);
}

TEST(RegressionExtractor, KeepsCollinearWallsApartWhenADoorIsBetween) {
  const testing::Room room{{{1.5, -1.5}, {1.5, -0.45}}, {{1.5, 0.45}, {1.5, 1.5}}};
  EXPECT_EQ(RegressionExtractor().extract(scan_of(room, ScannerModel::half_circle(361, 0.0), 0.01)).lines.size(), 2U);
}

TEST(RegressionExtractor, LeavesOutReturnsBeyondItsLimits) {
  RegressionParams params;
  params.max_range_m = 2.0;
  const ScanLines found = RegressionExtractor(params).extract(box_scan());
  EXPECT_EQ(line_towards(found, 0.0), nullptr);
}

TEST(RegressionExtractor, NeverGivesNaNForRandomRanges) {
  Rng rng(12);
  for (int number = 0; number < 100; ++number) {
    LaserScan scan;
    scan.angle_min_rad = -1.0;
    scan.angle_step_rad = kTwoPi / 200.0;
    for (int k = 0; k < 200; ++k) {
      scan.ranges_m.push_back(rng.uniform() < 0.5 ? 2.0F : static_cast<float>(rng.uniform(0.0, 3.0)));
    }
    for (const Line& line : RegressionExtractor().extract(scan).lines) {
      EXPECT_TRUE(is_finite(line)) << "scan " << number;
    }
  }
}

TEST(MakeExtractor, EveryKindFindsTheWallsOfARoom) {
  for (const ExtractorKind kind : kExtractorKinds) {
    ExtractorParams params;
    params.kind = kind;
    const LaserScan scan = scan_of(box_room(-2.0, -2.5, 3.0, 2.0), ScannerModel::full_circle(720, 0.0), 0.002);
    const ScanLines found = make_extractor(params)->extract(scan);
    EXPECT_EQ(found.lines.size(), 4U) << to_string(kind);
    EXPECT_EQ(found.line_of_beam.size(), 720U) << to_string(kind);
    EXPECT_GT(found.noise.floor_m, 0.0) << to_string(kind);
    EXPECT_EQ(found.history.empty(), kind != ExtractorKind::kFiveModes) << to_string(kind);
  }
}

TEST(MakeExtractor, EveryKindTakesScansWithoutLines) {
  for (const ExtractorKind kind : kExtractorKinds) {
    ExtractorParams params;
    params.kind = kind;
    const std::unique_ptr<Extractor> extractor = make_extractor(params);
    LaserScan scan;
    scan.angle_step_rad = 0.01;
    scan.range_max_m = 10.0;
    for (const std::size_t beams : {0U, 1U, 2U, 7U}) {
      scan.ranges_m.assign(beams, 1.0F);
      EXPECT_TRUE(extractor->extract(scan).lines.empty()) << to_string(kind) << " " << beams;
    }
    scan.ranges_m.assign(300, kNoReturn);
    EXPECT_TRUE(extractor->extract(scan).lines.empty()) << to_string(kind);
  }
}

}  // namespace
}  // namespace seeker::lines
