#include "server/lab/slam/slam_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "server/drivers/interfaces/odometry_calibrator.hpp"
#include "server/lab/slam/slam_final_poses.hpp"
#include "server/slam/map_tracker.hpp"

namespace seeker::lab {
namespace {

/// A stamp of the log from robot time. Logs state microseconds: the rounding of the difference goes away.
double log_stamp_s(const drivers::ReplaySource& source, RobotTime stamp) {
  constexpr double kTicks = 1e6;
  return std::round((source.first_stamp_s() + to_seconds(stamp)) * kTicks) / kTicks;
}

/// One log through one estimator.
class Player {
 public:
  Player(drivers::ReplaySource& source, slam::PoseTracker& tracker, const WheelCalibration& calibration)
      : source_(source), tracker_(tracker), calibrator_(calibration) {}

  /// Takes one record; false at the end of the log or after `to_s` of it. Records before `from_s` pass unseen.
  bool step(double from_s, double to_s) {
    if (!source_.advance_one() || to_seconds(source_.now()) > to_s) {
      return false;
    }
    std::optional<drivers::OdometrySample> odometry = source_.take_odometry();
    if (odometry) {
      odometry = calibrator_.apply(*odometry);
    }
    const std::optional<LaserScan> scan = source_.take_scan();
    if (to_seconds(source_.now()) < from_s) {
      return true;
    }
    watch.start();
    Status predicted;
    Status updated;
    if (odometry) {
      predicted = tracker_.predict(odometry->odom_T_base, odometry->stamp);
    }
    if (scan) {
      updated = tracker_.update(*scan);
    }
    watch.stop();
    note(predicted);
    note(updated);
    if (scan) {
      watch.lap();
      note_pose(*scan);
    }
    return true;
  }
  void finish(const slam::MapTracker* map);

  SlamRun run;
  Stopwatch watch;

 private:
  void note(const Status& status);
  void note_pose(const LaserScan& scan);

  drivers::ReplaySource& source_;
  slam::PoseTracker& tracker_;
  drivers::OdometryCalibrator calibrator_;
  std::vector<OnlinePose> poses_;
};

void Player::note(const Status& status) {
  if (status || status.error().code == Errc::kNotReady) {
    return;
  }
  if (run.refused++ == 0) {
    run.first_refusal = status.error().message;
  }
}

void Player::note_pose(const LaserScan& scan) {
  const PoseEstimate estimate = tracker_.estimate();
  const double stamp_s = log_stamp_s(source_, scan.stamp);
  poses_.push_back({scan.stamp, estimate.map_T_base, estimate.map_epoch});
  run.online.push_back({stamp_s, estimate.map_T_base});
  if (run.spells.empty() || run.spells.back().quality != estimate.quality) {
    run.spells.push_back({estimate.quality, estimate.cause, stamp_s, stamp_s, 0});
  }
  run.spells.back().to_s = stamp_s;
  ++run.spells.back().scans;
}

void Player::finish(const slam::MapTracker* map) {
  run.log = source_.summary();
  run.trajectory = run.online;
  if (map == nullptr) {
    return;
  }
  run.map = map->map();
  const LineMap& value = run.map;
  run.segments = map->segments();
  run.keyframes = value.keyframes.size();
  run.loops = static_cast<std::uint64_t>(std::count_if(value.edges.begin(), value.edges.end(),
                                                       [](const MapEdge& edge) { return edge.loop && edge.enabled; }));
  const std::vector<Pose2> poses = final_poses(poses_, value);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    run.trajectory[k].map_T_base = poses[k];
  }
}

/// Reads the log to its end.
Result<double> duration_of(const std::filesystem::path& log, const drivers::ReplayParams& geometry) {
  const auto source = drivers::ReplaySource::open(log, geometry);
  if (!source) {
    return tl::unexpected<Error>(source.error());
  }
  while ((*source)->advance_one()) {
    (void)(*source)->take_odometry();
    (void)(*source)->take_scan();
  }
  return to_seconds((*source)->now());
}

}  // namespace

Result<SlamRun> run_slam(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                         slam::PoseTracker& tracker, const SlamProgress& progress, const LogSpan& span,
                         const WheelCalibration& calibration) {
  constexpr std::uint64_t kProgressScans = 50;
  const Result<std::shared_ptr<drivers::ReplaySource>> source = drivers::ReplaySource::open(log, geometry);
  if (!source) {
    return tl::unexpected<Error>(source.error());
  }
  const Result<double> duration_s =
      span == LogSpan{} ? std::numeric_limits<double>::infinity() : duration_of(log, geometry);
  if (!duration_s) {
    return tl::unexpected<Error>(duration_s.error());
  }
  const double from_s = span.from > 0.0 ? span.from * *duration_s : 0.0;
  const double to_s = span.to * *duration_s;
  Player player(**source, tracker, calibration);
  player.run.cost.memory_empty_mb = peak_memory_mb();
  const auto start = std::chrono::steady_clock::now();
  const double processor_start_s = process_seconds();
  while (player.step(from_s, to_s)) {
    const std::uint64_t scans = player.run.online.size();
    if (progress && scans % kProgressScans == 0) {
      progress(scans, to_seconds((*source)->now()));
    }
  }
  SlamCost& cost = player.run.cost;
  cost.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  cost.processor_s = process_seconds() - processor_start_s;
  cost.memory_peak_mb = peak_memory_mb();
  cost.scan = player.watch.wall();
  cost.scan_processor = player.watch.processor();
  if (player.run.online.empty()) {
    return fail(Errc::kParse, log.string() + " has no scan: " + drivers::describe((*source)->summary()));
  }
  player.finish(dynamic_cast<const slam::MapTracker*>(&tracker));
  return std::move(player.run);
}

QualityShare share_of(const SlamRun& run, LocalisationQuality quality) {
  QualityShare share;
  for (std::size_t k = 0; k < run.spells.size(); ++k) {
    const QualitySpell& spell = run.spells[k];
    if (spell.quality == quality) {
      share.scans += spell.scans;
      share.time_s += (k + 1 < run.spells.size() ? run.spells[k + 1].from_s : spell.to_s) - spell.from_s;
    }
  }
  return share;
}

Status for_each_scan(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                     const Trajectory& trajectory,
                     const std::function<void(const LaserScan& scan, const Pose2& map_T_base)>& visit) {
  constexpr double kSameStamp_s = 1e-5;
  const Result<std::shared_ptr<drivers::ReplaySource>> source = drivers::ReplaySource::open(log, geometry);
  if (!source) {
    return tl::unexpected<Error>(source.error());
  }
  while ((*source)->advance_one()) {
    (void)(*source)->take_odometry();
    const std::optional<LaserScan> scan = (*source)->take_scan();
    if (!scan) {
      continue;
    }
    // Half a tick later: the last entry not after it is the scan's own.
    const double stamp_s = log_stamp_s(**source, scan->stamp) + 0.5 * kSameStamp_s;
    const std::optional<std::size_t> index = index_before(trajectory, stamp_s);
    if (index && stamp_s - trajectory[*index].stamp_s < kSameStamp_s) {
      visit(*scan, trajectory[*index].map_T_base);
    }
  }
  return {};
}

}  // namespace seeker::lab
