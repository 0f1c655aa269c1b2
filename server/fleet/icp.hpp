/// \file
/// Iterative closest points as the merging paper has it (spec S4.6, eq (5)): point to point, restarted over the
/// heading.
#pragma once

#include <optional>
#include <vector>

#include "server/slam/reference_cloud.hpp"

namespace seeker::fleet {

/// The rigid motion that brings p_b[k] nearest to p_a[k] in the least squares sense (spec S4.6, eq (5)). Both lists are
/// of one size and not empty.
[[nodiscard]] Pose2 rigid_fit(const std::vector<Point2>& points_a, const std::vector<Point2>& points_b);

struct IcpParams {
  double first_gate_m = 1.0;  ///< pairs may be so far apart at first,
  double last_gate_m = 0.2;   ///< and so far at the end
  double gate_shrink = 0.8;   ///< per iteration
  double keep = 0.8;          ///< share of the pairs, the nearest ones
  double stop_m2 = 1e-6;      ///< change of the mean square distance
  int max_iterations = 50;
  std::vector<double> restarts_rad{0.0, 0.2618, -0.2618, 0.5236, -0.5236, 1.0472, -1.0472};
  std::size_t min_pairs = 20;
};

struct IcpResult {
  Pose2 a_T_b;
  double mean_square_m2 = 0.0;  ///< of the pairs kept
  double pair_share = 0.0;      ///< points with a partner within the last gate
  int iterations = 0;
  bool converged = false;
};

/// From `guess` turned by each of the restarts; the result with the most partners, of equals the one nearest to them.
/// Nothing when no start finds enough pairs.
[[nodiscard]] std::optional<IcpResult> icp(const slam::ReferenceCloud& reference_a,
                                           const std::vector<slam::OrientedPoint>& points_b, const Pose2& guess,
                                           const IcpParams& params = {});

}  // namespace seeker::fleet
