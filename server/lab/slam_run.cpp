#include "server/lab/slam_run.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "server/lab/slam_final_poses.hpp"
#include "server/slam/map_tracker.hpp"

namespace seeker::lab {
namespace {

using Stopwatch = std::chrono::steady_clock;

double seconds_since(Stopwatch::time_point start) {
  return std::chrono::duration<double>(Stopwatch::now() - start).count();
}

double cpu_seconds() {
  rusage usage{};
  constexpr double kMicro = 1e-6;
  const auto in_s = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + kMicro * static_cast<double>(t.tv_usec);
  };
  return getrusage(RUSAGE_SELF, &usage) == 0 ? in_s(usage.ru_utime) + in_s(usage.ru_stime) : 0.0;
}

/// A stamp of the log from robot time. Logs state microseconds: the rounding of the difference goes away.
double log_stamp_s(const drivers::ReplaySource& source, RobotTime stamp) {
  constexpr double kTicks = 1e6;
  return std::round((source.first_stamp_s() + to_seconds(stamp)) * kTicks) / kTicks;
}

/// One log through one estimator.
class Player {
 public:
  Player(drivers::ReplaySource& source, slam::PoseTracker& tracker) : source_(source), tracker_(tracker) {}

  /// Takes one record; false at the end of the log.
  bool step() {
    if (!source_.advance_one()) {
      return false;
    }
    const std::optional<drivers::OdometrySample> odometry = source_.take_odometry();
    const std::optional<LaserScan> scan = source_.take_scan();
    const Stopwatch::time_point start = Stopwatch::now();
    Status predicted;
    Status updated;
    if (odometry) {
      predicted = tracker_.predict(odometry->odom_T_base, odometry->stamp);
    }
    if (scan) {
      updated = tracker_.update(*scan);
    }
    spent_s_ += seconds_since(start);
    note(predicted);
    note(updated);
    if (scan) {
      scan_s_.push_back(std::exchange(spent_s_, 0.0));
      note_pose(*scan);
    }
    return true;
  }
  void finish(const slam::MapTracker* map);

  SlamRun run;

  [[nodiscard]] const std::vector<double>& scan_s() const { return scan_s_; }

 private:
  void note(const Status& status);
  void note_pose(const LaserScan& scan);

  drivers::ReplaySource& source_;
  slam::PoseTracker& tracker_;
  std::vector<OnlinePose> poses_;
  std::vector<double> scan_s_;
  double spent_s_ = 0.0;  ///< since the last scan
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
  const LineMap value = map->map();
  run.segments = map->segments().size();
  run.keyframes = value.keyframes.size();
  run.loops = static_cast<std::uint64_t>(std::count_if(value.edges.begin(), value.edges.end(),
                                                       [](const MapEdge& edge) { return edge.loop && edge.enabled; }));
  const std::vector<Pose2> poses = final_poses(poses_, value);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    run.trajectory[k].map_T_base = poses[k];
  }
}

void fill_times(std::vector<double> scan_s, SlamCost& cost) {
  constexpr double kMilli = 1e3;
  constexpr double kTail = 0.99;
  if (scan_s.empty()) {
    return;
  }
  std::sort(scan_s.begin(), scan_s.end());
  const auto count = static_cast<double>(scan_s.size());
  const auto at = [&](double share) {
    const double rank = std::ceil(share * count) - 1.0;
    return kMilli * scan_s[static_cast<std::size_t>(std::max(0.0, rank))];
  };
  cost.scan_mean_ms = kMilli * std::accumulate(scan_s.begin(), scan_s.end(), 0.0) / count;
  cost.scan_median_ms = at(0.5);
  cost.scan_p99_ms = at(kTail);
  cost.scan_max_ms = kMilli * scan_s.back();
}

}  // namespace

double peak_memory_mb() {
  rusage usage{};
  constexpr double kKilobytesPerMegabyte = 1024.0;
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<double>(usage.ru_maxrss) / kKilobytesPerMegabyte : 0.0;
}

Result<SlamRun> run_slam(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                         slam::PoseTracker& tracker, const SlamProgress& progress) {
  constexpr std::uint64_t kProgressScans = 50;
  const Result<std::shared_ptr<drivers::ReplaySource>> source = drivers::ReplaySource::open(log, geometry);
  if (!source) {
    return tl::unexpected<Error>(source.error());
  }
  Player player(**source, tracker);
  player.run.cost.memory_empty_mb = peak_memory_mb();
  const Stopwatch::time_point start = Stopwatch::now();
  const double cpu_start_s = cpu_seconds();
  while (player.step()) {
    const std::uint64_t scans = player.run.online.size();
    if (progress && scans % kProgressScans == 0) {
      progress(scans, to_seconds((*source)->now()));
    }
  }
  player.run.cost.wall_s = seconds_since(start);
  player.run.cost.cpu_s = cpu_seconds() - cpu_start_s;
  player.run.cost.memory_peak_mb = peak_memory_mb();
  fill_times(player.scan_s(), player.run.cost);
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
