/// \file
/// Readings of range sensors as values. "No return" is +infinity, never zero and never NaN: a driver translates its
/// device's codes, so that algorithms test std::isfinite() only.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker {

inline constexpr float kNoReturn = std::numeric_limits<float>::infinity();
/// Largest number of beams accepted from any device, file or peer.
inline constexpr std::size_t kMaxScanBeams = 8192;

/// Longest time that a scanner may take for one sweep.
inline constexpr std::chrono::seconds kMaxSweep{10};

/// One sweep of a planar laser scanner. Beam i points to `angle_min_rad + i * angle_step_rad` in the frame `laser`;
/// a negative step is that of a scanner which rotates clockwise.
struct LaserScan {
  RobotTime stamp;   ///< the middle of the sweep; where `sweep` is zero, the moment of all beams
  Duration sweep{};  ///< time from the first beam to the last one, negative where the last one was measured first
  double angle_min_rad = 0.0;
  double angle_step_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  Pose2 base_T_laser;
  std::vector<float> ranges_m;        ///< one value per beam; kNoReturn where no echo came back
  std::vector<std::uint8_t> quality;  ///< empty, or one value per beam; higher is better, 0 is unusable

  [[nodiscard]] double angle_rad(std::size_t beam) const {
    return angle_min_rad + static_cast<double>(beam) * angle_step_rad;
  }
  /// When the beam was measured; beams follow each other evenly.
  [[nodiscard]] RobotTime time_of(std::size_t beam) const;
  friend bool operator==(const LaserScan&, const LaserScan&) = default;
};

/// Refuses scans that estimators must not receive: with NaN, negative ranges, no angle step, a sweep longer than
/// kMaxSweep, or more beams than kMaxScanBeams.
[[nodiscard]] Status validate(const LaserScan& scan);

/// Positions of all valid returns in the frame `base`.
[[nodiscard]] std::vector<Point2> points_in_base(const LaserScan& scan);

/// One ultrasonic transducer: its pose on the base and the range it measured.
struct SonarReading {
  Pose2 base_T_sonar;  ///< x axis of the sonar = axis of its cone
  float range_m = kNoReturn;

  friend bool operator==(const SonarReading&, const SonarReading&) = default;
};

/// The newest reading of every transducer of a ring, in the ring's order.
struct SonarScan {
  RobotTime stamp;
  double range_max_m = 0.0;
  double cone_half_angle_rad = 0.0;
  std::vector<SonarReading> readings;

  friend bool operator==(const SonarScan&, const SonarScan&) = default;
};

[[nodiscard]] Status validate(const SonarScan& scan);

/// The range at which a beam of direction `bearing_rad` meets the straight line through two returns; not finite or
/// negative where it does not. All from the origin of the beam.
[[nodiscard]] double range_on_line_m(const Point2& a, const Point2& b, double bearing_rad);

}  // namespace seeker
