/// \file
/// LiveOptions are the options of a robot file while the robot runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "server/app/composition/robot_options.hpp"
#include "server/app/landmarks/landmark_library.hpp"
#include "server/app/loop/configuration.hpp"
#include "server/app/runtime/devices.hpp"

namespace seeker::app {

/// Reads changes with the same strict descriptions as a robot file. Lives on the loop's thread.
class LiveOptions final : public Configuration {
 public:
  /// `options` are shared with all that goes by them; a change that is kept is written into them.
  LiveOptions(std::shared_ptr<RobotOptions> options, Devices devices, std::shared_ptr<LandmarkLibrary> landmarks);

  [[nodiscard]] std::vector<api::ComponentSetting> settings(const std::string& component) const override;
  [[nodiscard]] Result<SettingChange> read(const std::string& component,
                                           const std::vector<std::string>& assignments) const override;
  [[nodiscard]] Result<Exchange> exchange(const std::string& component, const std::string& type) const override;

 private:
  [[nodiscard]] std::vector<api::ComponentSetting> settings_in(const RobotOptions& options,
                                                               const std::string& component) const;
  [[nodiscard]] Result<Exchange> exchange_estimator(const RobotOptions& next) const;

  std::shared_ptr<RobotOptions> options_;
  Devices devices_;
  std::shared_ptr<LandmarkLibrary> landmarks_;
};

}  // namespace seeker::app
