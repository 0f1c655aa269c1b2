/// \file
/// The laboratory of the stereo experiment (spec S2.4, S2.11): what the camera sees from where, and how furniture
/// moves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/rng.hpp"
#include "server/localize/geometry.hpp"
#include "server/sim/robot_model.hpp"
#include "server/sim/world.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::lab {

/// One frame of a drive: where the robot truly was, what its encoders told since the frame before, what it saw.
struct DriveFrame {
  Pose2 world_T_base;
  std::vector<Twist2> velocities;  ///< each over kEncoderPeriod_s
  vision::StereoFeatures seen;
};
inline constexpr double kEncoderPeriod_s = 0.1;

/// The laboratory with textures of `pattern_seed`.
[[nodiscard]] Result<sim::World> load_laboratory(const std::filesystem::path& config, std::uint64_t pattern_seed);
/// Moves `share` of the objects, none of them into the way of drive_around(). kUnreachable: that cannot be done.
[[nodiscard]] Result<sim::World> move_furniture(const sim::World& world, const sim::RobotModel& model, double share,
                                                Rng& rng);

/// Five places with room around them, twelve headings each, in the frame of the left eye (spec S2.4).
[[nodiscard]] std::vector<Pose2> survey_poses(const sim::World& world, const sim::RobotModel& model);
/// Places with room for the robot, anywhere in the room and in any direction; of the base.
[[nodiscard]] std::vector<Pose2> random_poses(const sim::World& world, const sim::RobotModel& model, int count,
                                              Rng& rng);

/// What is seen from poses of the base, without a robot that drives there.
[[nodiscard]] Result<std::vector<vision::StereoFeatures>> look_from(const sim::World& world,
                                                                    const sim::RobotModel& model,
                                                                    const vision::StereoFeatureParams& features,
                                                                    const std::vector<Pose2>& world_T_bases, Rng& rng);

/// A drive around the laboratory at the paper's speeds (0.07 m/s, 0.23 rad/s), from its start. A frame every
/// `period_s`.
[[nodiscard]] Result<std::vector<DriveFrame>> drive_around(const sim::World& world, const sim::RobotModel& model,
                                                           const vision::StereoFeatureParams& features,
                                                           std::uint64_t seed, double period_s);

}  // namespace seeker::lab
