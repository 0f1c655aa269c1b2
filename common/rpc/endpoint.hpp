/// \file
/// Address of a robot in the notation of command lines.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/core/result.hpp"

namespace seeker::rpc {

inline constexpr std::uint16_t kDefaultPort = 7471;

struct Endpoint {
  std::string host = "127.0.0.1";
  std::uint16_t port = kDefaultPort;

  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// Reads "host", "host:port", "1.2.3.4:port", "[::1]" or "[::1]:port". An IPv6 address without brackets is refused,
/// since its last group could be a port.
[[nodiscard]] Result<Endpoint> parse_endpoint(std::string_view text);
/// Writes the notation that parse_endpoint() reads, always with the port.
[[nodiscard]] std::string to_string(const Endpoint& endpoint);
/// Whether a host is this machine by its name or address alone; nothing is looked up.
[[nodiscard]] bool is_this_machine(std::string_view host);

}  // namespace seeker::rpc
