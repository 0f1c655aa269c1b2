/// \file
/// A robot's map prepared for the comparison with those of others; data of unchanged parts are kept while it grows.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/fleet/map_graph.hpp"
#include "server/fleet/node_picture.hpp"
#include "server/fleet/scan_signature.hpp"
#include "server/slam/pairwise_consistency.hpp"
#include "server/slam/place_recogniser.hpp"
#include "server/slam/pose_graph.hpp"

namespace seeker::fleet {

struct PreparedMapParams {
  /// Coarse, since the match that follows is exact.
  slam::PlaceMapParams place{.pyramid = {.resolution_m = 0.08, .reach_m = 0.24}, .free_space = {}};
  SignatureParams signature;
  double view_range_m = 12.0;   ///< points farther from their scanner are not compared
  double region_m = 8.0;        ///< largest distance of a node from the centre of a region
  double region_view_m = 13.0;  ///< a region consists of the scans made within this distance of its centre
  /// Number of a node's scans, evenly chosen, that are searched for in other maps.
  std::size_t node_keyframes = 16;
  std::size_t region_keyframes = 80;  ///< number of a region's scans, evenly chosen
  std::size_t cached_regions = 24;    ///< number of regions that are kept prepared
  double moved_m = 0.03;              ///< relative displacement of a region's scans below which it is not rebuilt
  double moved_rad = 0.01;            ///< the same for the relative rotation
};

/// A local map as it is searched for in other maps. Points are in its own frame.
struct PreparedNode {
  std::uint32_t id = 0;
  Pose2 map_T_node;
  std::size_t keyframes = 0;  ///< number of keyframes from which it was made
  Point2 middle = Point2::Zero();
  std::vector<slam::SeenPoints> seen;
  std::vector<ScanSignature> signatures;
  std::size_t region = 0;  ///< region in which it lies
};

/// A part of the map in which others' nodes are searched for, in the frame of one of its nodes.
struct PreparedRegion {
  std::size_t node = 0;                         ///< index of that node
  std::vector<std::size_t> members;             ///< indices of nodes with scans in it
  std::shared_ptr<const slam::PlaceMap> place;  ///< null until first used, or where nothing was observed
};

/// Not thread-safe: regions are prepared at their first use.
class PreparedMap {
 public:
  explicit PreparedMap(const PreparedMapParams& params = {});

  /// Takes the present map. Nodes without scans are left out. Errors are those of validate(LineMap).
  [[nodiscard]] Status update(LineMap map);
  /// Sets the pictures that the robot has taken at its topology's nodes. Those of local maps that are not in the map,
  /// or have no scans, are kept, but show nothing until they are there.
  void set_pictures(NodePictures pictures);
  /// The map without pictures, its local maps moved to other poses, by their ids; its segments stay. Errors are those
  /// of update().
  [[nodiscard]] Result<PreparedMap> deformed(const std::function<Pose2(std::uint32_t)>& map_T_node) const;

  [[nodiscard]] const LineMap& map() const { return map_; }
  [[nodiscard]] const std::vector<PreparedNode>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<PreparedRegion>& regions() const { return regions_; }
  [[nodiscard]] const NodePictures& pictures() const { return pictures_; }
  /// Comparisons of the pictures with those of other maps, each of which is made once.
  [[nodiscard]] PictureComparisons& picture_comparisons() { return comparisons_; }
  /// The place of a region; null where nothing was observed.
  [[nodiscard]] std::shared_ptr<const slam::PlaceMap> place(std::size_t region);
  /// The region that shows the surroundings of a point of the frame `map`; no value where no node is near.
  [[nodiscard]] std::optional<std::size_t> region_at(const Point2& p_map) const;
  /// Regions with places similar to the node's, most similar first.
  [[nodiscard]] std::vector<std::size_t> regions_like(const PreparedNode& other, std::size_t at_most) const;
  /// The pose of a node in the frame of another one of this map, by indices, with its covariance in the map.
  [[nodiscard]] UncertainPose between(std::size_t from, std::size_t to);

 private:
  void prepare_nodes();
  void prepare_regions();
  void prepare_graph();
  [[nodiscard]] std::shared_ptr<const slam::PlaceMap> build(const PreparedRegion& region) const;
  /// The poses of the region's scans in its own frame and their number, from which its place was made.
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
  std::vector<Made> made_;  ///< most recently used first
  SignatureIndex index_;    ///< of all nodes' signatures; values are indices of nodes
  slam::PoseGraph graph_;
  GraphNodes graph_node_;
  NodePictures pictures_;
  PictureComparisons comparisons_;
};

/// Indices of the prepared nodes by their ids.
[[nodiscard]] std::map<std::uint32_t, std::size_t> node_indices(const PreparedMap& map);

}  // namespace seeker::fleet
