/// \file
/// Comparison of the maps of all robots: pair by pair, and around every cycle of three.
#pragma once

#include <cstdint>
#include <vector>

#include "server/fleet/joint_map.hpp"
#include "server/fleet/map_merger.hpp"

namespace seeker::fleet {

/// The answer for two robots of the fleet.
struct PairAnswer {
  std::uint8_t slot_a = 0;
  std::uint8_t slot_b = 0;
  MergeAnswer answer;
};

/// Limits of the gap of a closed cycle of three robots.
struct CycleParams {
  double max_gap_m = 0.6;
  double max_gap_rad = 0.06;
};

/// Three merged pairs that do not close cannot all be true: of each such three the least certain is demoted to
/// kContradicted, until all remaining ones close. The gap is measured at the shared places of that pair.
void demote_open_cycles(std::vector<PairAnswer>& pairs, const CycleParams& params = {});

/// The relations of the merged pairs, for join().
[[nodiscard]] std::vector<MapRelation> relations_of(const std::vector<PairAnswer>& pairs);

}  // namespace seeker::fleet
