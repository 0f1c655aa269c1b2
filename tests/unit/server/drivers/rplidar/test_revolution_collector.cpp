#include "server/drivers/rplidar/revolution_collector.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "server/drivers/rplidar/rplidar_session.hpp"

namespace seeker::drivers {
namespace {

constexpr double kSamplePeriod_s = 0.0005;

RplidarParams params_of(double step_deg) {
  RplidarParams params;
  params.angle_step_rad = deg_to_rad(step_deg);
  params.base_T_laser = {0.1, 0.0, 0.3};
  return params;
}

/// A scanner at 1/2 degree per sample; ranges tell the clockwise angle: 1 m + 1 m per turn.
class Turning {
 public:
  explicit Turning(const RplidarParams& params) : collector(params) {}

  /// Turns on to the clockwise angle in degrees, counted over turns, and returns the scans that come out.
  std::vector<LaserScan> turn_to(double cw_deg) {
    std::vector<LaserScan> scans;
    for (; at_deg < cw_deg; at_deg += 0.5) {
      const double in_turn_deg = std::fmod(at_deg, 360.0);
      const auto range_m = static_cast<float>(1.0 + in_turn_deg / 360.0);
      if (auto scan = collector.add({deg_to_rad(in_turn_deg), range_m, 40}, time())) {
        scans.push_back(*scan);
      }
    }
    return scans;
  }
  void skip_to(double cw_deg) { at_deg = cw_deg; }
  [[nodiscard]] RobotTime time() const { return robot_time_s(10.0 + at_deg / 0.5 * kSamplePeriod_s); }

