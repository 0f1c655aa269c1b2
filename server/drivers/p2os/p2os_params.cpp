#include "server/drivers/p2os/p2os_params.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"

namespace seeker::drivers {
namespace {

Status check_numbers(const P2osParams& p) {
  const std::array<std::pair<const char*, double>, 10> above_zero{
      {{"v_max", p.v_max_m_s},
       {"omega_max", p.omega_max_rad_s},
       {"acceleration", p.acceleration_m_s2},
       {"deceleration", p.deceleration_m_s2},
       {"angular_acceleration", p.angular_acceleration_rad_s2},
       {"angular_deceleration", p.angular_deceleration_rad_s2},
       {"sonar_range_max", p.sonar_range_max_m},
       {"sonar_cone_half_angle", p.sonar_cone_half_angle_rad},
       {"step_margin of distance", p.step_margin_m},
       {"step_margin of rotation", p.step_margin_rad}}};
  for (const auto& [name, value] : above_zero) {
    if (!std::isfinite(value) || value <= 0.0) {
      return fail(Errc::kInvalidArgument, std::string("the base's ") + name + " must be a number above 0");
    }
  }
  return {};
}

Status check_times(const P2osParams& p) {
  const std::array<std::pair<const char*, Duration>, 13> above_zero{{{"sonar_max_age", p.sonar_max_age},
                                                                     {"pulse_period", p.pulse_period},
                                                                     {"velocity_resend", p.velocity_resend},
                                                                     {"command_timeout", p.command_timeout},
                                                                     {"sip_timeout", p.sip_timeout},
                                                                     {"sync_timeout", p.sync_timeout},
                                                                     {"restart_pause", p.restart_pause},
                                                                     {"close_settle", p.close_settle},
                                                                     {"open_timeout", p.open_timeout},
                                                                     {"config_retry", p.config_retry},
                                                                     {"config_timeout", p.config_timeout},
                                                                     {"baud_settle", p.baud_settle},
                                                                     {"baud_timeout", p.baud_timeout}}};
  for (const auto& [name, value] : above_zero) {
    if (value <= Duration::zero()) {
      return fail(Errc::kInvalidArgument, std::string("the base's ") + name + " must be above 0 s");
    }
  }
  return {};
}

}  // namespace

Status validate(const P2osParams& params) {
  if (Status numbers = check_numbers(params); !numbers) {
    return numbers;
  }
  if (Status times = check_times(params); !times) {
    return times;
  }
  const auto unknown = [](std::uint32_t baud) { return !p2os::baud_code(baud); };
  if (params.serial && (params.bauds.empty() || std::any_of(params.bauds.begin(), params.bauds.end(), unknown) ||
                        (params.switch_to_baud && unknown(*params.switch_to_baud)))) {
    return fail(Errc::kInvalidArgument, "the base's rates must be some of 9600, 19200, 38400, 57600 and 115200 baud");
  }
  if (params.sync_tries < 1) {
    return fail(Errc::kInvalidArgument, "the base's sync_tries must be at least 1");
  }
  if (params.subclass && p2os::find_pioneer_model(*params.subclass) == nullptr) {
    return fail(Errc::kInvalidArgument, "the base's subclass '" + *params.subclass + "' is not known; it is one of " +
                                            p2os::known_subclasses());
  }
  return {};
}

}  // namespace seeker::drivers
