/// \file
/// Runs one mission at a time: its behaviour, pause and end, what happens when its client is lost, its log.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"
#include "server/app/missions/behaviour.hpp"
#include "server/app/missions/link_watch.hpp"
#include "server/app/missions/mission_findings.hpp"
#include "server/app/missions/travelled_path.hpp"

namespace seeker::app {

struct MissionParams {
  /// Wall time a silent client has to come back, where the mission's link policy has its short form.
  Duration link_grace = std::chrono::seconds(5);
  Duration fault_grace = std::chrono::seconds(10);  ///< robot time a blocking fault may last
  /// Robot time without localisation; the time in which the robot is looked for in its map does not count.
  Duration lost_grace = std::chrono::seconds(10);
  double look_round_rad_s = 0.4;                     ///< it rotates so fast on the spot while it is looked for
  Duration report_period = std::chrono::seconds(1);  ///< robot time between reports of an unchanged phase
};

/// Makes the behaviour of a task. Refusals (an unusable target picture) become the answer to the client.
using BehaviourFactory = std::function<Result<std::unique_ptr<Behaviour>>(const api::MissionTask&, const Situation&)>;

/// Where the executor's results go. All are called on the loop's thread.
struct MissionOutputs {
  std::function<void(const api::Event&)> event;
  std::function<void(const api::MissionStatus&)> status;
  std::function<void(const api::Detection&)> detection;  ///< new, refined, or withdrawn
  /// The mission that begins, before any event of it: a journal that keeps its events knows whose they are. May be
  /// empty.
  std::function<void(const api::MissionRequest&)> begun = {};
};

/// How far a mission has come: what one that was cut off goes on from.
struct MissionSoFar {
  std::optional<Point2> start_map;         ///< where it began; nothing: it begins where the robot is
  Duration running{0};                     ///< robot time in which it ran: neither paused nor held
  std::vector<api::Detection> found = {};  ///< by it and by those before it, places in the present map; by rising id

  friend bool operator==(const MissionSoFar&, const MissionSoFar&) = default;
};

class MissionExecutor {
 public:
  MissionExecutor(const MissionParams& params, BehaviourFactory factory, MissionOutputs outputs);

  /// kBusy while another mission runs; the id of the running one is accepted again. `so_far` is of one that was cut
  /// off.
  [[nodiscard]] Result<api::MissionId> start(const api::MissionRequest& request, const std::string& owner,
                                             const Situation& situation, const MissionSoFar& so_far = {});
  /// kNotReady when no mission runs or it is not in the state for the command.
  [[nodiscard]] Status command(api::MissionCommand command, RobotTime now);
  /// Ends a running mission; nothing otherwise.
  void end(api::Outcome outcome, const std::string& cause, const std::string& remedy, RobotTime now);
  /// Holds a running mission; `why` is shown as its activity.
  void pause(RobotTime now, const std::string& why);

  /// One tick; a decision without command when nothing runs. `blocking` is a fault that forbids motion.
  [[nodiscard]] Decision step(const Situation& situation, const api::Fault* blocking, WallTime wall_now);
  void on_recognition(const Recognition& recognition);
  void on_look(const Result<StereoLook>& look);
  /// What a running mission knows of places moves with the map, and so does what ended ones have found and searched in
  /// it: it is reported to other robots as long as the map lives. Only the grid of an ended mission keeps its epoch.
  void map_moved(const MapCorrection& correction, RobotTime now);

  /// Uses other times of patience from now on.
  void use(const MissionParams& params) { params_ = params; }
  /// Makes the running mission's recogniser again with other parameters; success where none runs.
  [[nodiscard]] Status use(const vision::RecogniserParams& params) {
    return active_ ? active_->behaviour->use(params) : Status();
  }
  /// What the behaviour knew when the program was cut off; before its first step.
  void remember(const MissionMemory& memory);
  /// The client has been silent since then: the link policy of its mission counts from there.
  void client_silent(const std::string& client, WallTime since);
  /// The client has sent something again. What its mission's link policy has done stays done.
  void client_back(const std::string& client, RobotTime now);
  /// While the client that started the mission is silent: what comes next.
  [[nodiscard]] std::optional<api::LinkCountdown> link_countdown() const;
  /// Carries out what the link policy says by now; step() does it, too. For a loop that makes no steps while a mission
  /// is paused.
  void watch_link(const Situation& situation, WallTime wall_now);

