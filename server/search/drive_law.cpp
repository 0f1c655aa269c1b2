#include "server/search/drive_law.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::search {

Twist2 drive_command(double heading_change_rad, double front_m, const DriveLawParams& params) {
  const double room = std::clamp((front_m - params.stop_distance_m) / params.slow_span_m, 0.0, 1.0);
  const double along = std::max(0.0, std::cos(heading_change_rad));
  return {params.max_v_m_s * room * along,
          std::clamp(heading_change_rad / params.rotation_time_s, -params.max_omega_rad_s, params.max_omega_rad_s)};
}

}  // namespace seeker::search
