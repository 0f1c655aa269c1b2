/// \file
/// Rates of serial lines that POSIX has no name for.
#pragma once

#include <cstdint>

#include <boost/system/error_code.hpp>

namespace seeker::drivers {

/// Sets the rate of the serial line `descriptor` in both directions, as near to it as its hardware can. The error is
/// that of the system.
[[nodiscard]] boost::system::error_code set_any_baud(int descriptor, std::uint32_t baud);

}  // namespace seeker::drivers
