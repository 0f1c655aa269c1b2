/// \file
/// Properties of the models of Pioneer bases, chosen by the subclass that a base names (protocols 1.8).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"

namespace seeker::p2os {

/// Metres in a millimetre, the unit of the protocol's lengths.
inline constexpr double kMetre = 1e-3;
/// Radians in the unit of the protocol's headings.
inline constexpr double kAngleUnit_rad = kTwoPi / 4096.0;

/// Numbers of AriaCoda b0d02e05, params/NAME.p and src/ArRobotTypes.cpp.
struct PioneerModel {
  std::string_view subclass;
  double distance_unit_m = 0.0;       ///< of the counters of the position
  double velocity_unit_m_s = kMetre;  ///< of velocities
  double range_unit_m = kMetre;       ///< of sonar ranges
  double rotation_rad_per_m = 0.0;    ///< rotation by half the difference of the wheels' distances
  double vel2_divisor_mm_s = 20.0;    ///< unit of VEL2
  double gyro_scaler = 1.626;         ///< see gyro_rad_s_per_count()
  double v_max_m_s = 0.0;             ///< no base of this model is faster
  double omega_max_rad_s = 0.0;       ///< none turns faster
  double radius_m = 0.0;              ///< of the circle around the body
  std::vector<Pose2> base_T_sonar;    ///< by number: 0 to 7 in front, from 8 on at the rear where fitted
};

/// The model of a subclass: p3dx, p3dx-sh, p3at, p3at-sh, and equipped ones of the newer boards ("p3dx-sh-lms1xx").
/// Nothing: the subclass is not known, so that its units are not known either.
[[nodiscard]] const PioneerModel* find_pioneer_model(std::string_view subclass);
/// The known subclasses for a message: "p3dx, p3dx-sh, ...".
[[nodiscard]] std::string known_subclasses();

/// Number of transducers of one array.
inline constexpr std::size_t kArraySonars = 8;

}  // namespace seeker::p2os
