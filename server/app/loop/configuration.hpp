/// \file
/// Configuration is what the loop knows of the robot file while it runs: the settings of its components, and what they
/// can be exchanged for.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/api/component.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/app/estimators/estimator.hpp"
#include "server/vision/recogniser_params.hpp"

namespace seeker::app {

struct LoopParams;

/// A change of settings that has been read and checked and is not in use yet.
struct SettingChange {
  std::vector<api::ComponentSetting> changed;          ///< with their new values
  std::shared_ptr<const LoopParams> loop;              ///< all parameters of the loop after the change
  std::optional<Duration> period;                      ///< the new period of a driver, where that is what changes
  std::optional<vision::RecogniserParams> recogniser;  ///< where those change
  std::function<void()> keep;                          ///< makes the change part of the configuration
};

/// An exchange that has been prepared and is not carried out yet.
struct Exchange {
  std::unique_ptr<Estimator> estimator;  ///< null: another component than the estimator is exchanged
  std::function<void()> keep;            ///< makes the change part of the configuration
};

/// Its changes are made in two steps, so that all stays as it was when one of them fails. Lives on the loop's thread.
class Configuration {
 public:
  Configuration() = default;
  Configuration(const Configuration&) = delete;
  Configuration& operator=(const Configuration&) = delete;
  virtual ~Configuration() = default;

  /// Returns the settings of a component as they are in use; empty where it has none.
  [[nodiscard]] virtual std::vector<api::ComponentSetting> settings(const std::string& component) const = 0;
  /// Reads "key=value" assignments as strictly as a robot file. kInvalidArgument names the path of what is wrong, or
  /// the keys there are; kRefused: the change needs a restart.
  [[nodiscard]] virtual Result<SettingChange> read(const std::string& component,
                                                   const std::vector<std::string>& assignments) const = 0;
  /// Prepares another type of a component. kInvalidArgument names the types there are; kRefused: this component cannot
  /// be exchanged.
  [[nodiscard]] virtual Result<Exchange> exchange(const std::string& component, const std::string& type) const = 0;
};

}  // namespace seeker::app
