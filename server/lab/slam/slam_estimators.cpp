#include "server/lab/slam/slam_estimators.hpp"

#include "server/app/composition/estimators.hpp"

namespace seeker::lab {

std::vector<std::string> estimator_names() {
  std::vector<std::string> names;
  for (const auto& [name, type] : app::estimator_names()) {
    if (app::is_tracker(type)) {
      names.emplace_back(name);
    }
  }
  return names;
}

std::string name_of(app::EstimatorType type) { return std::string(app::to_string(type)); }

Result<std::unique_ptr<slam::PoseTracker>> make_tracker(const std::string& name, const app::RobotOptions& options) {
  std::string names;
  for (const auto& [known, type] : app::estimator_names()) {
    if (!app::is_tracker(type)) {
      continue;
    }
    if (known == name) {
      return app::make_tracker(type, options);
    }
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  return fail(Errc::kNotFound, "there is no estimator '" + name + "'; choose one of " + names);
}

}  // namespace seeker::lab
