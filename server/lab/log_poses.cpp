#include "server/lab/log_poses.hpp"

#include <utility>

namespace seeker::lab {
namespace {

bool rises(const Trajectory& trajectory, double stamp_s) {
  return trajectory.empty() || stamp_s > trajectory.back().stamp_s;
}

/// False where the scan is out of order.
bool take(const drivers::CarmenScan& scan, LogPoses& poses, Trajectory& at_scans) {
  if (!poses.scan_stamps_s.empty() && scan.stamp_s <= poses.scan_stamps_s.back()) {
    return false;
  }
  poses.scan_stamps_s.push_back(scan.stamp_s);
  if (scan.host == "exact") {
    poses.exact_stamps_s.push_back(scan.stamp_s);
  }
  if (scan.odom_T_base) {
    at_scans.push_back({scan.stamp_s, *scan.odom_T_base});
  }
  if (scan.corrected_T_laser) {
    poses.corrected.push_back({scan.stamp_s, *scan.corrected_T_laser});
  }
  return true;
}

}  // namespace

Result<LogPoses> read_log_poses(const std::filesystem::path& path) {
  Result<drivers::CarmenReader> reader = drivers::CarmenReader::open(path);
  if (!reader) {
    return tl::unexpected<Error>(reader.error());
  }
  LogPoses poses;
  Trajectory at_scans;
  while (const std::optional<drivers::CarmenRecord> record = reader->next()) {
    bool in_order = true;
    if (const auto* scan = std::get_if<drivers::CarmenScan>(&*record)) {
      in_order = take(*scan, poses, at_scans);
    } else {
      const auto& odometry = std::get<drivers::CarmenOdometry>(*record);
      in_order = rises(poses.odometry, odometry.stamp_s);
      if (in_order) {
        poses.odometry.push_back({odometry.stamp_s, odometry.odom_T_base});
      }
    }
    if (!in_order) {
      reader->reject_last("its stamp is out of order");
    }
  }
  poses.summary = reader->summary();
  if (!at_scans.empty()) {
    poses.odometry = std::move(at_scans);
  }
  if (poses.scan_stamps_s.empty() && poses.odometry.empty()) {
    return fail(Errc::kParse, path.string() + " holds no record of a log: " + drivers::describe(poses.summary));
  }
  return poses;
}

}  // namespace seeker::lab
