#include "server/app/composition/live_options.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "common/config/yaml.hpp"
#include "server/app/composition/estimators.hpp"

namespace seeker::app {
namespace {

using api::SettingEffect;

/// Values of a robot file that belong to a component: those whose path begins with `path`. `key` stands in place of
/// that beginning. The first row that fits a path counts.
struct Row {
  std::string_view component;
  std::string_view key;
  std::string_view path;
  SettingEffect effect = SettingEffect::kNow;
  std::string_view why_restart{};
};

constexpr std::array kRows = {
    Row{"base", "period_s", "sim.devices.base_period_s"},
    Row{"base", "timeout_s", "loop.base_timeout_s"},
    Row{"lidar", "period_s", "sim.devices.lidar_period_s"},
    Row{"lidar", "timeout_s", "loop.lidar_timeout_s"},
    Row{"sonar", "period_s", "sim.devices.sonar_period_s"},
    Row{"sonar", "timeout_s", "loop.sonar_timeout_s"},
    Row{"stereo", "features.", "stereo.features.", SettingEffect::kRestart,
        "the databases of landmarks hold features that were found with the value before"},
    Row{"pose", "tracking.", "tracking.", SettingEffect::kExchange},
    Row{"pose", "slam.", "slam.", SettingEffect::kExchange},
    Row{"pose", "lines.", "lines.", SettingEffect::kExchange},
    Row{"pose", "stereo.estimator.", "stereo.estimator.", SettingEffect::kExchange},
    Row{"pose", "stereo.localiser.", "stereo.localiser.", SettingEffect::kExchange},
    Row{"map", "tile_period_s", "loop.tile_period_s"},
    Row{"map", "", "loop.map."},
    Row{"map", "", "occupancy.", SettingEffect::kRestart,
        "the cells that are known were written with the value before"},
    Row{"recogniser", "view.", "search.recogniser.view.", SettingEffect::kRestart,
        "searches plan with the view of the camera that they began with"},
    Row{"recogniser", "", "search.recogniser."},
    Row{"mission", "grid_period_s", "loop.grid_period_s"},
    Row{"mission", "", "loop.mission."},
    Row{"planner", "goto.", "goto.", SettingEffect::kNextMission},
    Row{"planner", "coverage.", "search.coverage.", SettingEffect::kNextMission},
    Row{"planner", "round.", "search.round.", SettingEffect::kNextMission},
    Row{"planner", "explore.", "explore.", SettingEffect::kNextMission},
    Row{"planner", "topology.", "topology.", SettingEffect::kNextMission},
    Row{"safety", "", "loop.safety."},
};

/// A row without a dot at its end is one value, all others are sections.
const Row* row_of(const std::string& component, const std::string& path) {
  const auto fits = [&](const Row& row) {
    return row.component == component && (row.path.ends_with('.') ? path.starts_with(row.path) : path == row.path);
  };
  const auto* found = std::find_if(kRows.begin(), kRows.end(), fits);
  return found == kRows.end() ? nullptr : found;
}

Error invalid(std::string message) { return {Errc::kInvalidArgument, std::move(message)}; }

Error no_such_key(const std::string& component, const std::string& key,
                  const std::vector<api::ComponentSetting>& there) {
  constexpr std::size_t kFew = 30;
  std::string keys;
  for (const api::ComponentSetting& setting : there) {
    keys += (keys.empty() ? "" : ", ") + setting.key;
  }
  return invalid(component + " has no setting '" + key + "'" +
                 (there.empty()          ? ""
                  : there.size() <= kFew ? "; there are: " + keys
                                         : "; 'seeker components get " + component + "' lists those there are"));
}

template <class E>
Result<E> choice_of(const config::Choices<E>& choices, const std::string& component, const std::string& type) {
  std::string names;
  for (const auto& [name, choice] : choices) {
    if (name == type) {
      return choice;
    }
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return tl::unexpected<Error>(invalid(component + " cannot be '" + type + "'; there are: " + names));
}

const api::ComponentSetting* find(const std::vector<api::ComponentSetting>& settings, const std::string& key) {
  const auto found = std::find_if(settings.begin(), settings.end(),
                                  [&](const api::ComponentSetting& setting) { return setting.key == key; });
  return found == settings.end() ? nullptr : &*found;
}

/// "key=value" of a component as "path=value" of a robot file.
Result<std::string> override_of(const std::string& component, const std::string& assignment,
                                const std::vector<api::ComponentSetting>& there) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    return tl::unexpected<Error>(invalid("expected key=value, got '" + assignment + "'"));
  }
  const std::string key = assignment.substr(0, equals);
  const api::ComponentSetting* setting = find(there, key);
  if (setting == nullptr) {
    return tl::unexpected<Error>(no_such_key(component, key, there));
  }
  if (setting->effect == SettingEffect::kRestart) {
    return fail(Errc::kRefused, setting->path + " takes effect after a restart only, since " +
                                    std::string(row_of(component, setting->path)->why_restart) +
                                    "; write it into the robot file, or start seekerd with --set " + setting->path +
                                    assignment.substr(equals));
  }
  return setting->path + assignment.substr(equals);
}

/// What a driver delivers by.
std::optional<Duration> period_in(const RobotOptions& options, const std::string& component) {
  const drivers::SimDeviceParams& devices = options.sim.devices;
  return component == "base"    ? std::optional(devices.base_period)
         : component == "lidar" ? std::optional(devices.lidar_period)
         : component == "sonar" ? std::optional(devices.sonar_period)
                                : std::nullopt;
}

}  // namespace

