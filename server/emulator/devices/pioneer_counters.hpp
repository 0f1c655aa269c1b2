/// \file
/// The counters of an emulated base: position and heading since the last zero, and the distances of the wheels.
#pragma once

#include <cstdint>

#include "common/core/pose2.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace seeker::emulator {

class PioneerCounters {
 public:
  /// `model` must outlive it.
  explicit PioneerCounters(const p2os::PioneerModel& model) : model_(model) {}

  /// All counters begin at zero here.
  void power_on(const Pose2& world_T_base);
  /// Here is zero from now on; the next packet shows it at once.
  void set_zero(const Pose2& world_T_base);
  /// The base has come here by its encoders.
  void follow(const Pose2& world_T_base);
  /// Writes position and heading into a packet. From packet to packet the position goes less than 0.1 m, which clients
  /// take for damage (protocols 1.6); what is left follows in the next ones.
  void show(p2os::Sip& sip);

  /// Pose since the last zero.
  [[nodiscard]] const Pose2& odom_T_base() const { return odom_T_base_; }
  [[nodiscard]] double left_distance_m() const { return left_distance_m_; }
  [[nodiscard]] double right_distance_m() const { return right_distance_m_; }

 private:
  const p2os::PioneerModel& model_;
  Pose2 world_T_odom_;
  Pose2 odom_T_base_;
  Point2 shown_m_ = Point2::Zero();
  double left_distance_m_ = 0.0;
  double right_distance_m_ = 0.0;
};

}  // namespace seeker::emulator
