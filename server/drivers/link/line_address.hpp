/// \file
/// Where a device is connected.
#pragma once

#include <cstdint>
#include <string>

#include "common/core/result.hpp"

namespace seeker::drivers {

/// A serial port by its path (`/dev/ttyUSB0`), or a TCP port (`tcp://HOST:PORT`).
struct LineAddress {
  std::string path;  ///< of a serial port; empty: TCP
  std::string host;
  std::uint16_t port = 0;

  [[nodiscard]] bool serial() const { return !path.empty(); }
  friend bool operator==(const LineAddress&, const LineAddress&) = default;
};

/// Errors say what an address looks like. `default_port` is taken where a TCP address names none; 0: it must.
[[nodiscard]] Result<LineAddress> parse_line_address(const std::string& text, std::uint16_t default_port = 0);
/// As parse_line_address() reads it.
[[nodiscard]] std::string to_string(const LineAddress& address);

}  // namespace seeker::drivers
