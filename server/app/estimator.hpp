/// \file
/// Whatever tells the robot where it is: dead reckoning, scan matching, later line SLAM and the feature database.
#pragma once

#include <memory>
#include <string>

#include "common/core/pose_estimate.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "server/drivers/interfaces/drivers.hpp"
#include "server/slam/map_tracker.hpp"

namespace seeker::app {

class Estimator {
 public:
  Estimator() = default;
  Estimator(const Estimator&) = delete;
  Estimator& operator=(const Estimator&) = delete;
  virtual ~Estimator() = default;

  /// Follows the odometry. An error is a typed fault (time running backwards, a jump); the state stays consistent.
  [[nodiscard]] virtual Status on_odometry(const drivers::OdometrySample& sample) = 0;
  /// Corrects by a sweep taken at the newest odometry. Errors as above.
  [[nodiscard]] virtual Status on_scan(const LaserScan& scan) = 0;
  [[nodiscard]] virtual PoseEstimate estimate() const = 0;
  /// The map of segments behind the estimate; null where none is kept.
  [[nodiscard]] virtual slam::MapTracker* map_tracker() { return nullptr; }
};

/// Which estimator a robot uses.
enum class EstimatorType : std::uint8_t { kOdometry, kScanMatch, kLineSlam };

}  // namespace seeker::app
