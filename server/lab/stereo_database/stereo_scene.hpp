/// \file
/// The laboratory of the stereo experiment (spec S2.4, S2.11): what the camera sees from where, and how furniture
/// moves.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/core/rng.hpp"
#include "server/localize/geometry.hpp"
#include "server/sim/simulation.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::lab {

inline constexpr double kEncoderPeriod_s = 0.1;

/// A simulated robot as a localiser knows it: what its encoders and its eyes tell.
class SeeingRobot {
 public:
  /// At `start`, where it must have room.
  [[nodiscard]] static Result<SeeingRobot> create(sim::World world, const sim::RobotModel& model,
                                                  const vision::StereoFeatureParams& features, const Pose2& start,
                                                  std::uint64_t seed);

  /// Moves for kEncoderPeriod_s and returns the velocity that the encoders told.
  Twist2 move(const Twist2& wanted);
  /// Turns on the spot, by its odometry, and stands still. The velocities as from move().
  [[nodiscard]] std::vector<Twist2> turn(double by_rad);
  /// kInvalidArgument: the pictures are refused.
  [[nodiscard]] Result<vision::StereoFeatures> look();
  [[nodiscard]] Pose2 world_T_base() const { return simulation_.truth().world_T_base; }
  [[nodiscard]] double time_s() const { return to_seconds(simulation_.now()); }

 private:
  SeeingRobot(sim::Simulation simulation, std::unique_ptr<vision::StereoExtractor> extractor)
      : simulation_(std::move(simulation)),
        extractor_(std::move(extractor)),
        odom_T_base_(simulation_.odometry().odom_T_base) {}

  sim::Simulation simulation_;
  std::unique_ptr<vision::StereoExtractor> extractor_;
  Pose2 odom_T_base_;
};

/// One frame of a drive: where the robot truly was, what its encoders told since the frame before, what it saw.
struct DriveFrame {
  Pose2 world_T_base;
  std::vector<Twist2> velocities;  ///< each over kEncoderPeriod_s
  vision::StereoFeatures seen;
};

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

/// A frame that is refused, since nothing is to be seen in it, is a frame without features.
[[nodiscard]] Result<vision::StereoFeatures> or_nothing(Result<vision::StereoFeatures> seen);

/// What is seen from poses of the base, without a robot that drives there; or_nothing().
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
