/// \file
/// What the robot knows of its surroundings: the occupancy it plans on and, where the estimator keeps one, the map of
/// segments. Keeps both consistent when the map moves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/api/map.hpp"
#include "common/api/robot_state.hpp"
#include "common/core/map_move.hpp"
#include "common/core/pose_estimate.hpp"
#include "server/app/maps/segment_log.hpp"
#include "server/nav/occupancy_map.hpp"
#include "server/slam/map_tracker.hpp"

namespace seeker::app {

struct RobotMapParams {
  int render_scans_per_tick = 40;   ///< kept scans rendered again after the map has moved,
  int calm_scans_per_tick = 5;      ///< or so many where that made no more difference
  double calm_move_m = 0.05;        ///< to where the robot is than this: a cell of the occupancy,
  double calm_rotation_rad = 0.01;  ///< and this: a cell at five metres
  Duration segment_period = std::chrono::milliseconds(500);  ///< between publications of changed segments, robot time
  Duration relocalise_limit = std::chrono::seconds(60);      ///< robot time in which a search for the place must end
  Duration checkpoint_period = std::chrono::seconds(30);     ///< robot time between checkpoints of a mission's map,
  double checkpoint_distance_m = 5.0;  ///< or this distance from the last: much of what is seen by then is not in it
  Duration place_period = std::chrono::seconds(1);  ///< robot time between notes of where the robot is in that map
  /// A robot that resumes a mission and is not found in its map within this robot time turns once on the spot,
  Duration look_round_after = std::chrono::seconds(3);
  double look_round_rad_s = 0.4;  ///< so fast
};

/// Under which name the present map is kept, and since when it exists.
struct MapIdentity {
  std::string name;                 ///< empty: neither saved nor loaded yet
  std::int64_t created_unix_s = 0;  ///< 0: in this run
  api::MapUse use = api::MapUse::kContinue;
};

/// A map as it leaves the loop to be saved.
struct LoopMap {
  LineMap map;
  MapIdentity identity;
};

/// When the pose's map epoch rises, the kept scans are written into a new occupancy map, some per tick, so that the
/// loop is never late; live scans are written into both, and the old one serves until the new one is finished. A map
/// that moves meanwhile is rendered once more after that: a map that moves again and again must be finished now and
/// then. Tiles carry the epoch of the map they were written in. Epochs count on when a map is loaded; the loaded map's
/// own epoch does not matter.
class RobotMap {
 public:
  /// `tracker` may be null: the estimator keeps no map then.
  RobotMap(const RobotMapParams& params, const nav::OccupancyParams& occupancy, slam::MapTracker* tracker);

  [[nodiscard]] bool has_segments() const { return tracker_ != nullptr; }

  /// Uses other parameters from now on.
  void use(const RobotMapParams& params) { params_ = params; }

  /// The estimate with this run's epoch. The map has moved when the epoch differs from that of the estimate before:
  /// by how much follows from where the robot would be in the old one, `old_map_T_base`.
  [[nodiscard]] PoseEstimate follow(const PoseEstimate& estimate, RobotTime now,
                                    const std::optional<Pose2>& old_map_T_base = std::nullopt);
  /// How the map had moved at the last follow() that found it moved and was given `old_map_T_base`: piece by piece, and
  /// around the robot as the robot did.
  [[nodiscard]] const MapMove& last_move() const { return last_move_; }
  [[nodiscard]] Status integrate(const LaserScan& scan, const Pose2& map_T_base);
  [[nodiscard]] Status integrate(const SonarScan& scan, const Pose2& map_T_base);
  /// Once a tick: goes on rendering a map that has moved.
  void step();
  [[nodiscard]] bool rendering() const { return fresh_.has_value(); }
  /// The occupancy is that of the newest epoch.
  [[nodiscard]] bool settled() const { return !rendering() && !moved_again_; }
  /// The robot looks for its place; ticks must go on although no mission runs.
  [[nodiscard]] bool relocalising() const { return relocalising_since_.has_value(); }

  /// Stays at its address; its own revision falls when it was rendered again: see revision().
  [[nodiscard]] const nav::OccupancyMap& occupancy() const { return occupancy_; }
  /// Of the occupancy; rises only.
  [[nodiscard]] std::uint64_t revision() const { return revision_base_ + occupancy_.revision(); }
  [[nodiscard]] api::TileUpdate tiles_since(std::uint64_t revision) const;

  /// Looks for changed segments, at most once per period. True when there are.
  bool take_segments(RobotTime now);
  /// kNotReady: the estimator keeps no map, nor did one before it.
  [[nodiscard]] Result<api::SegmentUpdate> segments_since(std::uint64_t revision) const;
  [[nodiscard]] std::optional<api::LineMapStatus> status() const;
  /// Of the whole map as they are now; none where the estimator keeps no map.
  [[nodiscard]] std::vector<MapSegment> segments() const;

  [[nodiscard]] Result<LineMap> map() const;
  [[nodiscard]] const MapIdentity& identity() const { return identity_; }
  void set_identity(MapIdentity identity) { identity_ = std::move(identity); }
  /// Replaces the map and looks for the robot's place in it. Errors of MapTracker::load(); all stays as it was then.
  [[nodiscard]] Status load(const LineMap& map, const MapIdentity& identity, RobotTime now);
  [[nodiscard]] Status relocalise(const std::optional<Pose2>& map_T_base, RobotTime now);
  /// Looks for the robot where it was last, then everywhere: MapTracker::look_where_it_stood().
  [[nodiscard]] Status look_where_it_stood(const Pose2& map_T_base, RobotTime now);
  /// Forgets the map; a new one begins where the robot is. There must be one of segments.
  void begin_new_map();
  /// Another estimator has taken over, with the map `tracker` or none (null); `epoch` is that of its estimate. Nothing
  /// of the map before is kept: the occupancy is a new one, too.
  void exchange_tracker(slam::MapTracker* tracker, std::uint32_t epoch);

 private:
  struct KeptScan {
    LaserScan scan;
    Pose2 map_T_base;
  };

  [[nodiscard]] Status look_for_robot(const std::function<Status(slam::MapTracker&)>& look, RobotTime now);
  void forget_map();
  void take_new_frame(std::uint32_t estimator_epoch);
  void begin_rendering(bool calm);
  void replace_occupancy(nav::OccupancyMap map, std::uint32_t epoch);

  RobotMapParams params_;
  nav::OccupancyParams occupancy_params_;
  slam::MapTracker* tracker_;
  nav::OccupancyMap occupancy_;
  std::uint64_t revision_base_ = 0;
  std::uint32_t occupancy_epoch_ = 0;

  std::uint32_t epoch_ = 0;         ///< of the estimates handed out
  std::uint32_t epoch_offset_ = 0;  ///< added to the tracker's own
  std::optional<nav::OccupancyMap> fresh_;
  std::deque<KeptScan> waiting_;      ///< to be written into fresh_,
  int scans_per_tick_ = 0;            ///< so many in a tick
  std::uint32_t rendered_epoch_ = 0;  ///< of the poses in waiting_
  bool moved_again_ = false;          ///< since then

  std::vector<slam::MapPiece> pieces_;  ///< as of the last follow()
  MapMove last_move_;

  SegmentLog segments_;
  std::optional<std::uint64_t> tracker_revision_;  ///< of the segments taken last
  std::uint32_t segments_epoch_ = 0;
  std::optional<RobotTime> segments_at_;
  MapIdentity identity_;
  std::optional<RobotTime> relocalising_since_;
};

}  // namespace seeker::app
