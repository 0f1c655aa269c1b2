/// \file
/// A robot's map made ready for being compared with those of others; what did not change when it grows is kept.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/fleet/scan_signature.hpp"
#include "server/slam/pairwise_consistency.hpp"
#include "server/slam/place_recogniser.hpp"
#include "server/slam/pose_graph.hpp"
#include "server/vision/place_index.hpp"

namespace seeker::fleet {

struct PreparedMapParams {
  /// Coarse: the match that follows is exact.
  slam::PlaceMapParams place{.pyramid = {.resolution_m = 0.08, .reach_m = 0.24}, .free_space = {}};
  SignatureParams signature;
  double view_range_m = 12.0;         ///< points farther from their scanner are not compared
  double region_m = 8.0;              ///< every node lies within this of the middle of a region
  double region_view_m = 13.0;        ///< whose scans are those made within this of it
  std::size_t node_keyframes = 16;    ///< of a node, evenly chosen, that are looked for in other maps
  std::size_t region_keyframes = 80;  ///< of a region, evenly chosen
  std::size_t cached_regions = 24;    ///< that are kept ready
  double moved_m = 0.03;              ///< a region whose scans moved by less to each other is not made anew
  double moved_rad = 0.01;
};

/// A local map as others look for it. Points in its own frame.
struct PreparedNode {
  std::uint32_t id = 0;
  Pose2 map_T_node;
  std::size_t keyframes = 0;  ///< that it was made from
  Point2 middle = Point2::Zero();
  std::vector<slam::SeenPoints> seen;
  std::vector<ScanSignature> signatures;
  std::size_t region = 0;  ///< the one that it lies in
};

/// A part of the map that others' nodes are looked for in, in the frame of one of its nodes.
struct PreparedRegion {
  std::size_t node = 0;                         ///< index of that node
  std::vector<std::size_t> members;             ///< indices of nodes with scans in it
  std::shared_ptr<const slam::PlaceMap> place;  ///< absent until asked for, or where nothing was seen
};

/// Not for several threads at a time: regions are made ready when they are first asked for.
class PreparedMap {
 public:
  explicit PreparedMap(const PreparedMapParams& params = {});

  /// Takes the map as it is now. Nodes without scans are left out. Errors as validate(LineMap).
  [[nodiscard]] Status update(LineMap map);
  /// What the camera saw at a node: it proposes pairs then. Ids that the map has not are ignored.
  void set_features(std::uint32_t node, vision::FeatureList features);

  [[nodiscard]] const LineMap& map() const { return map_; }
  [[nodiscard]] const std::vector<PreparedNode>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<PreparedRegion>& regions() const { return regions_; }
  [[nodiscard]] const std::map<std::uint32_t, vision::FeatureList>& features() const { return features_; }
  /// Null where nothing was seen.
  [[nodiscard]] std::shared_ptr<const slam::PlaceMap> place(std::size_t region);
  /// The region that shows the surroundings of a point of the frame `map`; nothing where no node is near.
  [[nodiscard]] std::optional<std::size_t> region_at(const Point2& p_map) const;
  /// Regions with places like those of the node, most alike first.
  [[nodiscard]] std::vector<std::size_t> regions_like(const PreparedNode& other, std::size_t at_most) const;
  /// The pose of a node in the frame of another of this map, by indices, with what the map believes it is off.
  [[nodiscard]] UncertainPose between(std::size_t from, std::size_t to);

 private:
  void prepare_nodes();
  void prepare_regions();
  void prepare_graph();
  [[nodiscard]] std::shared_ptr<const slam::PlaceMap> build(const PreparedRegion& region) const;
  /// Poses of the region's scans in its own frame and how many: what its place was made from.
  struct Made {
    std::uint32_t node = 0;
    std::map<std::uint32_t, std::pair<Pose2, std::size_t>> members;
    std::shared_ptr<const slam::PlaceMap> place;
  };
  [[nodiscard]] Made recipe_of(const PreparedRegion& region) const;
  [[nodiscard]] bool same(const Made& a, const Made& b) const;

  PreparedMapParams params_;
  LineMap map_;
  std::vector<PreparedNode> nodes_;
  std::vector<PreparedRegion> regions_;
  std::map<std::pair<long, long>, std::size_t> region_of_tile_;
  std::vector<Made> made_;  ///< used last first
  SignatureIndex index_;    ///< of all nodes' signatures; values are indices of nodes
  slam::PoseGraph graph_;
  std::map<std::uint32_t, std::size_t> graph_node_;  ///< by id
  std::map<std::uint32_t, vision::FeatureList> features_;
};

}  // namespace seeker::fleet
