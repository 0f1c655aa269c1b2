/// \file
/// Starts a mission and follows it to its end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/cli/context.hpp"
#include "client/cli/update_queue.hpp"

namespace seeker::cli {

/// How a mission is followed, and how far.
struct FollowOptions {
  std::optional<Duration> wall;   ///< then the mission is stopped and the wait fails with kTimeout
  std::optional<Duration> robot;  ///< then the mission is stopped and its end is the report
  bool decisions = false;         ///< with --json: print each decision of an exploration as a line of its own
};

/// How a mission went.
struct MissionReport {
  api::MissionStatus status;
  std::vector<api::Detection> detections;  ///< of this mission, the newest state of each
  Duration wall = Duration::zero();
  bool overran = false;  ///< stopped by us at FollowOptions::robot
};

/// A mission that was started by us. Its stream is open, so that nothing between start and follow() is missed.
class MissionRun {
 public:
  /// Errors: the robot's refusal, kTimeout, kLinkLost.
  [[nodiscard]] static Result<MissionRun> start(const Context& context, const api::MissionRequest& request);

  /// Wall time since the start.
  [[nodiscard]] Duration elapsed() const { return std::chrono::steady_clock::now() - started_; }

  /// Shows progress until the end. Ctrl-C and the wall limit ask the robot to stop the mission first.
  [[nodiscard]] Result<MissionReport> follow(const Context& context, const FollowOptions& options);

 private:
  void take(const Context& context, const api::Update& update);
  /// True when it is new or has been withdrawn.
  bool take(const api::Detection& detection);
  void take_list(const Context& context);
  [[nodiscard]] Status poll(const Context& context);
  [[nodiscard]] Error stop_because(const Context& context, Error why) const;
  void show_progress(const Context& context) const;
  void show_decision(const Context& context);

  api::MissionRequest request_;
  Stream stream_;
  std::chrono::steady_clock::time_point started_;
  MissionReport report_;
  std::string phase_shown_;
  bool decision_lines_ = false;       ///< FollowOptions::decisions
  std::uint64_t decision_shown_ = 0;  ///< number of the newest
};

/// An id nobody else has chosen: kind, date, time and some random letters.
[[nodiscard]] api::MissionId make_mission_id(const std::string& kind);

}  // namespace seeker::cli
