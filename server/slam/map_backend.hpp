/// \file
/// The sparse graph of local maps: their poses, the loops between them, and the global map they form.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/slam/line_slam_params.hpp"
#include "server/slam/map_tracker.hpp"
#include "server/slam/pose_graph.hpp"

namespace seeker::slam {

/// The stored data of one local map.
struct LocalMap {
  std::uint32_t id = 0;
  RobotTime created;
  /// Poses in the frame of the local map, although the field is named map_T_segment.
  std::vector<MapSegment> segments_node;
  std::vector<MapKeyframe> keyframes;
};

/// The observation of a kept scan within a range, in the frame `base`.
[[nodiscard]] SeenPoints view_of(const MapKeyframe& keyframe, double range_m);

struct LoopCounts {
  int tried = 0;
  int closed = 0;     ///< accepted and part of the graph
  int surprises = 0;  ///< loops that had to wait for confirmation by others
  /// Comparisons since the last loop, each with its own scans, in which a map that is only read differs from the scans
  /// at the estimated pose.
  int contradictions = 0;
};

/// Local maps are numbered from 0. The epoch rises with each optimisation that moves the map.
///
/// A map that grows keeps everything up to KnownGroundParams::max_keyframes; beyond it, only what shows something new.
///
/// In a map that is only read (MapUse::kLocalise) the loaded local maps are fixed, and of the robot's own only the
/// newest two are kept, whose numbers change with that: the information of the older ones about the robot's pose
/// becomes one relation. Memory and cost do not grow however long the robot drives.
class MapBackend {
 public:
  explicit MapBackend(const LoopPolicy& params = {}, const KnownGroundParams& known_ground = {});

  /// Begins the first local map at a pose in the frame `map`.
  std::uint32_t begin_first(const Pose2& map_T_node, RobotTime stamp);
  /// Begins a local map at the measured pose of its frame in that of its predecessor, with the covariance of that pose.
  std::uint32_t begin_next(const Pose2& last_T_new, const Matrix3& covariance, RobotTime stamp);
  /// Replaces everything by a map that has passed validate(). The next local map must be begun with begin_apart().
  void load(const LineMap& map, MapUse use);
  /// Begins a local map whose pose in the global map is unknown: no relation joins it to the others until anchor().
  std::uint32_t begin_apart(RobotTime stamp);
  [[nodiscard]] bool apart() const { return apart_from_.has_value(); }
  [[nodiscard]] bool is_apart(std::uint32_t id) const { return apart_from_ && id >= *apart_from_; }
  /// Joins the local maps begun apart to the others: the newest of them is at map_T_newest, as found by comparison with
  /// the others; `covariance` is defined as in newest_covariance().
  void anchor(const Pose2& map_T_newest, const Matrix3& covariance);
  /// Scans of all joined local maps, in the frame `map`, for relocalisation.
  [[nodiscard]] std::vector<SeenPoints> seen() const;
  /// The same scans, limited to those made within a range of a position.
  [[nodiscard]] std::vector<SeenPoints> seen_about(const Point2& p_map, double range_m) const;
  /// The local maps with smaller numbers form the map: those that are joined, or in a map that is only read, those that
  /// were loaded.
  [[nodiscard]] std::uint32_t map_end() const;
  [[nodiscard]] LocalMap& newest() { return maps_.back(); }
  [[nodiscard]] const std::vector<LocalMap>& maps() const { return maps_; }
  [[nodiscard]] const Pose2& pose(std::uint32_t id) const { return graph_.pose(id); }
  /// Covariance of (x, y, theta) of the newest local map's frame in the frame `map`.
  [[nodiscard]] const Matrix3& newest_covariance() const { return newest_covariance_; }
  [[nodiscard]] std::uint32_t epoch() const { return epoch_; }
  [[nodiscard]] const LoopCounts& loops() const { return counts_; }

  /// Selects the older local maps that may show the surroundings of the robot that the newest shows.
  void plan_loops(const Pose2& node_T_base);
  /// Compares the newest local map with one of the selected ones, so that no scan has to wait for all, and optimises
  /// after the last when a loop was found. True when the map has moved.
  bool step_loops();

  /// Poses and relations of the local maps below `end`, their segments and scans, in the frame `map`.
  [[nodiscard]] LineMap assemble(std::uint32_t end) const;
  /// The local maps that are part of the map, with their poses.
  [[nodiscard]] std::vector<MapPiece> pieces() const;
  /// The segments of the local maps below `end`, in the frame `map`.
  [[nodiscard]] std::vector<MapSegment> segments(std::uint32_t end) const;

