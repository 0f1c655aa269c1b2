/// \file
/// The relations within a robot's map as a pose graph, with covariances that its own loop closures have checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/slam/pose_graph.hpp"

namespace seeker::fleet {

/// Number in the graph of a local map, by its id.
using GraphNodes = std::map<std::uint32_t, std::size_t>;

/// Variance of unit weight of maps (least squares adjustment): the squared residuals of their relations over their
/// covariances, per redundant measurement. 1: the covariances are right; 4: errors are twice as large as they say. Maps
/// without loop closures have no redundancy and keep 1; few loops count little. At least 1.
[[nodiscard]] double variance_factor(const std::vector<const LineMap*>& maps);

/// Adds the local maps and the enabled relations of a map whose frame stands at `graph_T_map`; the covariances are
/// multiplied by `variance`. Loop closures are switchable. Errors are those of PoseGraph::add_edge().
[[nodiscard]] Result<GraphNodes> add_map(slam::PoseGraph& graph, const LineMap& map, const Pose2& graph_T_map,
                                         double variance, double kernel_width);

/// The pose of a deformed map as a whole: the rigid motion that fits best where its robot has been, at its local maps
/// and its keyframes. `frame_T_node` gives where a local map, by its id, lies in the frame asked for. The map has a
/// local map at least.
[[nodiscard]] Pose2 rigid_pose(const LineMap& map, const std::function<Pose2(std::uint32_t)>& frame_T_node);

}  // namespace seeker::fleet
