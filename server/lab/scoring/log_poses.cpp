#include "server/lab/scoring/log_poses.hpp"

#include <utility>

namespace seeker::lab {
namespace {

void take(const drivers::CarmenScan& scan, LogPoses& poses, Trajectory& at_scans) {
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
    if (const auto* scan = std::get_if<drivers::CarmenScan>(&*record)) {
      take(*scan, poses, at_scans);
    } else {
      const auto& odometry = std::get<drivers::CarmenOdometry>(*record);
      poses.odometry.push_back({odometry.stamp_s, odometry.odom_T_base});
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
