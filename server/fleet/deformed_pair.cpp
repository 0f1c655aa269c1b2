#include "server/fleet/deformed_pair.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/slam/covariance.hpp"

namespace seeker::fleet {
namespace {

constexpr double kInForce = 0.25;  // of its weight left

/// The squared residuals; what the others contradict counts up to the width of its kernel.
double chi2_of(const slam::PoseGraph& graph) {
  double chi2 = 0.0;
  for (std::size_t k = 0; k < graph.edge_count(); ++k) {
    const slam::PoseEdge& edge = graph.edge(k);
    const double limit = edge.kernel_width * edge.kernel_width;
    const double own = graph.enabled(k) ? graph.edge_chi2(k) : 0.0;
    chi2 += edge.kernel == slam::EdgeKernel::kNone ? own : std::min(own, limit);
  }
  return chi2;
}

}  // namespace

Result<DeformedPair> DeformedPair::make(const LineMap& a, const LineMap& b, const std::vector<NodeRelation>& pairs,
                                        const Pose2& a_T_b, const DeformationParams& params) {
  DeformedPair made;
  made.params_ = params;
  const double variance = variance_factor({&a, &b});
  Result<GraphNodes> nodes_a = add_map(made.graph_, a, {}, variance, params.kernel_width);
  if (!nodes_a) {
    return tl::unexpected<Error>(nodes_a.error());
  }
  Result<GraphNodes> nodes_b = add_map(made.graph_, b, a_T_b, variance, params.kernel_width);
  if (!nodes_b) {
    return tl::unexpected<Error>(nodes_b.error());
  }
  made.nodes_a_ = *std::move(nodes_a);
  made.nodes_b_ = *std::move(nodes_b);
  const double before = chi2_of(made.graph_);
  for (const NodeRelation& pair : pairs) {
    const auto added = made.graph_.add_edge({.i = made.nodes_a_.at(pair.node_a),
                                             .j = made.nodes_b_.at(pair.node_b),
                                             .i_T_j = pair.a_T_b.a_T_b,
                                             .information = slam::information_of(pair.a_T_b.covariance),
                                             .kernel = slam::EdgeKernel::kSwitchable,
                                             .kernel_width = params.kernel_width});
    if (!added) {
      return tl::unexpected<Error>(added.error());
    }
    made.pair_edges_.push_back(*added);
  }
  if (const auto report = made.graph_.optimise(params.max_iterations); !report) {
    return tl::unexpected<Error>(report.error());
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    made.deformation_.switched_off += made.in_force(k) ? 0 : 1;
  }
  made.deformation_.chi2 = std::max(0.0, chi2_of(made.graph_) - before);
  made.deformation_.dof = 3 * (pairs.empty() ? 0 : pairs.size() - 1);
  made.measure(a, made.nodes_a_);
  made.measure(b, made.nodes_b_);
  return made;
}

bool DeformedPair::in_force(std::size_t pair) const { return graph_.edge_weight(pair_edges_.at(pair)) >= kInForce; }

bool DeformedPair::certain(std::uint32_t id_a, std::uint32_t id_b) {
  const Result<Matrix3> covariance = graph_.relative_covariance(nodes_a_.at(id_a), nodes_b_.at(id_b));
  return covariance && covariance->topLeftCorner<2, 2>().trace() <= params_.max_sigma_m * params_.max_sigma_m &&
         (*covariance)(2, 2) <= params_.max_sigma_rad * params_.max_sigma_rad;
}

void DeformedPair::measure(const LineMap& map, const GraphNodes& nodes) {
  for (const MapEdge& edge : map.edges) {
    if (edge.loop) {
      continue;
    }
    const Pose2 now = inverse(graph_.pose(nodes.at(edge.from))) * graph_.pose(nodes.at(edge.to));
    const auto pose_of = [&map](std::uint32_t id) {
      return std::find_if(map.nodes.begin(), map.nodes.end(), [id](const MapNode& node) { return node.id == id; })
          ->map_T_node;
    };
    const Pose2 before = inverse(pose_of(edge.from)) * pose_of(edge.to);
    deformation_.largest_m = std::max(deformation_.largest_m, distance_m(now, before));
    deformation_.largest_rad =
        std::max(deformation_.largest_rad, std::abs(wrap_angle(now.theta_rad - before.theta_rad)));
  }
}

}  // namespace seeker::fleet
