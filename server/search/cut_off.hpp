/// \file
/// Floor that the robot could reach at some time and cannot reach now, because a person blocks the path or a door was
/// shut.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"
#include "server/nav/floor_view.hpp"
#include "server/nav/known_floor.hpp"
#include "server/nav/wait_schedule.hpp"
#include "server/search/evidence.hpp"

namespace seeker::search {

/// The floor that a search accounts for, in the cells of view.reachable: the floor that can be reached now, and free
/// floor that no path leads to any longer.
[[nodiscard]] Grid<std::uint8_t> floor_to_search(const nav::FloorView& view, const nav::KnownFloor& known);

/// Smallest sizes of cut-off floor that justify a wait.
struct WorthAWait {
  double unsearched_m2 = 1.0;  ///< area of cut-off floor below the evidence's threshold
  double border_m = 0.4;       ///< or length of its border with unknown space
};

/// The places where paths are blocked: the middle of the shortest path that once led to the cut-off floor. There is one
/// place for each connected piece of such floor in which some of it is still unsearched.
[[nodiscard]] std::vector<nav::BlockedPlace> blocked_places(const nav::FloorView& view, const nav::KnownFloor& known,
                                                            const EvidenceGrid& evidence, const WorthAWait& worth);

}  // namespace seeker::search
