#include "server/drivers/p2os/base_limits.hpp"

#include <algorithm>

#include "common/core/angle.hpp"

namespace seeker::drivers {
namespace {

/// The value, or the limit that the base states if that is smaller.
double within(double value, double stated) { return stated > 0.0 ? std::min(value, stated) : value; }

}  // namespace

BaseLimits base_limits(const P2osParams& params, const p2os::PioneerModel& model,
                       const std::optional<p2os::ConfigPacket>& config) {
  BaseLimits limits{std::min(params.v_max_m_s, model.v_max_m_s),
                    std::min(params.omega_max_rad_s, model.omega_max_rad_s),
                    params.acceleration_m_s2,
                    params.deceleration_m_s2,
                    params.angular_acceleration_rad_s2,
                    params.angular_deceleration_rad_s2};
  if (config) {
    const double v_top_m_s = config->trans_vel_top * model.velocity_unit_m_s;
    const double a_top_m_s2 = config->trans_acc_top * p2os::kMetre;
    const double alpha_top_rad_s2 = deg_to_rad(config->rot_acc_top);
    limits.v_max_m_s = within(limits.v_max_m_s, v_top_m_s);
    limits.omega_max_rad_s = within(limits.omega_max_rad_s, deg_to_rad(config->rot_vel_top));
    limits.acceleration_m_s2 = within(limits.acceleration_m_s2, a_top_m_s2);
    limits.deceleration_m_s2 = within(limits.deceleration_m_s2, a_top_m_s2);
    limits.angular_acceleration_rad_s2 = within(limits.angular_acceleration_rad_s2, alpha_top_rad_s2);
    limits.angular_deceleration_rad_s2 = within(limits.angular_deceleration_rad_s2, alpha_top_rad_s2);
  }
  return limits;
}

}  // namespace seeker::drivers
