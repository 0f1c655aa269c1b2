/// \file
/// Dead reckoning from the counters of a base (protocols 1.6).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/core/pose2.hpp"
#include "common/core/time.hpp"
#include "server/drivers/p2os/gyro_heading.hpp"
#include "server/drivers/p2os/p2os_params.hpp"
#include "server/protocols/p2os/gyro_packet.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace seeker::drivers {

/// Adds up the steps between the counters of successive information packets. The pose goes on over connections: the
/// first packet of each is its zero. A step that no base can have made in the time is dropped: if the next packet fits
/// the one before it, that packet was damaged, and nothing is lost; if it fits the dropped one, the base's counters
/// were set again.
class BaseOdometry {
 public:
  /// `params` must outlive it.
  explicit BaseOdometry(const P2osParams& params) : params_(params) {}

  /// A connection to a base of this model begins; it sends every `sip_cycle`.
  void connect(const p2os::PioneerModel& model, Duration sip_cycle);
  void add(std::span<const p2os::GyroReading> readings);
  /// `stamp`: when the base composed the packet. False: the step was dropped.
  bool add(const p2os::Sip& sip, RobotTime stamp);

  /// The base has made this motion, in its own frame, without a report.
  void go_unseen(const Pose2& motion) { odom_T_base_ = odom_T_base_ * motion; }

  [[nodiscard]] const Pose2& odom_T_base() const { return odom_T_base_; }
  [[nodiscard]] const Twist2& velocity() const { return velocity_; }
  /// Steps that were dropped since the first connection.
  [[nodiscard]] std::uint64_t dropped_steps() const { return dropped_steps_; }

 private:
  struct Counters {
    int x = 0;
    int y = 0;
    int theta = 0;
    RobotTime stamp;
  };

  /// Motion in the frame of the earlier pose.
  [[nodiscard]] Pose2 step_between(const Counters& from, const Counters& to) const;
  [[nodiscard]] bool possible(const Pose2& step, Duration passed) const;
  void go(const Pose2& step, Duration passed);
  /// What the gyroscope adds to the rotation that the wheels showed in the last step.
  [[nodiscard]] double gyro_correction_rad();
  void measure_velocity(const p2os::Sip& sip, const Pose2& step);

  const P2osParams& params_;
  const p2os::PioneerModel* model_ = nullptr;
  Duration sip_cycle_{0};
  std::optional<GyroHeading> gyro_;
  std::optional<Counters> last_;
  std::optional<Counters> doubtful_;  ///< of a dropped step
  Pose2 odom_T_base_;
  Twist2 velocity_;
  double last_rotation_rad_ = 0.0;  ///< by the wheels, in the last step
  Duration last_passed_{0};
  int packets_at_rest_ = 0;
  std::uint64_t dropped_steps_ = 0;
};

}  // namespace seeker::drivers
