/// \file
/// One simulated robot: its body, and its sensors with their noise. Other moving objects are given from outside.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/rng.hpp"
#include "common/core/scan.hpp"
#include "common/core/stereo.hpp"
#include "common/core/time.hpp"
#include "server/sim/body_motion.hpp"
#include "server/sim/omni_renderer.hpp"
#include "server/sim/robot_model.hpp"
#include "server/sim/scene.hpp"
#include "server/sim/stereo_renderer.hpp"
#include "server/sim/world.hpp"

namespace seeker::sim {

/// The state that the base reports.
struct BaseReading {
  Pose2 odom_T_base;  ///< pose by the encoders, since the start
  Twist2 velocity;    ///< velocity by the encoders
  double battery_v = 0.0;
  bool stalled = false;  ///< the wheels are commanded but an obstacle blocks them
  bool bumped = false;   ///< the body touches an obstacle
};

struct TargetTruth {
  std::string name;
  Pose2 world_T_target;
};

/// The true state. It is for scoring only: no driver, estimator or behaviour may read it.
struct GroundTruth {
  Pose2 world_T_base;
  Pose2 world_T_start;  ///< frame `map` of a robot that began at its own origin
  Twist2 velocity;
  int contacts = 0;              ///< contacts since the start, each counted once regardless of its duration
  double path_length_m = 0.0;    ///< path length of the robot's centre
  double min_clearance_m = 0.0;  ///< smallest distance so far between the body and any object; 0 after a contact
  std::vector<TargetTruth> targets;
};

/// A robot in a world. Its noise is drawn from its own seed, so that other robots do not change it.
class RobotInWorld {
 public:
  /// Makes a robot in a valid world, which must outlive it, with a valid model. `serial` makes its paint differ from
  /// other robots'.
  RobotInWorld(const World& world, RobotModel model, std::uint64_t seed, const Pose2& start, std::size_t serial);

  void command(const Twist2& velocity) { wanted_ = velocity; }
  /// Sets all objects besides the building that the robot can see and touch.
  void set_surroundings(std::vector<Disc> moving) { scene_.set_moving(std::move(moving)); }
  /// Computes one step of at most 10 ms.
  void step(Duration period);

  [[nodiscard]] BaseReading odometry(RobotTime now) const;
  [[nodiscard]] LaserScan scan(RobotTime now);
  [[nodiscard]] SonarScan sonar(RobotTime now);
  [[nodiscard]] Image omni_image(RobotTime now);
  [[nodiscard]] Image tank_image();
  [[nodiscard]] StereoFrame stereo_pair(RobotTime now);

  [[nodiscard]] GroundTruth truth() const;
  [[nodiscard]] const RobotModel& model() const { return model_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// The robot as seen by others.
  [[nodiscard]] Disc disc() const;

 private:
  [[nodiscard]] double exposure(RobotTime now, Rng& rng) const;

  const World& world_;
  RobotModel model_;
  Scene scene_;
  BodyMotion body_;
  Encoders encoders_;
  Pose2 world_T_start_;
  Paint paint_;
  Twist2 wanted_;
  Rng root_;
  Rng odometry_rng_;
  Rng lidar_rng_;
  Rng sonar_rng_;
  Rng camera_rng_;
  Rng tank_rng_;
  Rng stereo_rng_;
  std::unique_ptr<OmniRenderer> omni_;  ///< made with the first picture, because its tables are large
  std::unique_ptr<StereoRenderer> stereo_;
};

}  // namespace seeker::sim
