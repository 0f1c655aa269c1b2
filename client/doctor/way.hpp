/// \file
/// The address of a robot: what its name stands for, and whether something listens there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::doctor {

/// IP addresses of a host. kNotFound names the cause.
[[nodiscard]] Result<std::vector<std::string>> addresses_of(const std::string& host);

/// Whether a TCP connection can be made, which is closed at once. kLinkLost, kTimeout.
[[nodiscard]] Status try_port(const std::string& host, std::uint16_t port, Duration limit);

}  // namespace seeker::doctor
