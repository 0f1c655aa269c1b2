#include "server/app/loop/component_commands.hpp"

#include <utility>

namespace seeker::app {
namespace {

tl::unexpected<Error> no_configuration() {
  return fail(Errc::kNotReady, "this robot was not made from a robot file, so that it has no settings");
}

/// Without its recogniser a robot drives as safely as with it; missions that need it are refused.
api::Severity severity_of(const std::string& component) {
  return component == "recogniser" ? api::Severity::kWarning : api::Severity::kError;
}

}  // namespace

ComponentCommands::ComponentCommands(const Parties& parties, const Devices& devices,
                                     std::shared_ptr<Configuration> configuration)
    : parties_(parties), devices_(devices), configuration_(std::move(configuration)) {}

void ComponentCommands::start() {
  Components& components = parties_.diagnostics.components();
  components.activate_all();
  parties_.sensing.restart_patience();
  for (const api::ComponentInfo& info : components.list(parties_.world.now())) {
    if (info.state == api::ComponentState::kError) {
      raise_failed(info.name, info.name + " did not start: " + info.last_error);
    }
  }
}

void ComponentCommands::raise_failed(const std::string& name, const std::string& message) {
  parties_.diagnostics.raise(name + "-failed", name, message,
                             "mend the cause, then 'seeker components --restart " + name + "'", severity_of(name));
}

/// What moves the robot may have changed: it stays disarmed until somebody moves it again on purpose.
void ComponentCommands::changed_state(const std::string& name) {
  parties_.motion.restarted(name);
  if (name == "base") {
    parties_.sensing.base_restarted();
  }
  for (const char* fault : {"-failed", "-invalid", "-silent", "-refused", "-inactive"}) {
    parties_.diagnostics.clear(name + fault);
  }
  parties_.sensing.restart_patience();
}

Status ComponentCommands::restart(const std::string& name) {
  if (const Status ok = parties_.diagnostics.components().restart(name); !ok) {
    if (ok.error().code == Errc::kInternal) {
      raise_failed(name, ok.error().message);
    }
    return ok;
  }
  changed_state(name);
  parties_.executor.pause(parties_.world.now(), name + " was restarted; resume the mission when the way is clear");
  parties_.diagnostics.log("component-restarted", name);
  return {};
}

Status ComponentCommands::switch_to(const std::string& name, bool active) {
  Components& components = parties_.diagnostics.components();
  if (active && components.active(name)) {
    return {};
  }
  if (!active && name == "base") {
    parties_.motion.halt();
  }
  if (const Status ok = active ? components.activate(name) : components.deactivate(name); !ok) {
    if (ok.error().code == Errc::kInternal) {
      raise_failed(name, ok.error().message);
    }
    return ok;
  }
  changed_state(name);
  if (active) {
    parties_.diagnostics.log("component-activated", name);
    return {};
  }
  parties_.sensing.forget(name);
  parties_.executor.pause(parties_.world.now(), name + " was deactivated; activate it, then resume the mission");
  parties_.diagnostics.raise(name + "-inactive", name, name + " was deactivated",
                             "'seeker components activate " + name + "'", severity_of(name));
  parties_.diagnostics.log("component-deactivated", name);
  return {};
}

Status ComponentCommands::exchange(const std::string& name, const std::string& type) {
  if (const Status ok = known(name); !ok) {
    return ok;
  }
  if (configuration_ == nullptr) {
    return no_configuration();
  }
  if (parties_.executor.present()) {
    return fail(Errc::kBusy, "a mission is running or paused; " + name + " can be exchanged when it has ended");
  }
  if (const Status ok = parties_.maps.may_change(); !ok) {
    return ok;
  }
  Result<Exchange> exchange = configuration_->exchange(name, type);
  if (!exchange) {
    return tl::unexpected<Error>(exchange.error());
  }
  std::string what_follows;
  if (exchange->estimator != nullptr) {
    use_estimator(std::move(exchange->estimator));
    what_follows = "; a new map begins where the robot is";
  }
  exchange->keep();
  parties_.diagnostics.components().set_type(name, type);
  parties_.diagnostics.log("component-exchanged", name + " is " + type + " now" + what_follows);
  return {};
}

/// The newest readings are given to the new estimator, so that the robot has a pose and a map at once.
void ComponentCommands::use_estimator(std::unique_ptr<Estimator> estimator) {
  const RobotTime now = parties_.world.now();
  parties_.localiser.exchange(std::move(estimator), now);
  parties_.maps.map_exchanged();
  parties_.missions.another_map_loaded();
  parties_.sensing.mark_as_new();
  // The epoch is that of the exchange already: no place has to follow.
  static_cast<void>(parties_.localiser.localise(parties_.sensing, parties_.neighbours, now));
  parties_.localiser.map_readings(parties_.sensing);
  parties_.sensing.mark_as_used();
  parties_.publisher.republish();
}

Status ComponentCommands::known(const std::string& name) const { return parties_.diagnostics.components().known(name); }

Result<std::vector<api::ComponentSetting>> ComponentCommands::settings(const std::string& name) const {
  if (const Status ok = known(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (configuration_ == nullptr) {
    return no_configuration();
  }
  return configuration_->settings(name);
}

Result<std::vector<api::ComponentSetting>> ComponentCommands::set(const std::string& name,
                                                                  const std::vector<std::string>& assignments) {
  if (const Status ok = known(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (configuration_ == nullptr) {
    return no_configuration();
  }
  Result<SettingChange> change = configuration_->read(name, assignments);
  if (!change) {
    return tl::unexpected<Error>(change.error());
  }
  const Status device = change->period ? use_period(name, *change->period) : Status();
  if (!device) {
    return tl::unexpected<Error>(device.error());
  }
  const Status mission = change->recogniser ? parties_.executor.use(*change->recogniser) : Status();
  if (!mission) {
    return tl::unexpected<Error>(mission.error());
  }
  use(*change->loop);
  change->keep();
  for (const api::ComponentSetting& setting : change->changed) {
    parties_.diagnostics.log("component-set", name + ": " + setting.path + " is " + setting.value + " now");
  }
  return std::move(change->changed);
}

Status ComponentCommands::use_period(const std::string& name, Duration period) {
  drivers::Driver* driver = name == "base"    ? static_cast<drivers::Driver*>(devices_.base.get())
                            : name == "lidar" ? static_cast<drivers::Driver*>(devices_.lidar.get())
                                              : static_cast<drivers::Driver*>(devices_.sonar.get());
  return driver->set_period(period);
}

void ComponentCommands::use(const LoopParams& params) {
  parties_.sensing.use(params);
  parties_.motion.use(params.safety);
  parties_.executor.use(params.mission);
  parties_.publisher.use(params);
  parties_.localiser.map().use(params.map);
  parties_.missions.use(params.map);
}

}  // namespace seeker::app
