/// \file
/// Compares a trajectory with a reference trajectory: absolute trajectory error (Sturm et al., "A benchmark for the
/// evaluation of RGB-D SLAM systems", IROS 2012) after the best rigid motion.
#pragma once

#include <cstdint>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/lab/scoring/score_relations.hpp"
#include "server/lab/scoring/trajectory.hpp"

namespace seeker::lab {

struct ReferenceReport {
  std::uint64_t used = 0;    ///< number of poses within the reference
  std::uint64_t missed = 0;  ///< number of poses outside it, or in a gap of it
  double translation_rms_m = 0.0;
  double rotation_rms_deg = 0.0;
  ErrorFigures translation_m;
  ErrorFigures rotation_deg;
  Pose2 reference_T_map;  ///< the rigid motion that was applied
};

/// Scores every pose of the trajectory whose time is at most `max_gap_s` from an entry of the reference, which is
/// interpolated. kInvalidArgument when fewer than two poses have a reference.
[[nodiscard]] Result<ReferenceReport> score_reference(const Trajectory& trajectory, const Trajectory& reference,
                                                      double max_gap_s);

/// map_T_base from a localiser's map_T_odom and the odometry, at the stamps of the odometry that it covers; the
/// correction is interpolated between its entries.
[[nodiscard]] Trajectory apply_corrections(const Trajectory& map_T_odom, const Trajectory& odometry, double max_gap_s);

}  // namespace seeker::lab
