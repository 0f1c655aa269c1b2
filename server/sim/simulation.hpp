/// \file
/// The simulated robot in its world: stands in for the hardware (spec S0.6). Single-threaded and deterministic: the
/// same world, model, seed and calls give the same readings.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "common/core/stereo.hpp"
#include "common/core/time.hpp"
#include "server/sim/robot_model.hpp"
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

class Simulation {
 public:
  /// Fails where world or model are not valid, or where the robot has no room at `start`.
  [[nodiscard]] static Result<Simulation> create(World world, RobotModel model, std::uint64_t seed,
                                                 std::size_t start = 0);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// The velocity to accelerate to; clamped to the model's limits, held until the next call.
  void command(const Twist2& velocity);
  /// Lets the world go on, in steps of at most 10 ms. A body that meets an obstacle stops there.
  void advance(Duration period);
  [[nodiscard]] RobotTime now() const;

  [[nodiscard]] BaseReading odometry() const;
  /// One sweep, taken at this moment. Each call draws new noise.
  [[nodiscard]] LaserScan scan();
  [[nodiscard]] SonarScan sonar();
  /// Grey picture of the mirror: image up = forward, image left = +90 deg, centre as in the model.
  [[nodiscard]] Image omni_image();

  /// Both eyes of the stereo camera at this moment, grey, rectified up to the errors of the model.
  [[nodiscard]] StereoFrame stereo_pair();

  [[nodiscard]] GroundTruth truth() const;
  [[nodiscard]] const World& world() const;
  [[nodiscard]] const RobotModel& model() const;

 private:
  struct State;
  explicit Simulation(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace seeker::sim
