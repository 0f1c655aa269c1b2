#include "server/app/robot/robot.hpp"

#include <utility>

#include "common/api/fleet.hpp"
#include "common/log/log.hpp"

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

/// One client's view: every call becomes a task of the loop's thread.
class Robot::Session final : public api::RobotApi, public std::enable_shared_from_this<Robot::Session> {
 public:
  Session(Robot& robot, std::string client) : robot_(robot), client_(std::move(client)) {}

  void get_info(api::Reply<api::RobotInfo> reply) override {
    ask(std::move(reply), [this] { return Result<api::RobotInfo>(robot_.info()); });
  }
  void get_status(api::Reply<api::RobotStatus> reply) override {
    ask(std::move(reply), [this] { return Result<api::RobotStatus>(loop().status()); });
  }
  void list_components(api::Reply<std::vector<api::ComponentInfo>> reply) override {
    ask(std::move(reply), [this] {
      return Result<std::vector<api::ComponentInfo>>(loop().diagnostics().components().list(loop().now()));
    });
  }
  void restart_component(const std::string& name, api::Reply<void> reply) override {
    ask(std::move(reply), [this, name] { return loop().commands().restart_component(name); });
  }
  void switch_component(const std::string& name, bool active, api::Reply<void> reply) override {
    ask(std::move(reply), [this, name, active] { return loop().commands().components().switch_to(name, active); });
  }
  void exchange_component(const std::string& name, const std::string& type, api::Reply<void> reply) override {
    ask(std::move(reply), [this, name, type] { return loop().commands().components().exchange(name, type); });
  }
  void get_settings(const std::string& component, api::Reply<std::vector<api::ComponentSetting>> reply) override {
    ask(std::move(reply), [this, component] { return loop().commands().components().settings(component); });
  }
  void set_settings(const std::string& component, const std::vector<std::string>& assignments,
                    api::Reply<std::vector<api::ComponentSetting>> reply) override {
    ask(std::move(reply),
        [this, component, assignments] { return loop().commands().components().set(component, assignments); });
  }
  void start_mission(const api::MissionRequest& request, api::Reply<api::MissionId> reply) override {
    ask(std::move(reply), [this, request] { return loop().commands().start_mission(request, client_); });
  }
  void command_mission(api::MissionCommand command, api::Reply<void> reply) override {
    if (command == api::MissionCommand::kResume) {
      robot_.checkpoints_.resume_mission(client_, reply);
      return;
    }
    ask(std::move(reply), [this, command] { return loop().commands().command_mission(command, client_); });
  }
  void get_mission(api::Reply<api::MissionStatus> reply) override {
    ask(std::move(reply), [this]() -> Result<api::MissionStatus> {
      if (!loop().missions().last()) {
        return fail(Errc::kNotFound, "no mission has been started yet");
      }
      return *loop().missions().last();
    });
  }
  void stop(api::Reply<void> reply) override {
    ask(std::move(reply), [this] {
      loop().commands().stop();
      return Status();
    });
  }
  void set_estop(bool engaged, api::Reply<void> reply) override {
    ask(std::move(reply), [this, engaged] {
      loop().commands().set_estop(engaged);
      return Status();
    });
  }
  void command_lease(api::LeaseAction action, api::Reply<api::LeaseState> reply) override {
    ask(std::move(reply), [this, action] { return loop().commands().command_lease(client_, action); });
  }
  void drive(const api::DriveCommand& command, api::Reply<void> reply) override {
    ask(std::move(reply), [this, command] { return loop().commands().drive(client_, command); });
  }
  void get_tiles(std::uint64_t since_revision, api::Reply<api::TileUpdate> reply) override {
    ask(std::move(reply),
        [this, since_revision] { return Result<api::TileUpdate>(loop().robot_map().tiles_since(since_revision)); });
  }
  void get_grid(api::Reply<api::GridReport> reply) override {
    ask(std::move(reply), [this]() -> Result<api::GridReport> {
      if (!loop().missions().findings().grid()) {
        return fail(Errc::kNotFound, "no search has been started yet, so there are no lists");
      }
      return *loop().missions().findings().grid();
    });
  }
  void get_detections(api::Reply<std::vector<api::Detection>> reply) override {
    ask(std::move(reply), [this] { return Result<std::vector<api::Detection>>(loop().missions().detections()); });
  }
  void get_trajectory(api::Reply<std::vector<api::StampedPose>> reply) override {
    ask(std::move(reply), [this] { return Result<std::vector<api::StampedPose>>(loop().trajectory().stamped()); });
  }
  void grab_image(const std::string& camera, api::Reply<api::ImageFrame> reply) override {
    ask(std::move(reply), [this, camera] { return loop().commands().grab_image(camera); });
  }
  void get_segments(std::uint64_t since_revision, api::Reply<api::SegmentUpdate> reply) override {
    ask(std::move(reply), [this, since_revision] { return loop().robot_map().segments_since(since_revision); });
  }
  void save_map(const std::string& name, bool replace, api::Reply<api::MapSummary> reply) override {
    robot_.maps_.save(name, replace, reply);
  }
  void load_map(const std::string& name, api::MapUse use, api::Reply<api::MapSummary> reply) override {
    robot_.maps_.load(name, use, reply);
  }
  void list_maps(api::Reply<std::vector<api::MapSummary>> reply) override { robot_.maps_.list(reply); }
  void inspect_map(const std::string& name, bool verify, api::Reply<api::MapSummary> reply) override {
    robot_.maps_.inspect(name, verify, reply);
  }
  void delete_map(const std::string& name, api::Reply<void> reply) override { robot_.maps_.remove(name, reply); }
  void download_map(const std::string& name, api::Reply<std::vector<std::uint8_t>> reply) override {
    robot_.maps_.download(name, reply);
  }
  void upload_map(const api::MapUpload& upload, api::Reply<api::MapSummary> reply) override {
    robot_.maps_.upload(upload, reply);
  }
  void list_landmarks(api::Reply<std::vector<api::LandmarkSummary>> reply) override { robot_.landmarks_.list(reply); }
  void inspect_landmarks(const std::string& name, bool verify, api::Reply<api::LandmarkSummary> reply) override {
    robot_.landmarks_.inspect(name, verify, reply);
  }
  void get_landmarks(const std::string& name, api::Reply<std::vector<api::LandmarkPoint>> reply) override {
    robot_.landmarks_.points(name, reply);
  }
  void prune_landmarks(const std::string& name, int min_views, api::Reply<api::LandmarkSummary> reply) override {
    robot_.landmarks_.prune(name, min_views, reply);
  }
  void revert_landmarks(const std::string& name, api::Reply<api::LandmarkSummary> reply) override {
    robot_.landmarks_.revert(name, reply);
  }
  void delete_landmarks(const std::string& name, api::Reply<void> reply) override {
    robot_.landmarks_.remove(name, reply);
  }
  void relocalise(const std::optional<Pose2>& map_T_base, api::Reply<void> reply) override {
    ask(std::move(reply), [this, map_T_base] { return loop().commands().relocalise(map_T_base); });
  }
  Result<std::unique_ptr<api::Subscription>> subscribe(const std::vector<api::TopicRequest>& topics,
                                                       api::UpdateSink sink) override {
    std::unique_ptr<api::Subscription> subscription = robot_.hub_.subscribe(topics, std::move(sink));
    // A full mailbox only delays the first picture of the map until the next change.
    static_cast<void>(robot_.mailbox_.post([self = shared_from_this()] { self->loop().publisher().republish(); }));
    return subscription;
  }

