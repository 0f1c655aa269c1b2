/// \file
/// The recordings of a Pioneer in lidar/p3dx, and where its localiser saw it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include <zlib.h>

#include "common/core/pose2.hpp"
#include "server/drivers/replay/replay.hpp"

namespace seeker::slam {

/// Its laser scanner.
inline drivers::ReplayParams pioneer_params() {
  drivers::ReplayParams params;
  params.angle_min_rad = -2.356194;
  params.angle_step_rad = 0.00613592;
  params.range_max_m = 5.6;
  params.base_T_laser = {0.135, 0.0, 0.0};
  return params;
}

/// The localiser's map_T_odom, in a map of the building.
class PioneerCorrections {
 public:
  /// `path`: `t,x,y,theta` lines of a gzip file.
  explicit PioneerCorrections(const std::filesystem::path& path) {
    gzFile file = gzopen(path.c_str(), "rb");
    char line[256];
    while (file != nullptr && gzgets(file, line, sizeof(line)) != nullptr) {
      std::istringstream words(line);
      double t = 0.0;
      Pose2 pose;
      char comma = ',';
      if (words >> t >> comma >> pose.x_m >> comma >> pose.y_m >> comma >> pose.theta_rad) {
        map_T_odom_[t] = pose;
      }
    }
    gzclose(file);
  }

  /// The pose of the robot in the building's map; nothing where the localiser has none.
  [[nodiscard]] std::optional<Pose2> map_T_base(double stamp_s, const Pose2& odom_T_base) const {
    constexpr double kEarlier_s = 0.05;
    const auto at = map_T_odom_.lower_bound(stamp_s - kEarlier_s);
    return at == map_T_odom_.end() ? std::nullopt : std::optional<Pose2>(at->second * odom_T_base);
  }

 private:
  std::map<double, Pose2> map_T_odom_;  ///< by time in seconds
};

}  // namespace seeker::slam
