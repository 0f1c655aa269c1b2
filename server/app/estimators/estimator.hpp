/// \file
/// What estimates the robot's pose: dead reckoning, scan matching, line SLAM, a database of landmarks.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/core/pose_estimate.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "server/app/estimators/stereo_look.hpp"
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
  /// Whether it wants a stereo observation now.
  [[nodiscard]] virtual bool wants_look(RobotTime /*now*/) const { return false; }
  /// Pictures were taken at the newest odometry; on_look() follows, perhaps some ticks later.
  virtual void look_begun(RobotTime /*stamp*/) {}
  /// The stereo observation that was asked for, or why there is none.
  virtual void on_look(const Result<StereoLook>& /*look*/) {}
  /// Sets the pose: landmarks were recognised there, or an operator says so. kNotReady: the estimator cannot be set.
  [[nodiscard]] virtual Status place_at(const PoseEstimate& /*place*/) {
    return fail(Errc::kNotReady, "the pose of this estimator cannot be set");
  }
  /// Events since the last call that an operator should know of.
  [[nodiscard]] virtual std::vector<std::string> take_news() { return {}; }
  [[nodiscard]] virtual PoseEstimate estimate() const = 0;
  /// The map of segments behind the estimate; null where none is kept.
  [[nodiscard]] virtual slam::MapTracker* map_tracker() { return nullptr; }
};

/// Which estimator a robot uses.
enum class EstimatorType : std::uint8_t { kOdometry, kScanMatch, kLineSlam, kLandmarks };

}  // namespace seeker::app
