/// \file
/// What an operator should see of a port's protection in `seeker status`.
#pragma once

#include <vector>

#include "common/api/robot_state.hpp"
#include "common/net/link_health.hpp"
#include "common/pki/certificate.hpp"

namespace seeker::server_net {

/// The faults at `now`, without onset: `link-insecure` (warning) for plain TCP beyond loopback, `certificate-files`
/// (warning) where the newest files are not in use, `certificate-expiry`: a warning for 30 days, then an error, which
/// forbids motion, since nobody can connect to stop the robot any more.
[[nodiscard]] std::vector<api::Fault> link_faults(const net::LinkHealth& health, pki::CalendarTime now);

}  // namespace seeker::server_net
