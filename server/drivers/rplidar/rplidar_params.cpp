#include "server/drivers/rplidar/rplidar_params.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/core/scan.hpp"

namespace seeker::drivers {
namespace {

constexpr std::uint16_t kMaxPwm = 1023;
constexpr double kLeastBeams = 8.0;

Status refuse(const std::string& field, const std::string& allowed) {
  return fail(Errc::kInvalidArgument, "the RPLIDAR's " + field + " must be " + allowed);
}

bool holds_nothing(Duration duration) { return duration <= Duration::zero(); }

}  // namespace

Status validate(const RplidarParams& params) {
  if (params.bauds.empty() || std::find(params.bauds.begin(), params.bauds.end(), 0U) != params.bauds.end()) {
    return refuse("bauds", "at least one rate above 0");
  }
  if (params.motor_pwm > kMaxPwm) {
    return refuse("motor_pwm", "at most " + std::to_string(kMaxPwm));
  }
  if (!is_finite(params.base_T_laser)) {
    return refuse("base_T_laser", "finite");
  }
  if (!(params.range_min_m >= 0.0 && params.range_min_m < params.range_max_m && std::isfinite(params.range_max_m))) {
    return refuse("range_min_m", "at least 0 and below range_max_m");
  }
  if (!(params.angle_step_rad >= kTwoPi / static_cast<double>(kMaxScanBeams) &&
        params.angle_step_rad <= kTwoPi / kLeastBeams)) {
    return refuse("angle_step_rad", "between a turn's 8192nd and 8th part");
  }
  if (!(params.least_revolution_share > 0.0 && params.least_revolution_share <= 1.0)) {
    return refuse("least_revolution_share", "above 0 and at most 1");
  }
  if (params.tries < 1 || params.restarts < 0 || params.resets < 0) {
    return refuse("tries, restarts and resets", "at least 1, 0 and 0");
  }
  if (holds_nothing(params.answer_timeout) || holds_nothing(params.stop_pause) || holds_nothing(params.boot_time) ||
      holds_nothing(params.scan_timeout) || holds_nothing(params.revolution_timeout)) {
    return refuse("time-outs and pauses", "above 0");
  }
  return {};
}

}  // namespace seeker::drivers
