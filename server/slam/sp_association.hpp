/// \file
/// Which segment of the map each observation is (spec S1.6).
#pragma once

#include "server/slam/sp_state.hpp"

namespace seeker::slam {

/// One segment an observation may be.
struct PairCandidate {
  std::size_t observation = 0;
  std::size_t segment = 0;
  PairGeometry geometry;
  double d2 = 0.0;       ///< of (y, theta), eq (13)
  double sigma_m = 0.0;  ///< of y
  double apart = 0.0;    ///< share of the shorter one that does not overlap, 0..1
  bool beside = false;   ///< surely no overlap: the gap is larger than the robot is uncertain along the segment
  double low_m = 0.0;    ///< interval of the observation on the segment's x axis
  double high_m = 0.0;
};

/// All segments within the near gate that lie where the observation is (the overlap test), nearest first.
[[nodiscard]] std::vector<PairCandidate> candidates_of(const SpState& state, std::size_t index,
                                                       const lines::SegmentObservation& observation);
/// Rows of a pair for the present state.
[[nodiscard]] RowGroup rows_of_pair(const SpState& state, const PairCandidate& pair,
                                    const lines::SegmentObservation& observation, const RowChoice& choice);
/// Squared distance of a group of rows alone.
[[nodiscard]] double group_d2(const SpCovariance& p, const RowGroup& group);

[[nodiscard]] Association associate_jointly(const SpState& state,
                                            const std::vector<lines::SegmentObservation>& observations);
/// The paper's: every observation takes the nearest segment.
[[nodiscard]] Association associate_nearest(const SpState& state,
                                            const std::vector<lines::SegmentObservation>& observations);

}  // namespace seeker::slam
