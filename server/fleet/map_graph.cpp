#include "server/fleet/map_graph.hpp"

#include <algorithm>
#include <utility>

#include "server/fleet/icp.hpp"
#include "server/slam/covariance.hpp"

namespace seeker::fleet {
namespace {

constexpr double kLeastSigma_m = 1e-3;  // an edge without any error would leave nothing to divide by
constexpr double kLeastSigma_rad = 1e-4;

}  // namespace

Result<GraphNodes> add_map(slam::PoseGraph& graph, const LineMap& map, const Pose2& graph_T_map, double variance,
                           double kernel_width) {
  GraphNodes numbers;
  for (const MapNode& node : map.nodes) {
    numbers[node.id] = graph.add_node(graph_T_map * node.map_T_node);
  }
  for (const MapEdge& edge : map.edges) {
    const Matrix3 covariance = slam::with_floor(edge.covariance, kLeastSigma_m, kLeastSigma_rad);
    const auto added = graph.add_edge({.i = numbers.at(edge.from),
                                       .j = numbers.at(edge.to),
                                       .i_T_j = edge.from_T_to,
                                       .information = slam::information_of(variance * covariance),
                                       .kernel = edge.loop ? slam::EdgeKernel::kSwitchable : slam::EdgeKernel::kNone,
                                       .kernel_width = kernel_width});
    if (!added) {
      return tl::unexpected<Error>(added.error());
    }
    graph.set_enabled(*added, edge.enabled);
  }
  return numbers;
}

double variance_factor(const std::vector<const LineMap*>& maps) {
  constexpr double kKernelWidth = 3.0;
  constexpr double kPriorRedundancy = 12.0;  // as many measurements as four loops say that the covariances are right
  double chi2 = kPriorRedundancy;
  double redundancy = kPriorRedundancy;
  for (const LineMap* map : maps) {
    slam::PoseGraph graph;
    if (!add_map(graph, *map, {}, 1.0, kKernelWidth)) {
      continue;
    }
    for (std::size_t k = 0; k < graph.edge_count(); ++k) {
      const bool loop = graph.edge(k).kernel == slam::EdgeKernel::kSwitchable;
      chi2 += graph.edge_weight(k) * graph.edge_chi2(k);
      redundancy += loop && graph.enabled(k) ? 3.0 : 0.0;
    }
  }
  return std::max(1.0, chi2 / redundancy);
}

Pose2 rigid_pose(const LineMap& map, const std::function<Pose2(std::uint32_t)>& frame_T_node) {
  std::map<std::uint32_t, Pose2> map_T_node;
  std::vector<std::pair<std::uint32_t, Pose2>> places;  // by their local maps
  for (const MapNode& node : map.nodes) {
    map_T_node[node.id] = node.map_T_node;
    places.emplace_back(node.id, Pose2{});
  }
  for (const MapKeyframe& keyframe : map.keyframes) {
    places.emplace_back(keyframe.node, keyframe.node_T_base);
  }
  std::vector<Point2> frame;
  std::vector<Point2> own;
  for (const auto& [node, node_T_base] : places) {
    for (const Point2& arm : {Point2(0.0, 0.0), Point2(1.0, 0.0)}) {  // the second for the heading
      frame.push_back(frame_T_node(node) * node_T_base * arm);
      own.push_back(map_T_node.at(node) * node_T_base * arm);
    }
  }
  return rigid_fit(frame, own);
}

}  // namespace seeker::fleet
