/// \file
/// Systematic errors of the odometry of a differential-drive base: wheels of other diameters than it reckons with, and
/// another distance between them (Borenstein and Feng, "Measurement and correction of systematic odometry errors in
/// mobile robots", IEEE Transactions on Robotics and Automation 12(6), 1996).
#pragma once

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"

namespace seeker {

/// Factors from what the base reports to what it does. The default corrects nothing.
struct WheelCalibration {
  double track_m = 0.357;    ///< distance between the wheels by which the base computes its rotation (Pioneer 3-DX)
  double left_scale = 1.0;   ///< true over reported distance of the left wheel
  double right_scale = 1.0;  ///< true over reported distance of the right wheel
  double track_scale = 1.0;  ///< true distance between the wheels over track_m

  friend bool operator==(const WheelCalibration&, const WheelCalibration&) = default;
};

/// True where the factors leave the odometry as it is, with any track.
[[nodiscard]] bool is_identity(const WheelCalibration& calibration);

/// Refuses factors and tracks that no base has: not finite, or factors outside 0.5 to 2.
[[nodiscard]] Status validate(const WheelCalibration& calibration);

/// The velocity that a base with these errors has when it reports `twist`.
[[nodiscard]] Twist2 corrected(const Twist2& twist, const WheelCalibration& calibration);

/// The velocity that a base with these errors must be given as a command, and reports, to move at `twist`: the inverse
/// of the above.
[[nodiscard]] Twist2 reported(const Twist2& twist, const WheelCalibration& calibration);

/// The motion that a base with these errors has made when it reports `increment` (the new pose seen from the old one):
/// exact for motions along one arc. What deviates from the arc is kept, at right angles to its chord.
[[nodiscard]] Pose2 corrected(const Pose2& increment, const WheelCalibration& calibration);

}  // namespace seeker
