/// \file
/// Data association of observations with segments of the map (spec S1.6).
#pragma once

#include "server/slam/sp_state.hpp"

namespace seeker::slam {

/// A segment with which an observation may be associated.
struct PairCandidate {
  std::size_t observation = 0;
  std::size_t segment = 0;
  PairGeometry geometry;
  double d2 = 0.0;       ///< squared Mahalanobis distance of (y, theta), eq (13)
  double sigma_m = 0.0;  ///< standard deviation of y
  double apart = 0.0;    ///< share of the shorter one that does not overlap, 0 to 1
  /// Certainly no overlap: the gap is larger than the uncertainty of the robot along the segment.
  bool beside = false;
  double low_m = 0.0;   ///< begin of the observation on the segment's x axis
  double high_m = 0.0;  ///< end of the observation on the segment's x axis
};

/// All segments within the near gate that overlap with the observation, nearest first.
[[nodiscard]] std::vector<PairCandidate> candidates_of(const SpState& state, std::size_t index,
                                                       const lines::SegmentObservation& observation);
/// The measurement rows of a pair for the present state.
[[nodiscard]] RowGroup rows_of_pair(const SpState& state, const PairCandidate& pair,
                                    const lines::SegmentObservation& observation, const RowChoice& choice);
/// The squared Mahalanobis distance of a single group of rows.
[[nodiscard]] double group_d2(const SpCovariance& p, const RowGroup& group);

[[nodiscard]] Association associate_jointly(const SpState& state,
                                            const std::vector<lines::SegmentObservation>& observations);
/// The association of the paper: every observation is paired with the nearest segment.
[[nodiscard]] Association associate_nearest(const SpState& state,
                                            const std::vector<lines::SegmentObservation>& observations);

}  // namespace seeker::slam
