/// \file
/// Life of segments: creation, growth, real ends and merging (spec S1.7-S1.9).
#pragma once

#include "server/slam/sp_state.hpp"
#include "server/slam/sp_update.hpp"

namespace seeker::slam {

/// Moves a virtual end to x = `x_m` of the segment's frame; the frame moves to the new mid-point: T(s) of S1.7.
void move_end(SpState& state, std::size_t segment, std::size_t side, double x_m);
/// Updates the ends of a segment by an observation: virtual ends move or become real, and real ends that are overrun
/// become virtual. Requires the preceding update by the pair.
void follow_ends(SpState& state, std::size_t segment, const lines::SegmentObservation& observation);
/// Adds a segment from an observation (S1.8) and returns its id.
SegmentId add_segment(SpState& state, const lines::SegmentObservation& observation);
/// Adds the new observations that are confirmed; keeps the others for the next scan.
void add_new_segments(SpState& state, const std::vector<lines::SegmentObservation>& observations,
                      const Association& association, SpUpdateReport& report);
/// Merges other segments with any of these where both are one wall (S1.9).
void merge_segments(SpState& state, const std::vector<SegmentId>& touched, SpUpdateReport& report);

}  // namespace seeker::slam