LiveOptions::LiveOptions(std::shared_ptr<RobotOptions> options, Devices devices,
                         std::shared_ptr<LandmarkLibrary> landmarks)
    : options_(std::move(options)), devices_(std::move(devices)), landmarks_(std::move(landmarks)) {}

std::vector<api::ComponentSetting> LiveOptions::settings(const std::string& component) const {
  return settings_in(*options_, component);
}

std::vector<api::ComponentSetting> LiveOptions::settings_in(const RobotOptions& options,
                                                            const std::string& component) const {
  std::vector<api::ComponentSetting> settings;
  for (const config::Leaf& leaf : config::leaves_of(options)) {
    const Row* row = row_of(component, leaf.path);
    // Only simulated devices take their periods from the robot file.
    if (row == nullptr || (row->path.starts_with("sim.") && options.driver != DriverType::kSim)) {
      continue;
    }
    settings.push_back(
        {std::string(row->key) + leaf.path.substr(row->path.size()), leaf.value, leaf.path, row->effect});
  }
  return settings;
}

Result<SettingChange> LiveOptions::read(const std::string& component,
                                        const std::vector<std::string>& assignments) const {
  const std::vector<api::ComponentSetting> before = settings(component);
  std::vector<std::string> overrides;
  for (const std::string& assignment : assignments) {
    Result<std::string> path = override_of(component, assignment, before);
    if (!path) {
      return tl::unexpected<Error>(path.error());
    }
    overrides.push_back(std::move(*path));
  }
  const Result<config::Document> document = config::Document::parse("", "settings", overrides);
  auto next = std::make_shared<RobotOptions>(*options_);
  Status ok = document ? document->read(*next) : Status(tl::unexpected<Error>(document.error()));
  ok = ok ? validate(*next) : ok;
  if (!ok) {
    return tl::unexpected<Error>(invalid(ok.error().message));
  }
  SettingChange change;
  for (api::ComponentSetting& setting : settings_in(*next, component)) {
    if (*find(before, setting.key) != setting) {
      change.changed.push_back(std::move(setting));
    }
  }
  change.loop = {next, &next->loop};
  if (period_in(*next, component) != period_in(*options_, component)) {
    change.period = period_in(*next, component);
  }
  if (next->search.recogniser != options_->search.recogniser) {
    change.recogniser = next->search.recogniser;
  }
  change.keep = [options = options_, next] { *options = *next; };
  return change;
}

Result<Exchange> LiveOptions::exchange(const std::string& component, const std::string& type) const {
  RobotOptions next = *options_;
  if (component == "pose") {
    const Result<EstimatorType> estimator = choice_of(estimator_names(), component, type);
    if (!estimator) {
      return tl::unexpected<Error>(estimator.error());
    }
    next.estimator = *estimator;
    return exchange_estimator(next);
  }
  Exchange exchange;
  if (component == "recogniser") {
    const auto kind = choice_of(recogniser_names(), component, type);
    if (!kind) {
      return tl::unexpected<Error>(kind.error());
    }
    exchange.keep = [options = options_, kind = *kind] { options->recogniser = kind; };
    return exchange;
  }
  if (component == "planner") {
    const auto strategy = choice_of(planner_names(), component, type);
    if (!strategy) {
      return tl::unexpected<Error>(strategy.error());
    }
    exchange.keep = [options = options_, strategy = *strategy] { options->search.strategy = strategy; };
    return exchange;
  }
  return fail(Errc::kRefused, component +
                                  " cannot be exchanged while the robot runs, only pose, recogniser and planner "
                                  "can; compose the robot in its file and restart seekerd");
}

Result<Exchange> LiveOptions::exchange_estimator(const RobotOptions& next) const {
  Result<std::unique_ptr<Estimator>> estimator = make_estimator(next, devices_, landmarks_);
  if (!estimator) {
    return tl::unexpected<Error>(estimator.error());
  }
  Exchange exchange;
  exchange.estimator = std::move(*estimator);
  exchange.keep = [options = options_, landmarks = landmarks_, type = next.estimator] {
    options->estimator = type;
    landmarks->set_in_use(database_in_use(*options));
  };
  return exchange;
}

}  // namespace seeker::app
