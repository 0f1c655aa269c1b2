/// \file
/// Runs an estimator on a recorded log and records its estimates and its cost.
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
#include "common/core/wheel_calibration.hpp"
#include "server/drivers/replay/replay.hpp"
#include "server/lab/experiments/log_stopwatch.hpp"
#include "server/lab/scoring/trajectory.hpp"
#include "server/slam/pose_tracker.hpp"

namespace seeker::lab {

/// Consecutive scans with the same quality.
struct QualitySpell {
  LocalisationQuality quality = LocalisationQuality::kUnknown;
  std::string cause;  ///< cause at the first scan
  double from_s = 0.0;
  double to_s = 0.0;  ///< time of the last scan, on the log's clock
  std::uint64_t scans = 0;
};

struct SlamCost {
  double wall_s = 0.0;           ///< reading and estimating
  double processor_s = 0.0;      ///< processor time of this process: independent of other load of the machine
  TimeFigures scan;              ///< wall time of each scan with the odometry before it
  TimeFigures scan_processor;    ///< the same in processor time of the calling thread
  double memory_empty_mb = 0.0;  ///< peak before the first record was taken
  double memory_peak_mb = 0.0;   ///< peak when the last scan was done
};

/// All results of a run. Stamps are on the log's clock.
struct SlamRun {
  Trajectory online;      ///< estimate at each scan
  Trajectory trajectory;  ///< poses known at the end: the same, unless the estimator corrected its map
  std::vector<QualitySpell> spells;
  SlamCost cost;
  drivers::ReplaySummary log;
  std::uint64_t refused = 0;  ///< number of calls that the estimator refused with an error
  std::string first_refusal;
  std::vector<MapSegment> segments;  ///< final segments of an estimator with a map of segments
  LineMap map;                       ///< the map with its local maps; empty where the estimator keeps none
  std::uint64_t keyframes = 0;       ///< number of keyframes in that map
  std::uint64_t loops = 0;           ///< number of loop closures that were accepted
};

/// A part of a log as shares of its duration, 0 to 1: the first half is {0, 0.5}.
struct LogSpan {
  double from = 0.0;
  double to = 1.0;

  friend bool operator==(const LogSpan&, const LogSpan&) = default;
};

/// Called from time to time with the number of scans processed and the log's time since its start.
using SlamProgress = std::function<void(std::uint64_t scans, double time_s)>;

/// Plays the log through the estimator, odometry before the scan it belongs to. The estimator is given odometry and
/// scans only: poses that a log holds for scoring are not passed on by the replay driver, and records outside the span
/// are never given to the estimator. Odometry is corrected by `calibration` first. Errors of ReplaySource::open();
/// kParse when the log, or this part of it, has no scan.
[[nodiscard]] Result<SlamRun> run_slam(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                                       slam::PoseTracker& tracker, const SlamProgress& progress = {},
                                       const LogSpan& span = {}, const WheelCalibration& calibration = {});

/// Number of scans and seconds with that quality; a scan lasts until the next one.
struct QualityShare {
  std::uint64_t scans = 0;
  double time_s = 0.0;
};
[[nodiscard]] QualityShare share_of(const SlamRun& run, LocalisationQuality quality);

/// Calls `visit` for every scan of a log with its pose on the trajectory.
[[nodiscard]] Status for_each_scan(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                                   const Trajectory& trajectory,
                                   const std::function<void(const LaserScan& scan, const Pose2& map_T_base)>& visit);

}  // namespace seeker::lab
