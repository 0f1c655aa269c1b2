#include "server/lab/slam/slam_final_poses.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "common/core/angle.hpp"

namespace seeker::lab {
namespace {

/// A scan whose final pose the map states.
struct Anchor {
  std::size_t scan = 0;
  Pose2 map_T_base;
};

std::vector<Anchor> anchors_of(const std::vector<OnlinePose>& online, const LineMap& map) {
  std::map<std::uint32_t, Pose2> nodes;
  for (const MapNode& node : map.nodes) {
    nodes[node.id] = node.map_T_node;
  }
  std::vector<Anchor> anchors;
  for (const MapKeyframe& keyframe : map.keyframes) {
    const auto at = std::lower_bound(online.begin(), online.end(), keyframe.stamp,
                                     [](const OnlinePose& pose, RobotTime stamp) { return pose.stamp < stamp; });
    const auto node = nodes.find(keyframe.node);
    if (at != online.end() && at->stamp == keyframe.stamp && node != nodes.end()) {
      anchors.push_back({static_cast<std::size_t>(at - online.begin()), node->second * keyframe.node_T_base});
    }
  }
  std::sort(anchors.begin(), anchors.end(), [](const Anchor& a, const Anchor& b) { return a.scan < b.scan; });
  return anchors;
}

Pose2 carried(const std::vector<OnlinePose>& online, const Anchor& anchor, std::size_t scan) {
  return anchor.map_T_base * (inverse(online[anchor.scan].map_T_base) * online[scan].map_T_base);
}

Pose2 blend(const Pose2& a, const Pose2& b, double share) {
  return {a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m),
          wrap_angle(a.theta_rad + share * wrap_angle(b.theta_rad - a.theta_rad))};
}

/// From whichever of the two anchors knows the scan's epoch; from both where both or neither do.
Pose2 between(const std::vector<OnlinePose>& online, const Anchor& before, const Anchor& after, std::size_t scan) {
  const bool same_before = online[before.scan].map_epoch == online[scan].map_epoch;
  const bool same_after = online[after.scan].map_epoch == online[scan].map_epoch;
  if (same_before != same_after) {
    return carried(online, same_before ? before : after, scan);
  }
  const double span_s = to_seconds(online[after.scan].stamp - online[before.scan].stamp);
  const double share = span_s > 0.0 ? to_seconds(online[scan].stamp - online[before.scan].stamp) / span_s : 0.0;
  return blend(carried(online, before, scan), carried(online, after, scan), share);
}

}  // namespace

std::vector<Pose2> final_poses(const std::vector<OnlinePose>& online, const LineMap& map) {
  const std::vector<Anchor> anchors = anchors_of(online, map);
  std::vector<Pose2> poses;
  poses.reserve(online.size());
  std::size_t next = 0;  // the first anchor that is not before the scan
  for (std::size_t scan = 0; scan < online.size(); ++scan) {
    while (next < anchors.size() && anchors[next].scan < scan) {
      ++next;
    }
    if (anchors.empty()) {
      poses.push_back(online[scan].map_T_base);
    } else if (next == anchors.size()) {
      poses.push_back(carried(online, anchors.back(), scan));
    } else if (next == 0 || anchors[next].scan == scan) {
      poses.push_back(carried(online, anchors[next], scan));
    } else {
      poses.push_back(between(online, anchors[next - 1], anchors[next], scan));
    }
  }
  return poses;
}

}  // namespace seeker::lab
