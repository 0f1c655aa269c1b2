/// \file
/// Segments come, grow, get ends and become one (spec S1.7-S1.9).
#pragma once

#include "server/slam/sp_state.hpp"
#include "server/slam/sp_update.hpp"

namespace seeker::slam {

/// Moves a virtual end to x = `x_m` of the segment's frame; the frame follows to the mid-point: T(s) of S1.7.
void move_end(SpState& state, std::size_t segment, std::size_t side, double x_m);
/// What an observation tells of the ends of its segment: virtual ends move, become real, real ones that are overrun
/// become virtual. After the update by the pair.
void follow_ends(SpState& state, std::size_t segment, const lines::SegmentObservation& observation);
/// A segment from an observation (S1.8); its id.
SegmentId add_segment(SpState& state, const lines::SegmentObservation& observation);
/// Adds those of the new observations that are believed by now; remembers the others for the next scan.
void add_new_segments(SpState& state, const std::vector<lines::SegmentObservation>& observations,
                      const Association& association, SpUpdateReport& report);
/// Joins what is one with any of these segments (S1.9).
void merge_segments(SpState& state, const std::vector<SegmentId>& touched, SpUpdateReport& report);

}  // namespace seeker::slam
