/// \file
/// A robot's own map as it leaves the loop for the fleet.
#pragma once

#include <functional>
#include <optional>

#include "common/api/robot_api.hpp"
#include "common/core/line_map.hpp"

namespace seeker::app {

/// A robot's map, and where it is in it; no place where it does not know.
struct OwnMap {
  LineMap map;
  std::optional<Pose2> map_T_base;
};
/// Asks the loop for it, from any thread; answers on the loop's thread, or at once where the loop has ended.
using OwnMapSource = std::function<void(const api::Reply<OwnMap>&)>;

}  // namespace seeker::app
