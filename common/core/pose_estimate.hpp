/// \file
/// The estimated pose of the robot with its uncertainty.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker {

/// Quality of the localisation of a robot.
enum class LocalisationQuality : std::uint8_t { kUnknown, kLocalised, kDegraded, kLost };

[[nodiscard]] std::string_view to_string(LocalisationQuality quality);

/// Whether a pose of this quality is the robot's pose in the frame `map`. A pose of another quality may be in any
/// frame, such as that of a part which is mapped during relocalisation.
[[nodiscard]] constexpr bool is_placed(LocalisationQuality quality) {
  return quality == LocalisationQuality::kLocalised || quality == LocalisationQuality::kDegraded;
}

/// Result of an estimator. `covariance` is that of (x, y, theta) in m and rad, expressed in the frame `map`.
struct PoseEstimate {
  RobotTime stamp;
  Pose2 map_T_base;
  Matrix3 covariance = Matrix3::Zero();
  LocalisationQuality quality = LocalisationQuality::kUnknown;
  std::string cause;            ///< why it is not kLocalised; empty otherwise
  std::uint32_t map_epoch = 0;  ///< rises when a loop closure or a merge moves the map

  friend bool operator==(const PoseEstimate&, const PoseEstimate&) = default;
};

}  // namespace seeker
