/// \file
/// Laser scanner and sonar ring: their readings at one moment, with the errors of their models.
#pragma once

#include "common/core/rng.hpp"
#include "common/core/scan.hpp"
#include "server/sim/robot_model.hpp"
#include "server/sim/scene.hpp"

namespace seeker::sim {

/// One sweep of a robot at `world_T_base`.
[[nodiscard]] LaserScan sweep(const LidarModel& model, const Scene& scene, const Pose2& world_T_base, RobotTime stamp,
                              Rng& rng);

/// One reading of every transducer. A wall beyond the specular angle sends no echo, edges and corners do; the nearest
/// echo in the cone counts.
[[nodiscard]] SonarScan ping(const SonarModel& model, const Scene& scene, const Pose2& world_T_base, RobotTime stamp,
                             Rng& rng);

}  // namespace seeker::sim
