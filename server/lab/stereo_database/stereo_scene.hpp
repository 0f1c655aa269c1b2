/// \file
/// The laboratory of the stereo experiment (spec S2.4, S2.11): views of the camera from given places, and moved
/// furniture.
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

/// A simulated robot with the data that a localiser receives: encoder velocities and features of the eyes.
class SeeingRobot {
 public:
  /// Makes a robot at `start`, where it must have room.
  [[nodiscard]] static Result<SeeingRobot> create(sim::World world, const sim::RobotModel& model,
                                                  const vision::StereoFeatureParams& features, const Pose2& start,
                                                  std::uint64_t seed);

  /// Moves for kEncoderPeriod_s and returns the velocity that the encoders reported.
  Twist2 move(const Twist2& wanted);
  /// Rotates on the spot by an odometry angle and stops. Returns the velocities as from move().
  [[nodiscard]] std::vector<Twist2> rotate(double by_rad);
  /// The features of both eyes now. kInvalidArgument: the pictures are rejected.
  [[nodiscard]] Result<vision::StereoFeatures> look();
  /// The pictures of both eyes now.
  [[nodiscard]] StereoFrame photograph() { return simulation_.stereo_pair(); }
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

/// One frame of a drive: the true pose, the encoder velocities since the frame before, the pictures, and the features
/// observed in them.
struct DriveFrame {
  Pose2 world_T_base;
  std::vector<Twist2> velocities;  ///< each over kEncoderPeriod_s
  StereoFrame pair;                ///< empty where only the features are kept
  vision::StereoFeatures seen;
};

/// The laboratory with textures of `pattern_seed`.
[[nodiscard]] Result<sim::World> load_laboratory(const std::filesystem::path& config, std::uint64_t pattern_seed);
/// Moves `share` of the objects, none of them onto the path of drive_around(). kUnreachable: there is no such
/// arrangement.
[[nodiscard]] Result<sim::World> move_furniture(const sim::World& world, const sim::RobotModel& model, double share,
                                                Rng& rng);

/// Five places with room around them, twelve headings each, in the frame of the left eye (spec S2.4).
[[nodiscard]] std::vector<Pose2> survey_poses(const sim::World& world, const sim::RobotModel& model);
/// Poses of the base with room for the robot, anywhere in the room and in any direction.
[[nodiscard]] std::vector<Pose2> random_poses(const sim::World& world, const sim::RobotModel& model, int count,
                                              Rng& rng);

/// Replaces a rejected frame, in which nothing can be seen, by a frame without features.
[[nodiscard]] Result<vision::StereoFeatures> or_empty(Result<vision::StereoFeatures> seen);

/// Pictures taken at poses of the base, without a robot that drives there.
[[nodiscard]] std::vector<StereoFrame> photograph_from(const sim::World& world, const sim::RobotModel& model,
                                                       const std::vector<Pose2>& world_T_bases, Rng& rng);
/// The features of each pair; those of rejected pairs are empty.
[[nodiscard]] Result<std::vector<vision::StereoFeatures>> features_of(const std::vector<StereoFrame>& pairs,
                                                                      const sim::RobotModel& model,
                                                                      const vision::StereoFeatureParams& params);
/// Features observed from poses of the base: features_of() photograph_from(), one pair after the other.
[[nodiscard]] Result<std::vector<vision::StereoFeatures>> look_from(const sim::World& world,
                                                                    const sim::RobotModel& model,
                                                                    const vision::StereoFeatureParams& features,
                                                                    const std::vector<Pose2>& world_T_bases, Rng& rng);

/// A drive around the laboratory at the paper's speeds (0.07 m/s, 0.23 rad/s), from its start, with the pictures of a
/// frame every `period_s`, but no features yet.
[[nodiscard]] Result<std::vector<DriveFrame>> photograph_drive(const sim::World& world, const sim::RobotModel& model,
                                                               std::uint64_t seed, double period_s);
/// The same drive with the features of its frames. Of the pictures only those of kept_frames() are kept.
[[nodiscard]] Result<std::vector<DriveFrame>> drive_around(const sim::World& world, const sim::RobotModel& model,
                                                           const vision::StereoFeatureParams& features,
                                                           std::uint64_t seed, double period_s);
/// Indices of the four frames of a drive that Fig 12 shows.
[[nodiscard]] std::vector<std::size_t> kept_frames(std::size_t frames);

}  // namespace seeker::lab