  RevolutionCollector collector;
  double at_deg = 180.25;
};

TEST(RevolutionCollector, GivesOneScanATurnWithCounterClockwiseBeams) {
  Turning scanner(params_of(1.0));
  const std::vector<LaserScan> scans = scanner.turn_to(180.0 + 3 * 360.0 + 5.0);
  ASSERT_EQ(scans.size(), 3U);
  const LaserScan& scan = scans[1];
  ASSERT_EQ(scan.ranges_m.size(), 360U);
  EXPECT_NEAR(scan.angle_min_rad, deg_to_rad(-179.5), 1e-9);
  EXPECT_NEAR(scan.angle_step_rad, deg_to_rad(1.0), 1e-12);
  EXPECT_EQ(scan.base_T_laser, (Pose2{0.1, 0.0, 0.3}));
  EXPECT_EQ(scan.quality[7], 40);
  for (std::size_t i = 0; i < 360; ++i) {
    const double cw_deg = std::fmod(360.0 - rad_to_deg(scan.angle_rad(i)), 360.0);
    EXPECT_NEAR(scan.ranges_m[i], 1.0 + cw_deg / 360.0, 0.3 / 360.0) << "beam " << i;
  }
  EXPECT_TRUE(validate(scan));
}

TEST(RevolutionCollector, TheStampIsTheMiddleAndTheSweepRunsBackwards) {
  Turning scanner(params_of(1.0));
  const std::vector<LaserScan> scans = scanner.turn_to(2 * 360.0);
  ASSERT_EQ(scans.size(), 1U);
  // Straight ahead is the middle of the turn: 360 degrees on this count.
  EXPECT_NEAR(to_seconds(scans[0].stamp), 10.0 + 720 * kSamplePeriod_s, 1e-6);
  EXPECT_NEAR(to_seconds(scans[0].sweep), -718 * kSamplePeriod_s, 1e-6);
}

TEST(RevolutionCollector, AScannerThatHangsTurnsTheOtherWay) {
  RplidarParams params = params_of(1.0);
  params.upside_down = true;
  Turning scanner(params);
  const std::vector<LaserScan> scans = scanner.turn_to(2 * 360.0);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_GT(scans[0].sweep, Duration::zero());
  for (std::size_t i = 0; i < 360; ++i) {
    const double ccw_deg = std::fmod(360.0 + rad_to_deg(scans[0].angle_rad(i)), 360.0);
    EXPECT_NEAR(scans[0].ranges_m[i], 1.0 + ccw_deg / 360.0, 0.3 / 360.0) << "beam " << i;
  }
}

/// Samples of a wall 2 m ahead, as a scanner sees it that measures every `step_deg`, the first at `first_deg`.
LaserScan scan_of_wall(double beam_deg, double step_deg, double first_deg) {
  RevolutionCollector collector(params_of(beam_deg));
  std::optional<LaserScan> scan;
  for (int k = 0; !scan; ++k) {
    const double cw_deg = first_deg + k * step_deg;
    const double cosine = std::cos(deg_to_rad(cw_deg));
    const auto range_m = static_cast<float>(cosine > 0.5 ? 2.0 / cosine : 0.0);
    scan = collector.add({deg_to_rad(std::fmod(cw_deg, 360.0)), range_m, 40}, robot_time_s(k * kSamplePeriod_s));
  }
  return *scan;
}

TEST(RevolutionCollector, GivesTheRangeInTheMiddleOfABeamWhereverTheSamplesLie) {
  for (const double step_deg : {0.4, 0.9, 1.0, 1.7, 3.6}) {
    for (const double off_deg : {0.0, 0.5, 0.99}) {
      const LaserScan scan = scan_of_wall(1.0, step_deg, 180.0 + off_deg * step_deg);
      for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
        const double angle_rad = scan.angle_rad(i);
        if (std::abs(angle_rad) < deg_to_rad(50.0)) {
          EXPECT_NEAR(scan.ranges_m[i], 2.0 / std::cos(angle_rad), 2e-3) << "beam " << i << ", step " << step_deg;
        }
      }
    }
  }
}

TEST(RevolutionCollector, PutsNothingBetweenTwoSurfaces) {
  RevolutionCollector collector(params_of(0.25));
  std::optional<LaserScan> scan;
  for (double cw_deg = 180.0; !scan; cw_deg += 1.0) {
    const float range_m = std::fmod(cw_deg, 360.0) < 90.0 ? 2.0F : 3.0F;
    scan = collector.add({deg_to_rad(std::fmod(cw_deg, 360.0)), range_m, 40}, robot_time_s(cw_deg * kSamplePeriod_s));
  }
  for (const float range_m : scan->ranges_m) {
    EXPECT_TRUE(range_m == kNoReturn || std::abs(range_m - 2.0F) < 1e-3F || std::abs(range_m - 3.0F) < 1e-3F)
        << range_m;
  }
}

TEST(RevolutionCollector, ATurnWithAGapIsDeliveredWithThoseBeamsEmpty) {
  Turning scanner(params_of(1.0));
  EXPECT_EQ(scanner.turn_to(630.0).size(), 1U);
  scanner.skip_to(690.25);  // 270 to 330 degrees clockwise
  const std::vector<LaserScan> scans = scanner.turn_to(1000.0);
  ASSERT_EQ(scans.size(), 1U);
  const auto& ranges_m = scans[0].ranges_m;
  EXPECT_EQ(std::count(ranges_m.begin(), ranges_m.end(), kNoReturn), 60);
  EXPECT_EQ(ranges_m[180 + 45], kNoReturn) << "45 degrees to the left";
  EXPECT_NEAR(to_seconds(scans[0].stamp), 10.0 + 1440 * kSamplePeriod_s, 1e-6);
}

TEST(RevolutionCollector, ATurnOfWhichTooLittleCameIsNotDelivered) {
  Turning scanner(params_of(1.0));
  EXPECT_EQ(scanner.turn_to(560.0).size(), 1U);
  scanner.skip_to(660.25);
  EXPECT_TRUE(scanner.turn_to(1000.0).empty()) << "100 degrees are missing, 90 may be";
  EXPECT_EQ(scanner.turn_to(1300.0).size(), 1U);
}

TEST(RevolutionCollector, AWholeTurnThatIsMissingSpoilsTheTurnAroundIt) {
  Turning scanner(params_of(1.0));
  EXPECT_EQ(scanner.turn_to(720.0).size(), 1U);
  scanner.skip_to(1080.0);
  EXPECT_TRUE(scanner.turn_to(1300.0).empty());
  EXPECT_EQ(scanner.turn_to(1700.0).size(), 1U);
}

TEST(RevolutionCollector, BearingsThatJitterOverTheSeamMakeNoTurns) {
  RevolutionCollector collector(params_of(1.0));
  int turns = 0;
  double raw_deg = 0.0;
  for (int k = 0; k < 10 * 720; ++k, raw_deg += 0.5) {
    const double jitter_deg = k % 3 == 0 ? -4.0 : 0.0;
    const double cw_deg = std::fmod(raw_deg + jitter_deg + 360.0, 360.0);
    turns += collector.add({deg_to_rad(cw_deg), 2.0F, 40}, robot_time_s(k * kSamplePeriod_s)) ? 1 : 0;
  }
  EXPECT_EQ(turns, 9);
}

TEST(RevolutionCollector, RangesOutsideTheLimitsAreNoReturns) {
  RplidarParams params = params_of(45.0);
  params.range_min_m = 1.0;
  params.range_max_m = 1.5;
  Turning scanner(params);
  const std::vector<LaserScan> scans = scanner.turn_to(2 * 360.0);
  ASSERT_EQ(scans.size(), 1U);
  ASSERT_EQ(scans[0].ranges_m.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    const bool left = scans[0].angle_rad(i) > 0.0;  // clockwise over 180 degrees: over 1.5 m
    EXPECT_EQ(scans[0].ranges_m[i] == kNoReturn, left) << i;
    EXPECT_EQ(scans[0].quality[i], left ? 0 : 40) << i;
  }
}

}  // namespace
}  // namespace seeker::drivers
