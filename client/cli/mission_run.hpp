/// \file
/// Starts a mission and follows it to its end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/cli/context.hpp"
#include "client/cli/update_queue.hpp"

namespace seeker::cli {

/// How a mission is followed, and when it is stopped.
struct FollowOptions {
  std::optional<Duration> wall;   ///< wall time after which the mission is stopped and the wait fails with kTimeout
  std::optional<Duration> robot;  ///< robot time after which the mission is stopped and its end is reported
  bool decisions = false;  ///< true, with --json: each decision of an exploration is printed as a line of its own
};

/// The end of a mission and its results.
struct MissionReport {
  api::MissionStatus status;
  std::vector<api::Detection> detections;  ///< the newest state of each detection of this mission
  Duration wall = Duration::zero();
  bool overran = false;  ///< true: it was stopped at FollowOptions::robot
};

/// A mission that this client has started. Its stream is open from the start, so that follow() misses no update.
class MissionRun {
 public:
  /// Starts a mission. Errors: the refusal of the robot, kTimeout, kLinkLost.
  [[nodiscard]] static Result<MissionRun> start(const Context& context, const api::MissionRequest& request);

  /// The link policy that applies, as the robot says; empty by robots of older software.
  [[nodiscard]] const api::LinkSteps& link_steps() const { return link_steps_; }
  /// Wall time since the start.
  [[nodiscard]] Duration elapsed() const { return std::chrono::steady_clock::now() - started_; }

  /// Shows progress until the mission has ended. On Ctrl-C and at the wall limit it asks the robot to stop the mission
  /// first.
  [[nodiscard]] Result<MissionReport> follow(const Context& context, const FollowOptions& options);

 private:
  void take(const Context& context, const api::Update& update);
  /// Adds a detection, or replaces or removes the one of its id. True when it is new or has been withdrawn.
  bool take(const api::Detection& detection);
  void take_list(const Context& context);
  [[nodiscard]] Status poll(const Context& context);
  [[nodiscard]] Error stop_because(const Context& context, Error why) const;
  void show_progress(const Context& context) const;
  void show_decision(const Context& context);

  api::MissionRequest request_;
  api::LinkSteps link_steps_;
  Stream stream_;
  std::chrono::steady_clock::time_point started_;
  MissionReport report_;
  std::string phase_shown_;
  bool decision_lines_ = false;       ///< FollowOptions::decisions
  std::uint64_t decision_shown_ = 0;  ///< number of the newest decision that was shown
};

/// A new id of a mission: kind, date, time and some random letters.
[[nodiscard]] api::MissionId make_mission_id(const std::string& kind);

}  // namespace seeker::cli
