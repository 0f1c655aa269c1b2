/// \file
/// Iterative closest points as in the merging paper (spec S4.6, eq (5)): point to point, restarted with several
/// headings.
#pragma once

#include <optional>
#include <vector>

#include "server/slam/reference_cloud.hpp"

namespace seeker::fleet {

/// The rigid motion that aligns p_b[k] with p_a[k] by least squares (spec S4.6, eq (5)). Both lists have the same size
/// and are not empty.
[[nodiscard]] Pose2 rigid_fit(const std::vector<Point2>& points_a, const std::vector<Point2>& points_b);

struct IcpParams {
  double first_gate_m = 1.0;  ///< largest distance of pairs in the first iteration
  double last_gate_m = 0.2;   ///< largest distance of pairs in the last iteration
  double gate_shrink = 0.8;   ///< per iteration
  double keep = 0.8;          ///< share of the pairs that are used, the nearest ones
  double stop_m2 = 1e-6;      ///< change of the mean square distance at which the iteration has converged
  int max_iterations = 50;
  std::vector<double> restarts_rad{0.0, 0.2618, -0.2618, 0.5236, -0.5236, 1.0472, -1.0472};
  std::size_t min_pairs = 20;
};

struct IcpResult {
  Pose2 a_T_b;
  double mean_square_m2 = 0.0;  ///< mean square distance of the used pairs
  double pair_share = 0.0;      ///< share of the points with a partner within the last gate
  int iterations = 0;
  bool converged = false;
};

/// Starts at `guess` rotated by each of the restarts, and returns the result with the most partners, of equals the one
/// with the smallest distances. No value when no start finds enough pairs.
[[nodiscard]] std::optional<IcpResult> icp(const slam::ReferenceCloud& reference_a,
                                           const std::vector<slam::OrientedPoint>& points_b, const Pose2& guess,
                                           const IcpParams& params = {});

}  // namespace seeker::fleet
