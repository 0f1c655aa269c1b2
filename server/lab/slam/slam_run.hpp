/// \file
/// An estimator over a recorded log: what it said, and what it cost.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/core/line_map.hpp"
#include "common/core/pose_estimate.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "server/drivers/replay/replay.hpp"
#include "server/lab/experiments/log_stopwatch.hpp"
#include "server/lab/scoring/trajectory.hpp"
#include "server/slam/pose_tracker.hpp"

namespace seeker::lab {

/// Scans in a row with the same quality.
struct QualitySpell {
  LocalisationQuality quality = LocalisationQuality::kUnknown;
  std::string cause;  ///< of the first scan
  double from_s = 0.0;
  double to_s = 0.0;  ///< last scan of the spell; log's clock
  std::uint64_t scans = 0;
};

struct SlamCost {
  double wall_s = 0.0;           ///< reading and estimating
  double processor_s = 0.0;      ///< of this process meanwhile: not lengthened by others on the machine
  TimeFigures scan;              ///< each scan with the odometry before it, on the wall
  TimeFigures scan_processor;    ///< the same in processor time of the calling thread
  double memory_empty_mb = 0.0;  ///< peak before the first record was taken
  double memory_peak_mb = 0.0;   ///< peak when the last scan was done
};

/// Everything about a run. Stamps are on the log's clock.
struct SlamRun {
  Trajectory online;      ///< as said at each scan
  Trajectory trajectory;  ///< as known at the end: the same, unless the estimator moved its map
  std::vector<QualitySpell> spells;
  SlamCost cost;
  drivers::ReplaySummary log;
  std::uint64_t refused = 0;  ///< calls that the estimator answered with an error
  std::string first_refusal;
  std::vector<MapSegment> segments;  ///< of an estimator that keeps a map of segments
  LineMap map;                       ///< the same with its local maps; empty where the estimator keeps none
  std::uint64_t keyframes = 0;       ///< scans kept with that map
  std::uint64_t loops = 0;           ///< closed and believed
};

/// A part of a log as shares of its duration, 0 to 1: the first half is {0, 0.5}.
struct LogSpan {
  double from = 0.0;
  double to = 1.0;

  friend bool operator==(const LogSpan&, const LogSpan&) = default;
};

/// Called now and then with the number of scans done and the log's time since its start.
using SlamProgress = std::function<void(std::uint64_t scans, double time_s)>;

/// Plays the log through the estimator, odometry before the scan it belongs to. It is given odometry and scans only:
/// poses that a log holds for scoring do not leave the replay driver. What lies outside of the span is never shown to
/// the estimator. Errors of ReplaySource::open(); kParse when the log, or this part of it, has no scan.
[[nodiscard]] Result<SlamRun> run_slam(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                                       slam::PoseTracker& tracker, const SlamProgress& progress = {},
                                       const LogSpan& span = {});

/// Number of scans and seconds with that quality; a scan lasts until the next one.
struct QualityShare {
  std::uint64_t scans = 0;
  double time_s = 0.0;
};
[[nodiscard]] QualityShare share_of(const SlamRun& run, LocalisationQuality quality);

/// Every scan of a log at its pose of the trajectory.
[[nodiscard]] Status for_each_scan(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                                   const Trajectory& trajectory,
                                   const std::function<void(const LaserScan& scan, const Pose2& map_T_base)>& visit);

}  // namespace seeker::lab
