#include "server/app/composition/estimators.hpp"

#include "common/core/assert.hpp"
#include "server/slam/line_slam.hpp"
#include "server/slam/odometry_tracker.hpp"
#include "server/slam/scan_map_tracker.hpp"

namespace seeker::app {

const std::vector<std::pair<std::string_view, EstimatorType>>& estimator_names() {
  static const std::vector<std::pair<std::string_view, EstimatorType>> kNames = {
      {"odometry", EstimatorType::kOdometry},
      {"scan_match", EstimatorType::kScanMatch},
      {"line_slam", EstimatorType::kLineSlam},
      {"landmarks", EstimatorType::kLandmarks}};
  return kNames;
}

std::string_view to_string(EstimatorType type) {
  for (const auto& [name, known] : estimator_names()) {
    if (known == type) {
      return name;
    }
  }
  return "unknown";
}

bool is_tracker(EstimatorType type) { return type != EstimatorType::kLandmarks; }

std::unique_ptr<slam::PoseTracker> make_tracker(EstimatorType type, const RobotOptions& options) {
  SEEKER_ASSERT(is_tracker(type));
  switch (type) {
    case EstimatorType::kOdometry: return std::make_unique<slam::OdometryTracker>(options.tracking.odometry);
    case EstimatorType::kScanMatch: return std::make_unique<slam::ScanMapTracker>(options.tracking);
    default: break;
  }
  return std::make_unique<slam::LineSlam>(options.slam);
}

}  // namespace seeker::app
