/// \file
/// What the main robot knows of itself for its fleet.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/api/fleet.hpp"
#include "server/app/fleet/own_map.hpp"
#include "server/app/fleet/robot_report.hpp"

namespace seeker::app {

/// The local maps of the main robot, its pose and its own report. Any thread may call all of it: a mutex of its own
/// guards the state, and nothing else is called while that is locked.
class OwnRobot {
 public:
  explicit OwnRobot(std::string robot_id) : robot_id_(std::move(robot_id)) {}

  [[nodiscard]] const std::string& id() const { return robot_id_; }

  /// The map and the report from before a restart, which hold until the robot has taken up its map again.
  void recall(const LineMap& map, const std::optional<RobotTopology>& topology, std::vector<api::Detection> found);
  /// The robot has not taken up its map again: what is remembered of it holds.
  void keep_remembered();
  /// The map as it is now. `is_new_map`: it has not grown from the one before, so that all that was reported in that
  /// one lapses.
  void take_map(const OwnMap& own, bool is_new_map);
  void receive(const OwnTopology& reported);
  /// The answer is whether it has found other targets than it reported before. A robot that has lost its pose takes
  /// nothing back.
  [[nodiscard]] bool receive(const OwnSeen& seen, WallTime received_at);

  /// The robot has not taken up its map since it was restarted: what is remembered holds, and what its loop reports is
  /// in another frame.
  [[nodiscard]] bool remembered() const;
  [[nodiscard]] RobotReport report() const;
  /// The entry of the main robot in the status of its fleet.
  [[nodiscard]] api::FleetMember describe() const;

 private:
  void forget_report();

  const std::string robot_id_;
  mutable std::mutex mutex_;    ///< guards what follows
  std::vector<Point2> places_;  ///< of its local maps
  std::size_t pictures_ = 0;    ///< of its topology's nodes
  std::optional<Pose2> map_T_base_;
  RobotReport report_;
  bool remembered_ = false;
};

}  // namespace seeker::app
