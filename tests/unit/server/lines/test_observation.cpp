#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "server/lines/fast_extractor.hpp"
#include "server/lines/observation.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/lines/scenes.hpp"

namespace seeker::lines {
namespace {

using seeker::testing::Pose2Near;
using testing::ScannerModel;

std::vector<SegmentObservation> observed(const LaserScan& scan, const ObservationParams& params = {}) {
  return observe(scan, FastExtractor().extract(scan), params);
}

TEST(Observation, TheFrameSitsOnTheWallAndLooksIntoIt) {
  LaserScan scan = scan_of({{{3.0, -1.0}, {3.0, 2.0}}}, ScannerModel::half_circle(721, 0.0));
  scan.base_T_laser = {0.2, 0.1, kPi / 2.0};
  const auto seen = observed(scan);
  ASSERT_EQ(seen.size(), 1U);
  // In the frame laser: mid-point (3, 0.5), x axis to the right, y axis into the wall.
  const Pose2 expected = scan.base_T_laser * Pose2{3.0, 0.5, -kPi / 2.0};
  EXPECT_THAT(seen[0].base_T_segment, Pose2Near(expected, 0.02, 1e-4));
  EXPECT_NEAR(seen[0].length_m, 3.0, 0.03);
  EXPECT_TRUE(seen[0].real[kLeft]);
  EXPECT_TRUE(seen[0].real[kRight]);
}

TEST(Observation, EndsAtCornersAndFreeEndsAreReal) {
  // An L: the wall ahead ends free on the right and in a corner on the left.
  const testing::Room room{{{3.0, -1.0}, {3.0, 2.0}}, {{3.0, 2.0}, {0.5, 2.0}}};
  const auto seen = observed(scan_of(room, ScannerModel::half_circle(721, 0.0)));
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_TRUE(seen[0].real[kLeft]);
  EXPECT_TRUE(seen[0].real[kRight]);
  EXPECT_TRUE(seen[1].real[kRight]);
}

TEST(Observation, EndsBehindAnObstacleAreVirtual) {
  // A post before the right part of the wall hides where it ends.
  const testing::Room room{{{3.0, -2.0}, {3.0, 2.0}}, {{1.0, -0.6}, {1.0, -0.2}}};
  const auto seen = observed(scan_of(room, ScannerModel::half_circle(721, 0.0)));
  for (const SegmentObservation& segment : seen) {
    if (segment.base_T_segment.x_m < 2.0) {
      continue;
    }
    const bool left_part = segment.base_T_segment.y_m > 0.0;
    EXPECT_EQ(segment.real[kRight], !left_part);
    EXPECT_EQ(segment.real[kLeft], left_part);
  }
}

TEST(Observation, EndsAtTheLimitsOfSightAreVirtual) {
  // A corridor wall that goes on beyond the range limit on the left and out of the field of view on the right.
  const testing::Room room{{{-10.0, 1.0}, {30.0, 1.0}}};
  ScannerModel model = ScannerModel::half_circle(721, 0.0);
  model.range_max_m = 5.0;
  const auto seen = observed(scan_of(room, model));
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_FALSE(seen[0].real[kLeft]);
  EXPECT_FALSE(seen[0].real[kRight]);
}

TEST(Observation, AWallWhoseReturnsGetLostAtItsFlatEndDoesNotEndThere) {
  // One metre beside a wall: what lies 6 m ahead and more is seen at less than 10 degrees.
  const testing::Room room{{{0.0, 1.0}, {8.0, 1.0}}};
  ScannerModel model = ScannerModel::half_circle(721, 0.0);
  model.range_max_m = 20.0;
  LaserScan scan = scan_of(room, model);
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    if (scan.ranges_m[beam] > 6.2F) {
      scan.ranges_m[beam] = kNoReturn;
    }
  }
  const auto seen = observed(scan);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_FALSE(seen[0].real[kRight]);
  ObservationParams trusting;
  trusting.lost_rad = 0.0;
  EXPECT_TRUE(observed(scan, trusting)[0].real[kRight]);
}

TEST(Observation, AnEndThatTheBeamsDoNotResolveIsVirtual) {
  // A wall that ends 4 m ahead: beams of half a degree meet it every 0.15 m there, beams of one degree every 0.3 m.
  const testing::Room room{{{0.0, 1.0}, {4.0, 1.0}}};
  const auto fine = observed(scan_of(room, ScannerModel::half_circle(361, 0.0)));
  const auto coarse = observed(scan_of(room, ScannerModel::half_circle(181, 0.0)));
  ASSERT_EQ(fine.size(), 1U);
  ASSERT_EQ(coarse.size(), 1U);
  EXPECT_TRUE(fine[0].real[kRight]);
  EXPECT_FALSE(coarse[0].real[kRight]);
}

TEST(Observation, EndsSeenFlatlyAreMeasuredNeitherTooNearNorTooFar) {
  // One metre beside a wall that ends some 4 m ahead, and of another that begins there: where the beams meet them
  // differs from place to place, and beams lie further apart the farther they go.
  constexpr int kPlaces = 400;
  double too_far_m = 0.0;
  for (int place = 0; place < kPlaces; ++place) {
    const double end_m = 3.8 + 0.001 * place;
    const auto seen = observed(scan_of({{{0.0, 1.0}, {end_m, 1.0}}}, ScannerModel::half_circle(361, 0.0)));
    ASSERT_EQ(seen.size(), 1U);
    ASSERT_TRUE(seen[0].real[kRight]);
    const double told_m = (seen[0].base_T_segment * Point2(0.5 * seen[0].length_m, 0.0)).x();
    EXPECT_NEAR(told_m, end_m, 0.5 * 0.17);
    too_far_m += (told_m - end_m) / kPlaces;
  }
  EXPECT_NEAR(too_far_m, 0.0, 0.001);
}

TEST(Observation, AWallBeginsWhereABeamHitsTheInnerSideOfItsDoorPost) {
  int real = 0;
  for (int place = 0; place < 20; ++place) {
    const double post_m = 3.0 + 0.01 * place;
    const testing::Room room{{{post_m, 1.0}, {post_m + 1.5, 1.0}}, {{post_m, 1.0}, {post_m, 1.04}}, {{0, 2}, {6, 2}}};
    const auto seen = observed(scan_of(room, ScannerModel::half_circle(361, 0.0)));
    const auto wall = std::find_if(seen.begin(), seen.end(), [&](const SegmentObservation& segment) {
      return std::abs(segment.base_T_segment.y_m - 1.0) < 0.05 && segment.length_m > 0.5;
    });
    ASSERT_NE(wall, seen.end());
    if (!wall->real[kLeft]) {
      continue;  // two beams hit the post
    }
    ++real;
    const double told_m = (wall->base_T_segment * Point2(-0.5 * wall->length_m, 0.0)).x();
    EXPECT_NEAR(told_m, post_m, 0.01) << "beams meet the wall every 0.1 m";
  }
  EXPECT_GE(real, 10);
}

TEST(Observation, GrazedLinesAreLeftOut) {
  const testing::Room room{{{2.0, 0.1}, {6.0, 0.1}}};
  ScannerModel model{.beams = 8001, .first_rad = -0.4, .step_rad = 1e-4};
  const LaserScan scan = scan_of(room, model);
  ASSERT_EQ(FastExtractor().extract(scan).lines.size(), 1U);
  EXPECT_TRUE(observed(scan).empty());
  ObservationParams params;
  params.grazing_rad = 0.01;
  EXPECT_EQ(observed(scan, params).size(), 1U);
}

TEST(Observation, TheCovarianceMovesToTheMiddleOfTheSegment) {
  const LaserScan scan = scan_of({{{3.0, 0.5}, {3.0, 2.0}}}, ScannerModel::half_circle(361, 0.0), 0.01);
  FastExtractor extractor;
  const ScanLines found = extractor.extract(scan);
  const auto seen = observe(scan, found);
  ASSERT_EQ(seen.size(), 1U);
  // Across the middle of a segment the line is known best, and hardly depends on its direction.
  const Matrix2& c = seen[0].covariance;
  EXPECT_LT(c(0, 0), 0.5 * found.lines[0].covariance(0, 0));
  EXPECT_LT(std::abs(c(0, 1)) / std::sqrt(c(0, 0) * c(1, 1)), 0.3);
  EXPECT_NEAR(c.determinant(), found.lines[0].covariance.determinant(), 1e-3 * c.determinant());
  ObservationParams rough;
  rough.wall_sigma_m = 0.02;
  rough.wall_sigma_rad = 0.01;
  const Matrix2 more = observe(scan, found, rough)[0].covariance - c;
  EXPECT_NEAR(more(0, 0), 4e-4, 1e-12);
  EXPECT_NEAR(more(1, 1), 1e-4, 1e-12);
}

TEST(Observation, EndsAreLessSureWhereTheWallIsSeenFlatly) {
  const LaserScan scan = scan_of({{{1.0, 0.0}, {1.0, 4.0}}}, ScannerModel::half_circle(361, 0.0), 0.01);
  const auto seen = observed(scan);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_GT(seen[0].end_sigma_m[kLeft], 4.0 * seen[0].end_sigma_m[kRight]);
}

/// A wall 1 m to the left that ends free after `end_m`, by a scanner of 1 degree whose beams begin at `phase_rad`: what
/// it reads of that end, where it takes it for one.
struct EndSeen {
  std::optional<double> off_m;  ///< read beyond the end
  double clear_m = 0.0;         ///< along the wall, from the scanner on
};

EndSeen end_seen(double end_m, double phase_rad) {
  ScannerModel model = ScannerModel::half_circle(181, 0.0);
  model.first_rad += phase_rad;
  const auto seen = observed(scan_of({{{-1.0, 1.0}, {end_m, 1.0}}}, model));
  EXPECT_EQ(seen.size(), 1U);
  const SegmentObservation& wall = seen.front();
  const double end_x_m = (wall.base_T_segment * Point2(0.5 * wall.length_m, 0.0)).x();
  return {wall.real[kRight] ? std::optional(end_x_m - end_m) : std::nullopt, wall.clear_m};
}

TEST(Observation, AnEndThatIsClearIsReadRightOnAverageWhereverTheBeamsFall) {
  constexpr int kPhases = 24;
  int clear = 0;
  int short_read = 0;
  for (double end_m = 0.5; end_m < 5.0; end_m += 0.05) {
    double sum_m = 0.0;
    int real = 0;
    double clear_m = 0.0;
    for (int k = 0; k < kPhases; ++k) {
      const EndSeen seen = end_seen(end_m, deg_to_rad(1.0) * k / kPhases);
      clear_m = seen.clear_m;
      sum_m += seen.off_m.value_or(0.0);
      real += seen.off_m ? 1 : 0;
    }
    const double spacing_m = deg_to_rad(1.0) * (1.0 + end_m * end_m);
    if (end_m <= clear_m) {
      ++clear;
      EXPECT_EQ(real, kPhases) << end_m;
      EXPECT_LT(std::abs(sum_m / kPhases), 0.15 * spacing_m) << end_m;
    } else if (real > 0 && real < kPhases) {
      short_read += sum_m / real < -0.15 * spacing_m ? 1 : 0;
    }
  }
  EXPECT_GT(clear, 20) << "most of what is near";
  EXPECT_GT(short_read, 0) << "the limit excludes some ends";
}

TEST(Observation, AClockwiseScannerSeesTheSame) {
  const testing::Room room{{{3.0, -1.0}, {3.0, 2.0}}, {{3.0, 2.0}, {0.5, 2.0}}};
  const LaserScan scan = scan_of(room, ScannerModel::half_circle(721, 0.0), 0.005);
  const auto a = observed(scan);
  const auto b = observed(turned_round(scan));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_THAT(b[k].base_T_segment, Pose2Near(a[k].base_T_segment, 1e-9, 1e-9));
    EXPECT_EQ(a[k].real, b[k].real);
    EXPECT_NEAR(a[k].end_sigma_m[kLeft], b[k].end_sigma_m[kLeft], 1e-9);
  }
}

}  // namespace
}  // namespace seeker::lines
