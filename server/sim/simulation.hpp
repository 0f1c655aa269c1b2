/// \file
/// A simulated robot in its world, in place of the hardware (spec S0.6). It is single-threaded and deterministic: the
/// same world, model, seed and calls give the same readings. It has a world of its own or shares one (SharedWorld).
#pragma once

#include <cstdint>
#include <memory>

#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "common/core/stereo.hpp"
#include "common/core/time.hpp"
#include "server/sim/robot_in_world.hpp"
#include "server/sim/robot_model.hpp"
#include "server/sim/world.hpp"

namespace seeker::sim {

class SharedWorld;

class Simulation {
 public:
  /// Makes a robot in its own world. It fails when world or model are invalid, or when the robot has no room at
  /// `start`.
  [[nodiscard]] static Result<Simulation> create(World world, RobotModel model, std::uint64_t seed,
                                                 std::size_t start = 0);
  /// Robot `index` of a shared world.
  Simulation(std::shared_ptr<SharedWorld> shared, std::size_t index);

  /// Sets the velocity to accelerate to; it is limited to the model's limits and held until the next call.
  void command(const Twist2& velocity);
  /// Advances the time for all robots of the world, in steps of at most 10 ms. A body that meets an obstacle stops
  /// there.
  void advance(Duration period);
  [[nodiscard]] RobotTime now() const;

  [[nodiscard]] BaseReading odometry() const;
  /// One sweep, taken at this moment. Each call draws new noise.
  [[nodiscard]] LaserScan scan();
  [[nodiscard]] SonarScan sonar();
  /// Grey picture of the mirror: image up = forward, image left = +90 deg, centre as in the model.
  [[nodiscard]] Image omni_image();
  /// Grey picture of the camera that looks down at the floor of a tank.
  [[nodiscard]] Image tank_image();
  /// The picture of the camera that the model has.
  [[nodiscard]] Image camera_image();

  /// The pictures of both eyes of the stereo camera at this moment, grey, rectified up to the errors of the model.
  [[nodiscard]] StereoFrame stereo_pair();

  [[nodiscard]] GroundTruth truth() const;
  [[nodiscard]] const World& world() const;
  [[nodiscard]] const RobotModel& model() const;

 private:
  std::shared_ptr<SharedWorld> shared_;
  std::size_t index_;
};

}  // namespace seeker::sim
