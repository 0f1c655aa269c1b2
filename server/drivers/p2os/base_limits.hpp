/// \file
/// What a base is driven with: the smallest of what is wanted, what its model can and what its configuration states.
#pragma once

#include <optional>

#include "server/drivers/p2os/p2os_params.hpp"
#include "server/protocols/p2os/config_packet.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"

namespace seeker::drivers {

struct BaseLimits {
  double v_max_m_s = 0.0;
  double omega_max_rad_s = 0.0;
  double acceleration_m_s2 = 0.0;
  double deceleration_m_s2 = 0.0;
  double angular_acceleration_rad_s2 = 0.0;
  double angular_deceleration_rad_s2 = 0.0;
};

/// A limit that the configuration states as 0 is not stated.
[[nodiscard]] BaseLimits base_limits(const P2osParams& params, const p2os::PioneerModel& model,
                                     const std::optional<p2os::ConfigPacket>& config);

}  // namespace seeker::drivers
