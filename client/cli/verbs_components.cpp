// seeker components: the parts of the robot, their ports, settings and types.

#include <iomanip>

#include <nlohmann/json.hpp>

#include "client/cli/verbs.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"

namespace seeker::cli {
namespace {

/// "  odometry   out Odometry         10.0 Hz  0.1 s ago  to pose.odometry, safety.odometry"
void print_port(const Context& context, const api::ComponentPort& port) {
  std::string peers;
  for (const std::string& peer : port.connected) {
    peers += (peers.empty() ? (port.output ? "to " : "from ") : ", ") + peer;
  }
  *context.out << "  " << std::left << std::setw(14) << port.name << ' ' << std::setw(4) << (port.output ? "out" : "in")
               << std::setw(24) << port.type << ' ' << fixed("%6.1f Hz", port.rate_hz) << "  " << std::setw(12)
               << (port.age ? fixed("%.1f s ago", to_seconds(*port.age)) : "no value")
               << (peers.empty() ? "not connected" : peers) << '\n';
}

/// "  line        48211 packets, 3 damaged, 12 bytes skipped, 2.4 MB in, 0.1 MB out, connected 2 times"
void print_link(const Context& context, const api::ComponentLink& link) {
  constexpr double kBytesPerMegabyte = 1e6;
  *context.out << "  " << std::left << std::setw(14) << "line" << ' ' << link.packets_in << " packets, "
               << link.packets_bad << " damaged, " << link.bytes_skipped << " bytes skipped, "
               << fixed("%.2f MB in, ", static_cast<double>(link.bytes_in) / kBytesPerMegabyte)
               << fixed("%.2f MB out", static_cast<double>(link.bytes_out) / kBytesPerMegabyte) << ", connected "
               << link.connects << (link.connects == 1 ? " time" : " times") << '\n';
}

VerbResult list_components(const Context& context) {
  const auto components = ask<std::vector<api::ComponentInfo>>(context, &api::RobotApi::list_components);
  if (!components) {
    return tl::unexpected<Error>(components.error());
  }
  if (context.json) {
    *context.out << json_line(Json{{"components", *components}}) << '\n';
    return ExitCode::kOk;
  }
  for (const api::ComponentInfo& c : *components) {
    const std::string state(to_string(c.state));
    const bool wrong = context.colour && c.state == api::ComponentState::kError;
    *context.out << std::left << std::setw(16) << c.name << ' ' << std::setw(12) << c.kind << ' ' << std::setw(18)
                 << c.type << ' ' << std::setw(9) << (wrong ? "\x1b[31m" + state + "\x1b[0m" : state)
                 << fixed("%6.1f Hz", c.rate_hz) << (c.last_error.empty() ? "" : "  " + c.last_error) << '\n';
    for (const api::ComponentPort& port : c.ports) {
      print_port(context, port);
    }
    if (c.link) {
      print_link(context, *c.link);
    }
  }
  return ExitCode::kOk;
}

std::string when(api::SettingEffect effect) {
  switch (effect) {
    case api::SettingEffect::kNow: return "at once";
    case api::SettingEffect::kNextMission: return "from the next mission on";
    case api::SettingEffect::kExchange: return "when it is exchanged";
    case api::SettingEffect::kRestart: return "after a restart of seekerd";
  }
  return "";
}

VerbResult show_settings(const Context& context, const Result<std::vector<api::ComponentSetting>>& settings) {
  if (!settings) {
    return tl::unexpected<Error>(settings.error());
  }
  if (context.json) {
    *context.out << json_line(Json{{"settings", *settings}}) << '\n';
    return ExitCode::kOk;
  }
  for (const api::ComponentSetting& setting : *settings) {
    *context.out << std::left << std::setw(36) << setting.key << ' ' << std::setw(16) << setting.value << ' '
                 << std::setw(26) << when(setting.effect) << ' ' << setting.path << '\n';
  }
  if (settings->empty()) {
    say(context, "this component has no settings");
  }
  return ExitCode::kOk;
}

VerbResult get_settings(const Context& context, const std::string& component) {
  using Settings = std::vector<api::ComponentSetting>;
  return show_settings(context, ask<Settings>(context, [&](api::Reply<Settings> reply) {
                         context.robot->get_settings(component, std::move(reply));
                       }));
}

VerbResult set_settings(const Context& context, const ComponentsVerb& verb) {
  using Settings = std::vector<api::ComponentSetting>;
  return show_settings(context, ask<Settings>(context, [&](api::Reply<Settings> reply) {
                         context.robot->set_settings(verb.name, verb.assignments, std::move(reply));
                       }));
}

/// Makes a call without a result, says what was done and lists the components as they are then.
VerbResult change(const Context& context, const std::function<void(api::Reply<void>)>& call, const std::string& done) {
  if (const Status ok = ask<void>(context, call); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  say(context, done);
  return list_components(context);
}

}  // namespace

VerbResult show_components(const Context& context, const ComponentsVerb& verb) {
  constexpr const char* kMotorsOff = "; the motors are off until a mission starts or is resumed, or somebody drives";
  const auto switch_to = [&](bool active) {
    return [&context, &verb, active](api::Reply<void> reply) {
      context.robot->switch_component(verb.name, active, std::move(reply));
    };
  };
  switch (verb.action) {
    case ComponentsAction::kGet: return get_settings(context, verb.name);
    case ComponentsAction::kSet: return set_settings(context, verb);
    case ComponentsAction::kExchange:
      return change(
          context,
          [&](api::Reply<void> reply) { context.robot->exchange_component(verb.name, verb.type, std::move(reply)); },
          verb.name + " is " + verb.type + " now");
    case ComponentsAction::kActivate: return change(context, switch_to(true), "activated " + verb.name + kMotorsOff);
    case ComponentsAction::kDeactivate:
      return change(context, switch_to(false), "deactivated " + verb.name + "; the robot stands still meanwhile");
    case ComponentsAction::kList: break;
  }
  if (verb.restart.empty()) {
    return list_components(context);
  }
  return change(
      context, [&](api::Reply<void> reply) { context.robot->restart_component(verb.restart, std::move(reply)); },
      "restarted " + verb.restart + kMotorsOff);
}

}  // namespace seeker::cli