  [[nodiscard]] bool running() const { return active_ && active_->status.state == api::MissionState::kRunning; }
  [[nodiscard]] bool present() const { return active_.has_value(); }
  /// Of the mission that runs or is paused, places in the present map; nothing when there is none.
  [[nodiscard]] std::optional<MissionSoFar> so_far() const;
  /// What the running mission was asked for; null when none runs.
  [[nodiscard]] const api::MissionRequest* request() const { return active_ ? &active_->request : nullptr; }
  /// The running mission or the last one.
  [[nodiscard]] const std::optional<api::MissionStatus>& last() const { return last_; }
  /// Of the mission that runs or ran last, and the newest of those before; by rising id.
  [[nodiscard]] const std::vector<api::Detection>& detections() const { return findings_.detections(); }
  [[nodiscard]] MissionFindings& findings() { return findings_; }
  [[nodiscard]] const MissionFindings& findings() const { return findings_; }
  /// What the running search has searched, or the last one of this map epoch; see Behaviour::searched().
  [[nodiscard]] std::optional<SearchedFloor> searched(const PoseEstimate& at) const;
  [[nodiscard]] const Behaviour* behaviour() const { return active_ ? active_->behaviour.get() : nullptr; }

 private:
  struct Active {
    api::MissionRequest request;
    std::string owner;
    std::unique_ptr<Behaviour> behaviour;
    api::MissionStatus status;
    MissionSoFar so_far;
    std::optional<RobotTime> ran_at;   ///< the step before this one; none after a pause or while it is held
    std::uint64_t detection_base = 0;  ///< added to the behaviour's own ids, which count from 1
    LinkWatch link;
    bool finish_step = false;
    std::optional<api::MissionEnd> end_after;  ///< the outcome once the robot is back (link policy RETURN)
    bool paused_by_link = false;               ///< by the link policy alone, which may end the pause, too
    TravelledPath travelled;
    std::optional<RobotTime> blocked_since;
    std::optional<RobotTime> unlocalised_since;
    bool decision_reported = true;   ///< the status' decision was in a report
    std::optional<Pose2> last_pose;  ///< from which the path length is counted on; none after the map has moved
    Pose2 pose;                      ///< where it was last, frame `map`
    RobotTime last_report;
    std::uint32_t map_epoch = 0;  ///< that results belong to

    void count_time(RobotTime now);
    /// Of the mission's limit; nothing: it has none.
    [[nodiscard]] std::optional<Duration> time_left() const;
  };

  [[nodiscard]] Decision held(const Situation& situation, const std::string& activity);
  [[nodiscard]] bool hold_for_trouble(const Situation& situation, const api::Fault* blocking);
  void go_on(RobotTime now, const std::string& why);
  void carry_out(const api::LinkStep& step, const Situation& situation);
  void return_because(const api::MissionEnd& why, const Situation& situation);
  void end_link_pause(const Situation& situation);
  void take(const Decision& decision, const Situation& situation);
  void finish(const api::MissionEnd& end, RobotTime now);
  [[nodiscard]] api::MissionEnd as_it_counts(api::MissionEnd end) const;
  void collect();
  void collect_detections();
  void keep_searched();
  void report(RobotTime now);
  void log(RobotTime now, const std::string& kind, const std::string& text,
           api::Severity severity = api::Severity::kInfo);

  MissionParams params_;
  BehaviourFactory factory_;
  MissionOutputs outputs_;
  std::optional<Active> active_;
  std::optional<api::MissionStatus> last_;
  MissionFindings findings_;
  std::uint64_t event_sequence_ = 0;
};

}  // namespace seeker::app
