/// \file
/// The sparse graph over local maps: their places, the loops between them, and the whole map they make.
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

/// What one local map leaves behind.
struct LocalMap {
  std::uint32_t id = 0;
  RobotTime created;
  std::vector<MapSegment> segments_node;  ///< poses in the frame of the local map, whatever their field says
  std::vector<MapKeyframe> keyframes;
};

/// What a kept scan saw within a range, in the frame `base`.
[[nodiscard]] SeenPoints view_of(const MapKeyframe& keyframe, double range_m);

struct LoopCounts {
  int tried = 0;
  int closed = 0;     ///< believed and part of the graph
  int surprises = 0;  ///< that had to wait for witnesses
  /// Comparisons since the last loop, each by scans of its own, by which a map that is only read looks otherwise where
  /// the robot is thought to be.
  int contradictions = 0;
};

/// Local maps are numbered from 0. Poses rise in epochs: each optimisation that moves the map.
///
/// In a map that is only read (MapUse::kLocalise) the loaded local maps stand still, and of the robot's own only the
/// newest two are kept, whose numbers change with that: what the older ones said of the robot's place becomes one
/// relation. Memory and cost do not grow however long the robot drives.
class MapBackend {
 public:
  explicit MapBackend(const LoopPolicy& params = {});

  /// Begins a local map; with a predecessor, by the measured pose of its frame there and the covariance of that.
  std::uint32_t begin_first(const Pose2& map_T_node, RobotTime stamp);
  std::uint32_t begin_next(const Pose2& last_T_new, const Matrix3& covariance, RobotTime stamp);
  /// Replaces everything by a map that has passed validate(). The next local map must be begun with begin_apart().
  void load(const LineMap& map, MapUse use);
  /// Begins a local map whose place in the whole is not known: nothing joins it to the others until anchor().
  std::uint32_t begin_apart(RobotTime stamp);
  [[nodiscard]] bool apart() const { return apart_from_.has_value(); }
  [[nodiscard]] bool is_apart(std::uint32_t id) const { return apart_from_ && id >= *apart_from_; }
  /// Puts what was begun apart where it belongs: the newest local map is at map_T_newest, as found by comparing it with
  /// the others; `covariance` as in newest_covariance().
  void anchor(const Pose2& map_T_newest, const Matrix3& covariance);
  /// Scans of all local maps but those begun apart, in the frame `map`: what a place is searched in.
  [[nodiscard]] std::vector<SeenPoints> seen() const;
  /// ... that were made within a range of a place.
  [[nodiscard]] std::vector<SeenPoints> seen_about(const Point2& p_map, double range_m) const;
  /// Local maps below it are the map: those that are joined, and where it is only read, those that were loaded.
  [[nodiscard]] std::uint32_t map_end() const;
  [[nodiscard]] LocalMap& newest() { return maps_.back(); }
  [[nodiscard]] const std::vector<LocalMap>& maps() const { return maps_; }
  [[nodiscard]] const Pose2& pose(std::uint32_t id) const { return graph_.pose(id); }
  /// Of (x, y, theta) of the newest local map's frame in the frame `map`.
  [[nodiscard]] const Matrix3& newest_covariance() const { return newest_covariance_; }
  [[nodiscard]] std::uint32_t epoch() const { return epoch_; }
  [[nodiscard]] const LoopCounts& loops() const { return counts_; }

  /// Notes which older local maps may show what the newest shows around the robot.
  void plan_loops(const Pose2& node_T_base);
  /// Compares with one of them, so that no scan has to wait for all, and optimises after the last when a loop was
  /// found. True when the map has moved.
  bool step_loops();

  /// Places and relations of the local maps below `end`, their segments and scans; the frame is `map`.
  [[nodiscard]] LineMap assemble(std::uint32_t end) const;
  /// Local maps that are part of the map.
  [[nodiscard]] std::vector<MapPiece> pieces() const;
  /// Their segments alone, in the frame `map`.
  [[nodiscard]] std::vector<MapSegment> segments(std::uint32_t end) const;

 private:
  /// The scans that the newest local map is compared with others by.
  struct View {
    std::vector<SeenPoints> seen_node;  ///< in the frame of the newest local map
    RobotTime first;                    ///< stamps of the oldest and
    RobotTime last;                     ///< the newest of them
  };
  /// A loop that surprises, with the stamps of the scans that it was seen by.
  struct Surprise {
    LoopEdge loop;
    RobotTime first;
    RobotTime last;
  };
  struct Candidate {
    std::uint32_t id = 0;
    double distance_m = 0.0;
  };

  /// Local maps below it are compared with the newest.
  [[nodiscard]] std::uint32_t loop_end() const;
  [[nodiscard]] std::vector<Candidate> candidates(const Pose2& map_T_base) const;
  [[nodiscard]] View newest_view() const;
  [[nodiscard]] std::shared_ptr<const PlaceMap> place_of(std::uint32_t id);
  /// Nothing where a loaded map has parts that no relation joins: all or none of its local maps have one.
  [[nodiscard]] std::optional<UncertainPose> relative(std::size_t from, std::size_t to);
  [[nodiscard]] std::vector<LoopEdge> believed(const LoopEdge& loop, const View& view, const UncertainPose& expected);
  /// What it means that no loop was found.
  void note_refusal(const View& view, const PlaceMap& place, const UncertainPose& expected);
  /// Of the surprises those that enough others, seen independently, agree with, the last one among them.
  [[nodiscard]] std::vector<LoopEdge> witnessed();
  void add_loop(const LoopEdge& loop);
  /// An edge of the graph that loses its say where all others disagree with it.
  std::size_t relate(std::size_t i, std::size_t j, const UncertainPose& i_T_j);
  /// Puts all that earlier local maps and its own loops say of the place of a joined local map into one relation to the
  /// first; what begins at it stays. False where the graph cannot say.
  [[nodiscard]] bool stand_alone(std::uint32_t id);
  /// Of the robot's own local maps in a map that is only read.
  void drop_own_before(std::uint32_t first);
  bool optimise();

  LoopPolicy params_;
  std::vector<LocalMap> maps_;
  PoseGraph graph_;
  LoopDetector detector_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> loop_of_pair_;  ///< edge of the graph
  std::deque<std::uint32_t> planned_;                                        ///< local maps to compare with
  bool unsettled_ = false;                                                   ///< loops were added since optimise()
  std::optional<RobotTime> contradicted_by_;  ///< the newest scan that was counted among the contradictions
  std::vector<Surprise> pending_;             ///< surprises without witnesses
  std::deque<std::pair<std::uint32_t, std::shared_ptr<const PlaceMap>>> places_;  ///< used last first
  std::uint32_t unbroken_from_ = 0;  ///< the way from this local map to the newest is known by having been driven
  std::optional<std::uint32_t> apart_from_;  ///< this local map and those after it are not joined to the others
  std::optional<std::uint32_t> own_from_;    ///< the map is only read: local maps from this one on are not part of it
  Matrix3 newest_covariance_ = Matrix3::Zero();
  std::uint32_t epoch_ = 0;
  LoopCounts counts_;
};

}  // namespace seeker::slam
