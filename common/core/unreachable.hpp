/// \file
/// Places that a robot could not reach, each with why and what would help.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/pose2.hpp"

namespace seeker {

enum class UnreachableCause : std::uint8_t {
  kNotStated,       ///< by a robot whose software is older than causes
  kObstacle,        ///< the place lies in an obstacle, or nearer to one than the robot's body is wide
  kOutsideBound,    ///< the place lies outside the bound of the mission
  kKeptOut,         ///< the place lies in a kept-out area, or too near to one
  kUnknownFloor,    ///< nobody has seen the floor there
  kCutOff,          ///< obstacles or unknown floor lie between the robot and the place
  kCutOffByAreas,   ///< a path leads there, but through kept-out areas or outside the bound
  kRobotEnclosed,   ///< the robot itself stands too near to obstacles to set out
  kRobotForbidden,  ///< the robot itself stands outside the bound or in a kept-out area
  kBlocked,         ///< paths lead there, and each was found blocked
};
/// All of them, in order.
inline constexpr std::array kUnreachableCauses{UnreachableCause::kNotStated,      UnreachableCause::kObstacle,
                                               UnreachableCause::kOutsideBound,   UnreachableCause::kKeptOut,
                                               UnreachableCause::kUnknownFloor,   UnreachableCause::kCutOff,
                                               UnreachableCause::kCutOffByAreas,  UnreachableCause::kRobotEnclosed,
                                               UnreachableCause::kRobotForbidden, UnreachableCause::kBlocked};

/// Stable name, as printed in JSON: "obstacle", "outside-bound", ...
[[nodiscard]] std::string_view to_string(UnreachableCause cause);
/// The cause for people: completes "(3.0, 4.5) m cannot be reached: ...".
[[nodiscard]] std::string_view explain(UnreachableCause cause);
/// What helps against it, without a full stop; empty for kNotStated.
[[nodiscard]] std::string_view remedy_of(UnreachableCause cause);

struct UnreachablePlace {
  Point2 p_map = Point2::Zero();
  UnreachableCause cause = UnreachableCause::kNotStated;
  /// Width of what is left there: of the border of unknown floor, of the floor that is cut off. 0: not measured, as of
  /// places that were asked for.
  double size_m = 0.0;
  std::string text;  ///< the cause as this robot met it, one clause; empty: explain() says all

  friend bool operator==(const UnreachablePlace&, const UnreachablePlace&) = default;
};

/// Where they lie.
[[nodiscard]] std::vector<Point2> positions_of(const std::vector<UnreachablePlace>& places);
/// "(3.0, 4.5) m, 0.8 m wide: it lies outside the bound of the mission".
[[nodiscard]] std::string describe(const UnreachablePlace& place);
/// Each with its cause, up to a readable number.
[[nodiscard]] std::string describe(const std::vector<UnreachablePlace>& places);
/// What helps, every cause's remedy once, in the order of the places.
[[nodiscard]] std::string remedies_of(const std::vector<UnreachablePlace>& places);

}  // namespace seeker