 private:
  /// The scans by which the newest local map is compared with others.
  struct View {
    std::vector<SeenPoints> seen_node;  ///< in the frame of the newest local map
    RobotTime first;                    ///< time of the oldest scan
    RobotTime last;                     ///< time of the newest scan
  };
  /// A surprising loop with the times of the scans that observed it.
  struct Surprise {
    LoopEdge loop;
    RobotTime first;
    RobotTime last;
  };
  struct Candidate {
    std::uint32_t id = 0;
    double distance_m = 0.0;
  };

  /// The newest local map is compared with the local maps of smaller numbers.
  [[nodiscard]] std::uint32_t loop_end() const;
  [[nodiscard]] std::vector<Candidate> candidates(const Pose2& map_T_base) const;
  [[nodiscard]] View newest_view() const;
  [[nodiscard]] std::shared_ptr<const PlaceMap> place_of(std::uint32_t id);
  /// No value where a loaded map has parts that no relation joins.
  [[nodiscard]] std::optional<UncertainPose> relative(std::size_t from, std::size_t to);
  [[nodiscard]] std::vector<LoopEdge> believed(const LoopEdge& loop, const View& view, const UncertainPose& expected);
  /// Records that no loop was found, and whether this contradicts the map.
  void note_refusal(const View& view, const PlaceMap& place, const UncertainPose& expected);
  /// The surprising loops that enough others, observed independently, agree with, the last one among them.
  [[nodiscard]] std::vector<LoopEdge> witnessed();
  void add_loop(const LoopEdge& loop);
  /// Adds an edge to the graph that loses its weight where all others disagree with it.
  std::size_t relate(std::size_t i, std::size_t j, const UncertainPose& i_T_j);
  /// Combines the information of earlier local maps and of loops about the pose of a joined local map into one relation
  /// to the first; relations that begin at it stay. False where the graph cannot be evaluated.
  [[nodiscard]] bool stand_alone(std::uint32_t id);
  /// Drops the robot's own local maps before `first` in a map that is only read.
  void drop_own_before(std::uint32_t first);
  bool optimise();

  // map_backend_known.cpp
  /// Empties a finished local map that shows nothing new, where the map is larger than it should be.
  void forget_known(std::uint32_t id);
  [[nodiscard]] std::size_t keyframe_count() const;
  /// Leaves an emptied local map one relation, to an older one: its most certain loop, or the path where it has none.
  /// The local map after it gets the relation to that older one that the path through the emptied one was.
  void bypass(std::uint32_t id);
  /// Whether a local map has no more than one relation to others.
  [[nodiscard]] bool hangs_on_one(std::size_t node) const;
  /// An older local map with scans, and how near one of them was taken to a place.
  struct NearMap {
    std::uint32_t id;
    double away_m;
    bool looked_so;  ///< whether one from within the limits looked in that direction too
  };
  [[nodiscard]] std::vector<NearMap> nearest_older(std::uint32_t id, const Pose2& map_T_base) const;
  /// The nearest older local map that shows what this scan of local map `id` shows, alone or with others around it.
  [[nodiscard]] std::optional<std::uint32_t> shown_by(std::uint32_t id, const MapKeyframe& keyframe);
  /// Whether nothing has changed there since: scans of local map `id` against an older one.
  [[nodiscard]] bool agrees(std::uint32_t older, std::uint32_t id, const std::vector<SeenPoints>& seen_node);

  LoopPolicy params_;
  KnownGroundParams known_ground_;
  std::vector<LocalMap> maps_;
  PoseGraph graph_;
  LoopDetector detector_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> loop_of_pair_;  ///< edge of the graph
  std::deque<std::uint32_t> planned_;                                        ///< local maps to compare with
  bool unsettled_ = false;                                                   ///< loops were added since optimise()
  std::optional<RobotTime> contradicted_by_;  ///< the newest scan that was counted as a contradiction
  std::vector<Surprise> pending_;             ///< surprising loops without confirmation
  /// Prepared local maps, most recently used first.
  std::deque<std::pair<std::uint32_t, std::shared_ptr<const PlaceMap>>> places_;
  /// The path from this local map to the newest has been driven without interruption.
  std::uint32_t unbroken_from_ = 0;
  std::optional<std::uint32_t> apart_from_;  ///< this local map and those after it are not joined to the others
  std::optional<std::uint32_t> own_from_;    ///< the map is only read: local maps from this one on are not part of it
  Matrix3 newest_covariance_ = Matrix3::Zero();
  std::uint32_t epoch_ = 0;
  LoopCounts counts_;
};

}  // namespace seeker::slam
