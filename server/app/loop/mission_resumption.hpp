/// \file
/// MissionResumption holds a mission that a crash cut off, and how far its resumption has come.
#pragma once

#include <optional>
#include <string>

#include "common/api/mission.hpp"
#include "common/core/pose2.hpp"
#include "common/core/time.hpp"
#include "server/app/maps/robot_map.hpp"
#include "server/app/state/checkpoint.hpp"

namespace seeker::app {

/// The command `resume` starts that mission again while no other has been started: in the map that it had built, once
/// the robot has found its place in it. Lives on the loop's thread.
class MissionResumption {
 public:
  explicit MissionResumption(const RobotMapParams& params) { use(params); }

  /// Uses other parameters of the search for the robot's place from now on.
  void use(const RobotMapParams& params) {
    look_round_after_ = params.look_round_after;
    look_round_rad_s_ = params.look_round_rad_s;
  }

  void offer(std::optional<api::MissionRequest> request) { unfinished_ = std::move(request); }
  [[nodiscard]] const std::optional<api::MissionRequest>& unfinished() const { return unfinished_; }
  [[nodiscard]] bool is_of(const api::MissionId& mission) const { return unfinished_ && unfinished_->id == mission; }
  /// True when that mission was building a map, which may have been kept.
  [[nodiscard]] bool needs_map() const;
  /// True when the map in use is the one that the mission had built.
  [[nodiscard]] bool has_own_map() const { return has_own_map_; }
  /// Returns what was kept of the mission besides the map.
  [[nodiscard]] const KeptState& kept() const { return kept_; }

  /// Call it when the mission's map is loaded: the robot looks for its place in it on behalf of `client`.
  void begin_search(KeptState kept, const std::string& client, RobotTime now);
  [[nodiscard]] bool searching() const { return searching_; }
  [[nodiscard]] const std::string& client() const { return client_; }
  /// Returns the velocity that rotates a robot that is not found at once by 360 degrees on the spot, since what is in
  /// its map may lie behind it. `heading_rad` is by odometry.
  [[nodiscard]] Twist2 look_round(double heading_rad, RobotTime now);
  void end_search() { searching_ = false; }

  /// The mission goes on without its map: of what was kept, only the time it ran still holds.
  void go_on_without_map(const MissionSoFar& so_far);
  /// Call it when the map in use is not the mission's own.
  void forget_map() { has_own_map_ = false; }
  /// Call it when another map was loaded: what was kept is dropped, since it belongs to the mission's own map.
  void another_map_loaded();
  /// Call it when this or another mission runs.
  void mission_began();

 private:
  Duration look_round_after_{};
  double look_round_rad_s_ = 0.0;
  std::optional<api::MissionRequest> unfinished_;
  bool has_own_map_ = false;
  KeptState kept_;
  bool searching_ = false;
  RobotTime searching_since_;
  std::string client_;
  std::optional<double> last_heading_rad_;  ///< by odometry at the last look_round()
  double turned_rad_ = 0.0;                 ///< rotation of the robot since the search began, without sign
};

}  // namespace seeker::app
