/// \file
/// Where the figures of a running robot can be read.
#pragma once

#include <cstdint>
#include <string>

#include "common/core/result.hpp"

namespace seeker::app {

/// A page of text that Prometheus reads. It says what the robot does to whoever reaches it, so that it is offered to
/// this machine alone.
struct MetricsSettings {
  std::string address = "127.0.0.1";  ///< 127.x.y.z or [::1]
  std::uint16_t port = 7475;          ///< 0: any free one

  friend bool operator==(const MetricsSettings&, const MetricsSettings&) = default;
};

/// Refuses addresses that other machines reach.
[[nodiscard]] Status validate(const MetricsSettings& settings);

}  // namespace seeker::app
