/// \file
/// Motion of the base: limits of acceleration and speed, and the response to a contact.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/rng.hpp"
#include "server/sim/robot_model.hpp"
#include "server/sim/scene.hpp"

namespace seeker::sim {

/// Heights at which the body can touch an obstacle: all but the lowest part above the floor.
[[nodiscard]] HeightBand body_band(const RobotModel& model);

/// Velocity after `dt_s` on the transition from `present` to `wanted`, within the limits of the model.
[[nodiscard]] Twist2 accelerate(const Twist2& present, const Twist2& wanted, const RobotModel& model, double dt_s);

/// The disc-shaped body. A contact ends translation at once; rotation on the spot stays possible.
class BodyMotion {
 public:
  explicit BodyMotion(const Pose2& world_T_base) : world_T_base_(world_T_base) {}

  /// Computes one step of at most 10 ms (spec S1.3, exact on the arc). Returns the motion that was carried out.
  Twist2 step(const Twist2& wanted, const RobotModel& model, const Scene& scene, double dt_s);

  [[nodiscard]] const Pose2& world_T_base() const { return world_T_base_; }
  [[nodiscard]] const Twist2& velocity() const { return velocity_; }
  [[nodiscard]] bool touching() const { return touching_; }
  [[nodiscard]] bool blocked() const { return blocked_; }
  [[nodiscard]] int contacts() const { return contacts_; }
  [[nodiscard]] double path_length_m() const { return path_length_m_; }
  [[nodiscard]] double min_clearance_m() const { return min_clearance_m_; }

 private:
  Pose2 world_T_base_;
  Twist2 velocity_;
  bool touching_ = false;
  bool blocked_ = false;
  int contacts_ = 0;
  double path_length_m_ = 0.0;
  double min_clearance_m_ = kClearanceLimit_m;
  static constexpr double kClearanceLimit_m = 1.0;  ///< clearances are measured up to this distance
};

/// Wheel encoders: dead reckoning with the errors of OdometryModel.
class Encoders {
 public:
  /// Adds one step of true motion (`twist` over dt_s).
  void step(const Twist2& twist, double dt_s, const RobotModel& model, Rng& rng);
  [[nodiscard]] const Pose2& odom_T_base() const { return odom_T_base_; }
  [[nodiscard]] const Twist2& velocity() const { return velocity_; }

 private:
  Pose2 odom_T_base_;
  Twist2 velocity_;
};

/// The motion of a person along a PersonPath.
class Walker {
 public:
  Walker(const PersonPath& path, std::uint64_t serial);
  /// Walks on unless a robot is within the waiting distance ahead of the next step.
  void step(std::span<const Disc> robots, double dt_s);
  [[nodiscard]] Disc disc() const { return {position_, path_.radius_m, path_.height_m, paint_}; }

 private:
  PersonPath path_;
  Paint paint_;
  Point2 position_;
  std::size_t next_ = 1;
  bool forward_ = true;
};

}  // namespace seeker::sim
