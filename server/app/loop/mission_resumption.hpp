/// \file
/// A mission that a crash cut off, and how far the robot has come in taking it up again.
#pragma once

#include <optional>
#include <string>

#include "common/api/mission.hpp"
#include "common/core/pose2.hpp"
#include "common/core/time.hpp"
#include "server/app/maps/robot_map.hpp"
#include "server/app/state/checkpoint.hpp"

namespace seeker::app {

/// `resume` starts the mission again while no other has been started: in the map that it had built, once the robot has
/// found its place in it. Lives on the loop's thread.
class MissionResumption {
 public:
  explicit MissionResumption(const RobotMapParams& params)
      : look_round_after_(params.look_round_after), look_round_rad_s_(params.look_round_rad_s) {}

  void offer(std::optional<api::MissionRequest> request) { unfinished_ = std::move(request); }
  [[nodiscard]] const std::optional<api::MissionRequest>& unfinished() const { return unfinished_; }
  [[nodiscard]] bool is_of(const api::MissionId& mission) const { return unfinished_ && unfinished_->id == mission; }
  /// It was building a map, which may have been kept.
  [[nodiscard]] bool needs_map() const;
  /// The map in use is the one that it had built.
  [[nodiscard]] bool has_own_map() const { return has_own_map_; }
  /// What is known of it besides the map.
  [[nodiscard]] const KeptState& kept() const { return kept_; }

  /// Its map is loaded, and the robot looks for its place in it on behalf of `client`.
  void begin_search(KeptState kept, const std::string& client, RobotTime now);
  [[nodiscard]] bool searching() const { return searching_; }
  [[nodiscard]] const std::string& client() const { return client_; }
  /// A robot that is not found at once turns once on the spot: what is in its map may lie behind it. `heading_rad` is
  /// by odometry.
  [[nodiscard]] Twist2 look_round(double heading_rad, RobotTime now);
  void end_search() { searching_ = false; }

  /// The mission goes on without its map: of what was kept, only the time it ran still holds.
  void go_on_without_map(const MissionSoFar& so_far);
  /// The map that is in use now is not its own.
  void forget_map() { has_own_map_ = false; }
  /// Another map was loaded: what was kept belongs to the mission's own.
  void another_map_loaded();
  /// It runs again, or another mission does.
  void mission_began();

 private:
  Duration look_round_after_;
  double look_round_rad_s_;
  std::optional<api::MissionRequest> unfinished_;
  bool has_own_map_ = false;
  KeptState kept_;
  bool searching_ = false;
  RobotTime searching_since_;
  std::string client_;
  std::optional<double> last_heading_rad_;  ///< by odometry while it turns,
  double turned_rad_ = 0.0;                 ///< and by how much it has turned
};

}  // namespace seeker::app
