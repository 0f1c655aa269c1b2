/// \file
/// One simulated robot: its body, and its sensors with their noise. What else moves it is told from outside.
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

/// What the base reports about itself.
struct BaseReading {
  Pose2 odom_T_base;  ///< by the encoders, since the start
  Twist2 velocity;    ///< by the encoders
  double battery_v = 0.0;
  bool stalled = false;  ///< the wheels are commanded but something blocks them
  bool bumped = false;   ///< the body touches something
};

struct TargetTruth {
  std::string name;
  Pose2 world_T_target;
};

/// What really happened. For scoring only: no driver, estimator or behaviour may look at it.
struct GroundTruth {
  Pose2 world_T_base;
  Pose2 world_T_start;  ///< the frame `map` of a robot that began at its own origin
  Twist2 velocity;
  int contacts = 0;              ///< touches since the start, each counted once however long it lasts
  double path_length_m = 0.0;    ///< way of the robot's centre
  double min_clearance_m = 0.0;  ///< smallest distance so far between body and anything; 0 after a contact
  std::vector<TargetTruth> targets;
};

/// Its noise comes from its own seed, so that no other robot shifts it.
class RobotInWorld {
 public:
  /// Of a valid world, which must outlive this, and a valid model. `serial` tells its paint from other robots'.
  RobotInWorld(const World& world, RobotModel model, std::uint64_t seed, const Pose2& start, std::size_t serial);

  void command(const Twist2& velocity) { wanted_ = velocity; }
  /// Everything but the building that it can see and touch.
  void set_surroundings(std::vector<Disc> moving) { scene_.set_moving(std::move(moving)); }
  /// One step of at most 10 ms.
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
  /// How others see it.
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
  std::unique_ptr<OmniRenderer> omni_;  ///< made with the first picture: its tables are large
  std::unique_ptr<StereoRenderer> stereo_;
};

}  // namespace seeker::sim
