#include <chrono>
#include <iostream>
#include <map>

#include <gtest/gtest.h>

#include "common/core/rng.hpp"
#include "server/drivers/replay/replay.hpp"
#include "server/slam/line_slam.hpp"
#include "server/slam/local_cloud.hpp"
#include "server/slam/scan_map_tracker.hpp"
#include "tests/support/data.hpp"
#include "tests/unit/server/slam/recorded_pioneer.hpp"

namespace seeker::slam {
namespace {

/// Estimated and reference pose of the base at one scan.
struct Sample {
  Pose2 estimate;
  Pose2 odometry;
  Pose2 reference;
};

struct Errors {
  double translation_m = 0.0;
  double rotation_deg = 0.0;
};

/// Mean error of the motion between samples `lag` apart: independent of the choice of frames.
template <class Select>
Errors relative_error(const std::vector<Sample>& samples, std::size_t lag, const Select& select) {
  Errors sum;
  std::size_t count = 0;
  for (std::size_t k = lag; k < samples.size(); k += 5, ++count) {
    const Pose2 truth = inverse(samples[k - lag].reference) * samples[k].reference;
    const Pose2 moved = inverse(select(samples[k - lag])) * select(samples[k]);
    const Pose2 error = inverse(truth) * moved;
    sum.translation_m += std::hypot(error.x_m, error.y_m);
    sum.rotation_deg += rad_to_deg(std::abs(error.theta_rad));
  }
  const auto n = static_cast<double>(std::max<std::size_t>(count, 1));
  return {sum.translation_m / n, sum.rotation_deg / n};
}

/// The scan of a worse scanner.
LaserScan with_noise(LaserScan scan, double sigma_m, Rng& rng) {
  for (float& range_m : scan.ranges_m) {
    if (std::isfinite(range_m) && range_m <= scan.range_max_m) {
      range_m = std::max(0.05F, range_m + static_cast<float>(rng.normal(sigma_m)));
    }
  }
  return scan;
}

/// What a log is made worse by.
struct Worse {
  double noise_m = 0.0;  ///< added to every range
  double gap_m = 0.0;    ///< scans are left out until the wheels say that the robot moved so far
  double gap_rad = 0.0;  ///< or turned so far
};

/// Plays a log through the tracker. `reference_at` gives the scoring pose; samples without one are left out.
template <class Reference>
std::vector<Sample> play(const std::filesystem::path& path, const drivers::ReplayParams& params,
                         const Reference& reference_at, PoseTracker& tracker, const Worse& worse = {}) {
  Rng rng(1);
  auto reader = drivers::CarmenReader::open(path);
  EXPECT_TRUE(reader);
  std::vector<Sample> samples;
  double spent_s = 0.0;
  std::map<LocalisationQuality, int> qualities;
  std::optional<double> first_s;
  std::optional<Pose2> last;
  while (auto record = reader->next()) {
    const auto* scan = std::get_if<drivers::CarmenScan>(&*record);
    if (scan == nullptr || !scan->odom_T_base) {
      continue;
    }
    if (worse.gap_m > 0.0 && last && !moved(*last, *scan->odom_T_base, worse.gap_m, worse.gap_rad)) {
      continue;
    }
    last = scan->odom_T_base;
    first_s = first_s.value_or(scan->stamp_s);
    const RobotTime stamp = robot_time_s(scan->stamp_s - *first_s);
    const LaserScan recorded = drivers::to_laser_scan(*scan, params, stamp);
    const LaserScan laser = worse.noise_m > 0.0 ? with_noise(recorded, worse.noise_m, rng) : recorded;
    const auto begin = std::chrono::steady_clock::now();
    (void)tracker.predict(*scan->odom_T_base, stamp);
    (void)tracker.update(laser);
    spent_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ++qualities[tracker.estimate().quality];
    if (const std::optional<Pose2> reference = reference_at(*scan)) {
      samples.push_back({tracker.estimate().map_T_base, *scan->odom_T_base, *reference});
    }
  }
  std::cout << path.filename() << ": " << 1e3 * spent_s / static_cast<double>(samples.size())
            << " ms/scan, scans by quality:";
  for (const auto& [quality, count] : qualities) {
    std::cout << " " << to_string(quality) << " " << count;
  }
  std::cout << "\n";
  return samples;
}

Errors report(const std::vector<Sample>& samples, std::size_t lag) {
  const Errors ours = relative_error(samples, lag, [](const Sample& s) { return s.estimate; });
  const Errors odometry = relative_error(samples, lag, [](const Sample& s) { return s.odometry; });
  std::cout << "  lag " << lag << ": tracker " << ours.translation_m << " m " << ours.rotation_deg << " deg, odometry "
            << odometry.translation_m << " m " << odometry.rotation_deg << " deg\n";
  return ours;
}

std::optional<Pose2> corrected(const drivers::CarmenScan& scan) { return scan.corrected_T_laser; }

TEST(RecordedLogs, Freiburg079IsFollowedToItsEnd) {
  SEEKER_REQUIRE_DATA(path, "lidar/fr079.clf.gz");
  ScanMapTracker tracker;
  const auto samples = play(path, {}, corrected, tracker);
  ASSERT_GT(samples.size(), 4700U);
  EXPECT_LT(report(samples, 50).translation_m, 0.15);
  EXPECT_LT(report(samples, 1000).translation_m, 0.8);
}

TEST(RecordedLogs, Freiburg079IsFollowedByAScannerOfThreeCentimetresNoiseToo) {
  SEEKER_REQUIRE_DATA(path, "lidar/fr079.clf.gz");
  ScanMapTracker tracker;
  const auto samples = play(path, {}, corrected, tracker, {.noise_m = 0.03});
  ASSERT_GT(samples.size(), 4700U);
  EXPECT_LT(report(samples, 50).translation_m, 0.2);
}

TEST(RecordedLogs, Freiburg079IsFollowedWithAScanEveryMetre) {
  SEEKER_REQUIRE_DATA(path, "lidar/fr079.clf.gz");
  LineSlam slam;
  const auto samples = play(path, {}, corrected, slam, {.gap_m = 1.0, .gap_rad = 0.5});
  ASSERT_GT(samples.size(), 500U);
  // As the robot believes at the time, before loops put right what they can. It depends on where local maps end: 0.20
  // to 0.31 m with a path length of 7 to 14 m each.
  EXPECT_LT(report(samples, 20).translation_m, 0.32);
}

std::vector<Sample> play_pioneer(const std::filesystem::path& path, const std::filesystem::path& scores,
                                 PoseTracker& tracker) {
  const PioneerCorrections corrections(scores);
  const auto reference = [&](const drivers::CarmenScan& scan) {
    return corrections.map_T_base(scan.stamp_s, *scan.odom_T_base);
  };
  return play(path, pioneer_params(), reference, tracker);
}

TEST(RecordedLogs, ARealPioneerIsFollowedThroughItsBuilding) {
  SEEKER_REQUIRE_DATA(path, "lidar/p3dx/trace0.clf.gz");
  SEEKER_REQUIRE_DATA(scores, "lidar/p3dx/trace0_map_to_odom.csv.gz");
  ScanMapTracker tracker;
  const auto samples = play_pioneer(path, scores, tracker);
  ASSERT_GT(samples.size(), 900U);
  EXPECT_LT(report(samples, 50).translation_m, 0.2);
  EXPECT_LT(report(samples, 400).translation_m, 0.5);
}

TEST(RecordedLogs, WhatACorridorShowsAheadDoesNotHoldAPioneerBack) {
  SEEKER_REQUIRE_DATA(path, "lidar/p3dx/trace1.clf.gz");
  SEEKER_REQUIRE_DATA(scores, "lidar/p3dx/trace1_map_to_odom.csv.gz");
  // Which points are chosen is chance, and with every second choice the robot once stood still for two seconds at its
  // last keyframe.
  for (const std::size_t points : {140U, 180U, 210U}) {
    LineSlamParams params;
    params.points.match_points = points;
    LineSlam slam(params);
    const auto samples = play_pioneer(path, scores, slam);
    ASSERT_GT(samples.size(), 850U);
    EXPECT_LT(report(samples, 50).translation_m, 0.12) << points << " points";
  }
}

}  // namespace
}  // namespace seeker::slam
