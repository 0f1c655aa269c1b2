#include "server/app/loop/line_reporter.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"

namespace seeker::app {
namespace {

/// A wall straight ahead, 2 m away, seen by 61 beams of a degree.
LaserScan wall_ahead() {
  LaserScan scan;
  scan.angle_min_rad = deg_to_rad(-30.0);
  scan.angle_step_rad = deg_to_rad(1.0);
  scan.range_max_m = 6.0;
  for (std::size_t beam = 0; beam <= 60; ++beam) {
    scan.ranges_m.push_back(static_cast<float>(2.0 / std::cos(scan.angle_rad(beam))));
    scan.quality.push_back(40);
  }
  return scan;
}

TEST(LineReporter, GivesTheSevenFeaturesOfAWall) {
  for (const lines::ExtractorKind kind : lines::kExtractorKinds) {
    lines::ExtractorParams params;
    params.kind = kind;
    const api::LineReport report = LineReporter(params).report(wall_ahead());
    EXPECT_EQ(report.extractor, lines::to_string(kind));
    EXPECT_EQ(report.scan, wall_ahead());
    ASSERT_EQ(report.lines.size(), 1U) << report.extractor;
    const api::ScanLine& line = report.lines.front();
    EXPECT_NEAR(line.normal_rad, 0.0, 1e-3) << report.extractor;
    EXPECT_NEAR(line.start_rad, deg_to_rad(-30.0), 0.04);
    EXPECT_NEAR(line.end_rad, deg_to_rad(30.0), 0.04);
    EXPECT_NEAR(line.distance_m, 2.0, 1e-3);
    EXPECT_NEAR(line.length_m, 4.0 * std::tan(deg_to_rad(30.0)), 0.1);
    EXPECT_EQ(report.packets.empty(), kind != lines::ExtractorKind::kFiveModes);
  }
}

}  // namespace
}  // namespace seeker::app
