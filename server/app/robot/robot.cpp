#include "server/app/robot/robot.hpp"

#include <algorithm>
#include <utility>

#include "common/api/fleet.hpp"
#include "common/log/log.hpp"
#include "server/app/robot/robot_session.hpp"

namespace seeker::app {
namespace {

/// Tasks waiting for the loop; more than any honest set of clients asks within one tick.
constexpr std::size_t kMailboxCapacity = 4096;
/// How long an idle loop sleeps before it looks at its sensors again.
constexpr std::chrono::milliseconds kIdleWait{200};
/// How long a loop that waits for its world leaves clients without an answer.
constexpr std::chrono::milliseconds kAwaitSlice{10};

constexpr const char* kMapWaits =
    "the map of the mission that was cut off has not been taken up again; 'seeker resume' does, and so does a new "
    "mission with a new map";

std::optional<Pose2> known_place(const RobotLoop& loop) {
  const PoseEstimate pose = loop.status().pose;
  return is_placed(pose.quality) ? std::optional<Pose2>(pose.map_T_base) : std::nullopt;
}

/// What whoever looks after the server wants to know without a client.
void tell_log(const api::Event& event) {
  constexpr const char* kPart = "robot";
  if (event.kind == "fault") {
    (event.severity >= api::Severity::kError ? log::error : log::warning)(kPart, "fault " + event.text);
  } else if (event.kind == "fault-cleared") {
    log::info(kPart, "fault " + event.text + " is gone");
  } else if (event.kind == "mission-started" || event.kind == "mission-ended") {
    log::info(kPart, "mission '" + event.mission + "' " + (event.kind == "mission-ended" ? "ended: " : "began: ") +
                         event.text);
  }
}

LoopParams of_robot(LoopParams params, const RobotIdentity& identity) {
  params.robot_id = identity.robot_id;
  return params;
}

}  // namespace

Robot::Robot(RobotIdentity identity, const LoopParams& params, LoopParts parts, std::unique_ptr<Journal> journal,
             const std::filesystem::path& maps, std::shared_ptr<LandmarkLibrary> landmarks,
             const std::filesystem::path& incoming)
    : identity_(std::move(identity)),
      loop_(of_robot(params, identity_), std::move(parts), hub_),
      mailbox_(kMailboxCapacity),
      journal_(std::move(journal)),
      map_store_({maps, identity_.robot_id, identity_.software_version}),
      maps_(map_store_, loop_, mailbox_),
      checkpoints_(map_store_, loop_, mailbox_),
      landmarks_(std::move(landmarks)),
      transfers_(incoming, maps_, landmarks_) {
  loop_.hooks().on_event = [this](const api::Event& event) {
    tell_log(event);
    if (journal_ && !event.mission.empty()) {
      journal_->event(event);
    }
  };
  if (journal_) {
    keep_journal();
  }
  if (journal_ && !maps.empty()) {
    loop_.hooks().on_checkpoint = [this](const api::MissionId& mission, Checkpoint checkpoint) {
      checkpoints_.write(mission, std::move(checkpoint));
    };
    loop_.hooks().on_place = [this](const api::MissionId& mission, const MissionPlace& place) {
      checkpoints_.write_place(mission, place);
    };
    loop_.hooks().on_checkpoint_unused = [this](const api::MissionId& mission) { checkpoints_.set_aside(mission); };
    loop_.hooks().on_checkpoints_void = [this] { checkpoints_.drop(); };
  }
}

Robot::~Robot() {
  stop();
  if (journal_) {
    journal_->set_watch({});
  }
  if (audit_) {
    audit_->set_watch(nullptr);
  }
}

FleetHost Robot::fleet_host() {
  FleetHost host;
  host.give_map = [this](const api::Reply<OwnMap>& reply) { give_own_map(reply); };
  host.give_topology = [this](const api::Reply<OwnTopology>& reply) { give_own_topology(reply); };
  host.give_seen = [this](const api::Reply<OwnSeen>& reply) { give_own_seen(reply); };
  // A full mailbox only delays what is said again soon.
  host.take_view = [this](std::optional<FleetView> view) {
    static_cast<void>(mailbox_.post(
        [this, view = std::move(view)]() mutable { loop_.neighbours().set_fleet(std::move(view), loop_.now()); }));
  };
  host.notify_operator = [this](const std::string& kind, const std::string& text, api::Severity severity) {
    static_cast<void>(mailbox_.post([this, kind, text, severity] { loop_.diagnostics().log(kind, text, severity); }));
  };
  host.decided = [this](const api::AuditRecord& record) {
    api::AuditRecord stamped = record;
    stamped.stamp = now();
    commanded(stamped);
  };
  return host;
}

void Robot::set_link_faults(std::vector<api::Fault> faults) {
  static_cast<void>(mailbox_.post([this, faults = std::move(faults)] {
    Diagnostics& diagnostics = loop_.diagnostics();
    for (const std::string& id : std::exchange(link_faults_, {})) {
      const bool lasts = std::any_of(faults.begin(), faults.end(), [&](const api::Fault& f) { return f.id == id; });
      if (!lasts) {
        diagnostics.clear(id);
      }
    }
    for (const api::Fault& fault : faults) {
      diagnostics.raise(fault.id, fault.component, fault.message, fault.remedy, fault.severity);
      link_faults_.push_back(fault.id);
    }
  }));
}

void Robot::give_own_map(const api::Reply<OwnMap>& reply) {
  const bool posted = mailbox_.post([this, reply] {
    Result<LineMap> map = loop_.mission_control().map_waits_for_resume()
                              ? Result<LineMap>(fail(Errc::kNotReady, kMapWaits))
                              : loop_.robot_map().map();
    if (!map) {
      reply(tl::unexpected<Error>(map.error()));
      return;
    }
    reply(OwnMap{std::move(*map), known_place(loop_), loop_.neighbours().own_pictures()});
  });
  if (!posted) {
    reply(fail(Errc::kBusy, "the robot is overloaded or shutting down"));
  }
}

void Robot::give_own_topology(const api::Reply<OwnTopology>& reply) {
  const bool posted = mailbox_.post([this, reply] {
    OwnTopology own;
    if (known_place(loop_) && !loop_.mission_control().map_waits_for_resume()) {
      own = loop_.neighbours().own();
    }
    reply(std::move(own));
  });
  if (!posted) {
    reply(fail(Errc::kBusy, "the robot is overloaded or shutting down"));
  }
}

void Robot::give_own_seen(const api::Reply<OwnSeen>& reply) {
  const bool posted = mailbox_.post([this, reply] {
    const std::optional<Pose2> place = known_place(loop_);
    if (!place || loop_.mission_control().map_waits_for_resume()) {
      reply(OwnSeen{});
      return;
    }
    const PoseEstimate pose = loop_.status().pose;
    std::vector<api::Detection> found = loop_.missions().detections();
    std::erase_if(found, [&](const api::Detection& one) { return one.map_epoch != pose.map_epoch; });
    reply(OwnSeen{.placed = true,
                  .floor = api::within_limits(loop_.robot_map().tiles_since(0).tiles, place->translation()),
                  .detections = api::within_limits(std::move(found)),
                  .searched = loop_.missions().searched(pose),
                  .sides = api::within_limits(sides_of(loop_.robot_map().segments()), place->translation())});
  });
  if (!posted) {
    reply(fail(Errc::kBusy, "the robot is overloaded or shutting down"));
  }
}

void Robot::keep_journal() {
  loop_.missions().findings().continue_ids(journal_->highest_detection_id());
  loop_.mission_control().offer_unfinished(journal_->unfinished());
  loop_.hooks().on_mission_started = [this](const api::MissionRequest& request) {
    journal_->mission_started(request, loop_.now());
  };
  loop_.hooks().on_mission = [this](const api::MissionStatus& status) { journal_->mission(status); };
  loop_.hooks().on_detection = [this](const api::Detection& detection) { journal_->detection(detection); };
  if (journal_->estop()) {
    loop_.commands().set_estop(true);
    log::warning("robot", "the emergency stop was latched when the program ended, and is; 'seeker estop --release'");
  }
  watch_journal();
  hub_.set_gate([this](std::function<void()> deliver) {
    // Also where the disk takes nothing: the fault says so, and who watches a robot needs to see it.
    journal_->when_kept([deliver = std::move(deliver)](const Status& /*kept*/) { deliver(); });
  });
}

void Robot::watch_journal() {
  if (!journal_->lost().empty()) {
    log::warning("robot", journal_->lost());
    loop_.diagnostics().raise("journal-lost", "journal", journal_->lost(),
                              "the robot works as before; this is said until the program starts again",
                              api::Severity::kWarning);
  }
  const auto warn = [this](const char* fault, const std::string& message, const char* remedy) {
    static_cast<void>(mailbox_.post([this, fault, message, remedy] {
      loop_.diagnostics().raise(fault, "journal", message, remedy, api::Severity::kWarning);
    }));
  };
  JournalWatch watch;
  watch.failing = [this, warn](const Error& error) {
    const auto cause = cause_and_remedy(error).cause;
    warn(kJournalFailed, "the journal in '" + journal_->folder().string() + "' cannot be written: " + cause,
         kJournalRemedy);
  };
  watch.writes_again = [this] {
    static_cast<void>(mailbox_.post([this] { loop_.diagnostics().clear(kJournalFailed); }));
  };
  watch.lost = [warn](const Error& error) {
    warn("journal-gap", "the journal lacks a record: " + error.message,
         "missions go on; look at the disk of the state folder");
  };
  journal_->set_watch(std::move(watch));
}

void Robot::record(std::unique_ptr<DriveRecorder> recorder) {
  recorder_ = std::move(recorder);
  recorder_->set_on_error([this](const Error& error) {
    static_cast<void>(mailbox_.post([this, error] {
      const auto [cause, remedy] = cause_and_remedy(error);
      loop_.diagnostics().raise("recording-failed", "recorder", cause, remedy, api::Severity::kWarning);
    }));
  });
  recorder_->follow(loop_.hooks());
}

void Robot::keep_audit(std::unique_ptr<AuditTrail> audit) {
  audit_ = std::move(audit);
  audit_->set_watch([this](const Status& written) {
    static_cast<void>(mailbox_.post([this, written] {
      if (written) {
        loop_.diagnostics().clear(kAuditFailed);
        return;
      }
      const auto [cause, remedy] = cause_and_remedy(written.error());
      loop_.diagnostics().raise(kAuditFailed, "audit", "who commands what cannot be recorded: " + cause,
                                (remedy.empty() ? "" : remedy + "; ") + "commands are carried out unrecorded",
                                api::Severity::kWarning);
    }));
  });
}

void Robot::diagnose(HostSources sources) {
  if (journal_) {
    sources.journal = [this] { return journal_->health(); };
  }
  if (audit_) {
    sources.audit_lost = [this] { return audit_->lost(); };
  }
  diagnosis_ = std::make_unique<DiagnosisService>(std::move(sources));
}

/// Answers when it is on the disk. The robot has stopped, or is free, in any case: the answer says where it is not
/// kept.
void Robot::keep_estop(bool engaged, const api::Reply<void>& reply) {
  if (!journal_) {
    reply({});
    return;
  }
  journal_->keep_estop(engaged, [reply, engaged](const Status& kept) {
    reply(kept ? kept
               : fail(Errc::kNotReady,
                      std::string("the emergency stop is ") +
                          (engaged ? "latched, but a restart of the robot's program would release it"
                                   : "released, but a restart of the robot's program would latch it again") +
                          " (" + kept.error().message + "); " + kJournalRemedy));
  });
}

/// Answers when the beginning of the mission is on the disk; where it cannot be written, the mission ends. `again`: it
/// ran before it was asked for, and goes on in any case.
void Robot::accept(const api::MissionAccepted& accepted, bool again, const api::Reply<api::MissionAccepted>& reply) {
  if (!journal_) {
    reply(accepted);
    return;
  }
  journal_->when_kept([this, accepted, again, reply](const Status& kept) {
    if (kept || again) {
      reply(accepted);
      return;
    }
    const auto refuse = [this, id = accepted.id, error = kept.error(), reply] {
      loop_.mission_control().end_unkept(id, error);
      reply(fail(Errc::kNotReady,
                 "the mission could not be kept on the disk (" + error.message + "); " + kJournalRemedy));
    };
    if (!mailbox_.post(refuse)) {
      reply(fail(Errc::kBusy, "the robot is shutting down"));
    }
  });
}

void Robot::answer_kept(const Status& done, const api::Reply<void>& reply) {
  if (!journal_ || !done) {
    reply(done);
    return;
  }
  // Where the disk takes nothing it is done all the same; the fault says that it is not kept.
  journal_->when_kept([reply](const Status& /*kept*/) { reply({}); });
}

void Robot::start(bool wait_for_client) {
  loop_.start();
  clock_.passed(loop_.now(), std::chrono::steady_clock::now(), false);
  thread_ = std::thread([this, wait_for_client] { run(wait_for_client); });
}

void Robot::stop() {
  mailbox_.close();
  if (thread_.joinable()) {
    thread_.join();
  }
  if (journal_) {
    journal_->finish();  // what clients are told last waits for the disk
  }
}

void Robot::run(bool wait_for_client) {
  while (!mailbox_.closed()) {
    loop_.world().hold();
    mailbox_.run_pending();
    if (loop_.idle() || (wait_for_client && !client_seen_)) {
      loop_.publish_idle();
      loop_.world().let_go();
      mailbox_.wait(kIdleWait);
    } else {
      loop_.tick(std::chrono::steady_clock::now());
    }
    // The others in a shared world may be slow, or the way there cut: clients are served meanwhile.
    while (!mailbox_.closed() && !pass()) {
      mailbox_.run_pending();
    }
    ended_ = loop_.world().ended();
  }
  loop_.world().hold();
  loop_.shut_down();
  mailbox_.run_pending();
}

bool Robot::pass() {
  const bool there = loop_.await(kAwaitSlice, std::chrono::steady_clock::now());
  clock_.passed(there ? std::optional(loop_.now()) : std::nullopt, std::chrono::steady_clock::now(),
                loop_.world().realtime() && !loop_.world().ended());
  return there;
}

api::RobotInfo Robot::info() const {
  api::RobotInfo info;
  info.robot_id = identity_.robot_id;
  info.software_version = identity_.software_version;
  info.capabilities = loop_.capabilities();
  info.robot_radius_m = identity_.robot_radius_m;
  info.realtime = loop_.world().realtime();
  return info;
}

std::shared_ptr<api::RobotApi> Robot::open(const api::Caller& caller) {
  client_seen_ = client_seen_ || !caller.client_name.empty();
  static_cast<void>(mailbox_.post([this, name = caller.client_name] { loop_.commands().client_back(name); }));
  return std::make_shared<Session>(*this, caller);
}

void Robot::closed(const api::Caller& caller) {
  static_cast<void>(mailbox_.post([this, name = caller.client_name] { loop_.commands().client_closed(name); }));
}

void Robot::silent(const api::Caller& caller, Duration silence) {
  static_cast<void>(
      mailbox_.post([this, name = caller.client_name, since = std::chrono::steady_clock::now() - silence] {
        loop_.commands().client_silent(name, since);
      }));
}

void Robot::returned(const api::Caller& caller) {
  static_cast<void>(mailbox_.post([this, name = caller.client_name] { loop_.commands().client_back(name); }));
}

void Robot::commanded(const api::AuditRecord& record) {
  if (audit_) {
    audit_->note(record);
  }
}

void Robot::lost(const api::Caller& caller, const std::string& why) {
  static_cast<void>(mailbox_.post([this, name = caller.client_name, why] {
    loop_.commands().client_lost(name, why, std::chrono::steady_clock::now());
  }));
}

}  // namespace seeker::app