 private:
  [[nodiscard]] RobotLoop& loop() { return robot_.loop_; }

  template <class T, class Work>
  void ask(api::Reply<T> reply, Work work) {
    auto shared = std::make_shared<api::Reply<T>>(std::move(reply));
    // The task keeps the session alive: its client may be gone before the loop comes to it.
    if (!robot_.mailbox_.post(
            [shared, self = shared_from_this(), work = std::move(work)]() mutable { (*shared)(work()); })) {
      (*shared)(fail(Errc::kBusy, "the robot is overloaded or shutting down; try again"));
    }
  }

  Robot& robot_;
  std::string client_;
};

Robot::Robot(RobotIdentity identity, const LoopParams& params, LoopParts parts, std::unique_ptr<Journal> journal,
             const std::filesystem::path& maps, std::shared_ptr<LandmarkLibrary> landmarks)
    : identity_(std::move(identity)),
      loop_(of_robot(params, identity_), std::move(parts), hub_),
      mailbox_(kMailboxCapacity),
      journal_(std::move(journal)),
      map_store_({maps, identity_.robot_id, identity_.software_version}),
      maps_(map_store_, loop_, mailbox_),
      checkpoints_(map_store_, loop_, mailbox_),
      landmarks_(std::move(landmarks)) {
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
    journal_->set_on_error(nullptr);
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
  return host;
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
    const bool told = place && !loop_.mission_control().map_waits_for_resume();
    if (!told) {
      reply(OwnSeen{});
      return;
    }
    const PoseEstimate pose = loop_.status().pose;
    std::vector<api::Detection> found = loop_.missions().detections();
    std::erase_if(found, [&](const api::Detection& one) { return one.map_epoch != pose.map_epoch; });
    reply(OwnSeen{.placed = true,
                  .floor = api::within_limits(loop_.robot_map().tiles_since(0).tiles, place->translation()),
                  .detections = api::within_limits(std::move(found)),
                  .searched = loop_.missions().searched(pose)});
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
  journal_->set_on_error([this](const Error& error) {
    static_cast<void>(mailbox_.post([this, error] {
      loop_.diagnostics().raise("journal-failed", "journal", "the journal cannot be written: " + error.message,
                                "free space on the disk of the state folder; missions go on without a journal",
                                api::Severity::kWarning);
    }));
  });
}

