/// \file
/// Estimators of server/slam behind the loop's interface.
#pragma once

#include <memory>

#include "server/app/estimators/estimator.hpp"
#include "server/slam/pose_tracker.hpp"

namespace seeker::app {

class TrackerEstimator final : public Estimator {
 public:
  explicit TrackerEstimator(std::unique_ptr<slam::PoseTracker> tracker) : tracker_(std::move(tracker)) {}

  [[nodiscard]] Status on_odometry(const drivers::OdometrySample& sample) override {
    return tracker_->predict(sample.odom_T_base, sample.stamp);
  }
  [[nodiscard]] Status on_scan(const LaserScan& scan) override { return tracker_->update(scan); }
  [[nodiscard]] PoseEstimate estimate() const override { return tracker_->estimate(); }
  [[nodiscard]] slam::MapTracker* map_tracker() override { return dynamic_cast<slam::MapTracker*>(tracker_.get()); }

 private:
  std::unique_ptr<slam::PoseTracker> tracker_;
};

}  // namespace seeker::app
