/// \file
/// Floor that the robot could reach at some time and cannot now: somebody stands in the way, or a door was shut.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"
#include "server/nav/floor_view.hpp"
#include "server/nav/known_floor.hpp"
#include "server/nav/wait_turns.hpp"
#include "server/search/evidence.hpp"

namespace seeker::search {

/// What a search answers for, in the cells of view.reachable: the floor that can be reached now, and free floor that no
/// way leads to any longer.
[[nodiscard]] Grid<std::uint8_t> floor_to_search(const nav::FloorView& view, const nav::KnownFloor& known);

/// Less than this is not waited for.
struct WorthAWait {
  double unsearched_m2 = 1.0;  ///< of cut off floor below the evidence's threshold,
  double border_m = 0.4;       ///< or of its border with the unknown
};

/// Where whoever cuts floor off stands: in the middle of the shortest way that once led there. One place for each
/// connected piece of such floor in which something is left to search.
[[nodiscard]] std::vector<nav::BlockedPlace> blocked_places(const nav::FloorView& view, const nav::KnownFloor& known,
                                                            const EvidenceGrid& evidence, const WorthAWait& worth);

}  // namespace seeker::search
