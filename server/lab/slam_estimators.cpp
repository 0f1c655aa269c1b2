#include "server/lab/slam_estimators.hpp"

#include "server/slam/odometry_tracker.hpp"
#include "server/slam/scan_map_tracker.hpp"

namespace seeker::lab {
namespace {

const std::vector<std::pair<std::string, app::EstimatorType>>& known() {
  static const std::vector<std::pair<std::string, app::EstimatorType>> kKnown = {
      {"odometry", app::EstimatorType::kOdometry}, {"scan_match", app::EstimatorType::kScanMatch}};
  return kKnown;
}

}  // namespace

std::vector<std::string> estimator_names() {
  std::vector<std::string> names;
  for (const auto& [name, type] : known()) {
    names.push_back(name);
  }
  return names;
}

std::string name_of(app::EstimatorType type) {
  for (const auto& [name, known_type] : known()) {
    if (known_type == type) {
      return name;
    }
  }
  return "unknown";
}

Result<std::unique_ptr<slam::PoseTracker>> make_tracker(const std::string& name, const app::RobotOptions& options) {
  if (name == name_of(app::EstimatorType::kOdometry)) {
    return std::make_unique<slam::OdometryTracker>(options.tracking.odometry);
  }
  if (name == name_of(app::EstimatorType::kScanMatch)) {
    return std::make_unique<slam::ScanMapTracker>(options.tracking);
  }
  std::string names;
  for (const std::string& each : estimator_names()) {
    names += (names.empty() ? "" : ", ") + each;
  }
  return fail(Errc::kNotFound, "there is no estimator '" + name + "'; choose one of " + names);
}

}  // namespace seeker::lab
