/// \file
/// The components of a robot as clients see them: lifecycle, ports and settings (spec S4.9).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/time.hpp"

namespace seeker::api {

enum class ComponentState : std::uint8_t { kCreated, kInactive, kActive, kError };
[[nodiscard]] std::string_view to_string(ComponentState state);

/// An input or an output of a component. An input holds the newest value of the outputs that are connected to it.
struct ComponentPort {
  std::string name;
  std::string type;                    ///< of its values: "LaserScan", ...
  bool output = false;                 ///< false: an input
  std::vector<std::string> connected;  ///< ports at the other ends, each as "component.port"
  double rate_hz = 0.0;                ///< values per second of robot time, over the last seconds
  std::optional<Duration> age;         ///< robot time since the last value; absent before the first one

  friend bool operator==(const ComponentPort&, const ComponentPort&) = default;
};

/// What has gone over the line of a device since it was activated.
struct ComponentLink {
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
  std::uint64_t packets_in = 0;     ///< whole and valid
  std::uint64_t packets_bad = 0;    ///< refused: wrong checksum, impossible length or content
  std::uint64_t bytes_skipped = 0;  ///< outside any packet
  std::uint64_t connects = 0;       ///< completed handshakes

  friend bool operator==(const ComponentLink&, const ComponentLink&) = default;
};

/// A part of the robot: registered by name, with a lifecycle (spec S4.9).
struct ComponentInfo {
  std::string name;
  std::string kind;  ///< "driver", "estimator", "behaviour", "recogniser", ...
  std::string type;  ///< "sim", "replay", "scan_match", ...
  ComponentState state = ComponentState::kCreated;
  double rate_hz = 0.0;  ///< outputs per second of robot time, over the last seconds
  std::string last_error;
  std::vector<ComponentPort> ports;
  std::optional<ComponentLink> link;  ///< of a driver whose device has a line

  friend bool operator==(const ComponentInfo&, const ComponentInfo&) = default;
};

/// When a changed setting of a component takes effect.
enum class SettingEffect : std::uint8_t {
  kNow,          ///< at once, also in a mission that runs
  kNextMission,  ///< in missions that start later
  kExchange,     ///< when the component is exchanged
  kRestart,      ///< after a restart of the robot's program only: a change is refused
};
[[nodiscard]] std::string_view to_string(SettingEffect effect);

/// One value of a component's configuration set.
struct ComponentSetting {
  std::string key;    ///< within the component
  std::string value;  ///< as it is written in a robot file
  std::string path;   ///< of the same value in a robot file
  SettingEffect effect = SettingEffect::kRestart;

  friend bool operator==(const ComponentSetting&, const ComponentSetting&) = default;
};

}  // namespace seeker::api