void Robot::record(std::unique_ptr<DriveRecorder> recorder) {
  recorder_ = std::move(recorder);
  recorder_->set_on_error([this](const Error& error) {
    static_cast<void>(mailbox_.post([this, error] {
      const std::size_t remedy = error.message.rfind("; ");
      loop_.diagnostics().raise("recording-failed", "recorder", error.message.substr(0, remedy),
                                error.message.substr(remedy + 2), api::Severity::kWarning);
    }));
  });
  recorder_->follow(loop_.hooks());
}

void Robot::start(bool wait_for_client) {
  loop_.start();
  now_ns_ = loop_.now().time_since_epoch().count();
  thread_ = std::thread([this, wait_for_client] { run(wait_for_client); });
}

void Robot::stop() {
  mailbox_.close();
  if (thread_.joinable()) {
    thread_.join();
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
    while (!mailbox_.closed() && !loop_.await(kAwaitSlice, std::chrono::steady_clock::now())) {
      mailbox_.run_pending();
    }
    now_ns_ = loop_.now().time_since_epoch().count();
    ended_ = loop_.world().ended();
  }
  loop_.world().hold();
  loop_.shut_down();
  mailbox_.run_pending();
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
  return std::make_shared<Session>(*this, caller.client_name);
}

void Robot::closed(const api::Caller& caller) {
  static_cast<void>(mailbox_.post([this, name = caller.client_name] { loop_.commands().client_closed(name); }));
}

void Robot::lost(const api::Caller& caller, const std::string& why) {
  static_cast<void>(mailbox_.post([this, name = caller.client_name, why] {
    loop_.commands().client_lost(name, why, std::chrono::steady_clock::now());
  }));
}

}  // namespace seeker::app
