/// \file
/// Several scanners on one robot as one.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/scan_merge.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::drivers {

struct MergedLidarParams {
  ScanMergeParams merge;
  /// A scan this much older than that of the first scanner is not merged, and its scanner counts as silent.
  Duration max_age = std::chrono::milliseconds(500);
};

/// Scans at the pace of the first scanner, with the newest of the others merged into them. A robot is half blind
/// without one of its scanners: one that is silent is a blocking fault.
class MergedLidar final : public LidarDriver {
 public:
  /// The pose of the base by odometry in any fixed frame. Nothing: not known, so that no motion is taken out.
  using PoseAt = std::function<std::optional<Pose2>(RobotTime)>;

  /// At least one scanner.
  MergedLidar(std::vector<std::shared_ptr<LidarDriver>> lidars, PoseAt odom_T_base_at,
              const MergedLidarParams& params = {});

  /// Opens all; where one cannot be opened, those before it are closed again.
  [[nodiscard]] Status activate() override;
  void deactivate() override;
  [[nodiscard]] Status set_period(Duration period) override;
  /// Errors of any scanner.
  [[nodiscard]] Result<std::optional<LaserScan>> read() override;
  /// Those of all scanners, and "silent" with the number of a scanner after the first.
  [[nodiscard]] std::vector<DeviceFault> faults() const override;
  /// Sums over all scanners.
  [[nodiscard]] std::optional<LinkStatistics> statistics() const override;

 private:
  [[nodiscard]] LaserScan merge() const;
  [[nodiscard]] bool is_silent(std::size_t lidar) const;

  std::vector<std::shared_ptr<LidarDriver>> lidars_;
  PoseAt odom_T_base_at_;
  MergedLidarParams params_;
  std::vector<std::optional<LaserScan>> newest_;  ///< of each scanner
  std::optional<RobotTime> first_stamp_;          ///< of the first scan since the activation
};

}  // namespace seeker::drivers
