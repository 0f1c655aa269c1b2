#include "tests/support/fake_robot.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "tests/support/fake_answers.hpp"

namespace seeker::testing {

struct FakeRobotHost::Shared {
  struct Subscriber {
    std::vector<api::Topic> topics;
    api::UpdateSink sink;
  };

  std::mutex mutex;
  FakeRobotValues values = default_fake_values();
  bool hold = false;
  std::vector<std::function<void()>> held;
  /// Serialises deliveries, so that updates arrive in order and none arrives after the end of a subscription.
  std::recursive_mutex delivery;
  std::uint64_t next_subscriber = 1;
  std::map<std::uint64_t, Subscriber> subscribers;
  std::array<std::uint64_t, api::kTopicCount> sequences{};

  template <class T>
  void answer(const api::Reply<T>& reply, Result<T> result) {
    {
      const std::lock_guard lock(mutex);
      if (values.failure) {
        result = tl::unexpected<Error>(*values.failure);
      }
      if (hold) {
        held.emplace_back([reply, result] { reply(result); });
        return;
      }
    }
    reply(std::move(result));
  }
};

/// The robot as one caller sees it.
class FakeRobot final : public api::RobotApi {
 public:
  FakeRobot(std::shared_ptr<FakeRobotHost::Shared> shared, api::Caller caller)
      : shared_(std::move(shared)), caller_(std::move(caller)) {}

  void get_info(api::Reply<api::RobotInfo> reply) override {
    read<api::RobotInfo>("get_info", reply, [](const FakeRobotValues& v) { return v.info; });
  }
  void get_status(api::Reply<api::RobotStatus> reply) override {
    read<api::RobotStatus>("get_status", reply, [](const FakeRobotValues& v) {
      api::RobotStatus status = v.status;
      status.lease = v.lease;
      status.estop = v.estop;
      status.mission = v.mission;
      return status;
    });
  }
  void list_components(api::Reply<std::vector<api::ComponentInfo>> reply) override {
    read<std::vector<api::ComponentInfo>>("list_components", reply,
                                          [](const FakeRobotValues& v) { return v.components; });
  }
  void restart_component(const std::string& name, api::Reply<void> reply) override {
    change("restart_component " + name, reply,
           [&](FakeRobotValues& v) { return fake_component(v, name, [](api::ComponentInfo&) {}); });
  }
  void switch_component(const std::string& name, bool active, api::Reply<void> reply) override {
    change((active ? "activate " : "deactivate ") + name, reply, [&](FakeRobotValues& v) {
      return fake_component(v, name, [&](api::ComponentInfo& component) {
        component.state = active ? api::ComponentState::kActive : api::ComponentState::kInactive;
      });
    });
  }
  void exchange_component(const std::string& name, const std::string& type, api::Reply<void> reply) override {
    change("exchange " + name + " " + type, reply, [&](FakeRobotValues& v) {
      return fake_component(v, name, [&](api::ComponentInfo& component) { component.type = type; });
    });
  }
  void get_settings(const std::string& component, api::Reply<std::vector<api::ComponentSetting>> reply) override {
    read<std::vector<api::ComponentSetting>>("get_settings " + component, reply,
                                             [&](const FakeRobotValues& v) { return fake_settings(v, component); });
  }
  void set_settings(const std::string& component, const std::vector<std::string>& assignments,
                    api::Reply<std::vector<api::ComponentSetting>> reply) override {
    read<std::vector<api::ComponentSetting>>("set_settings " + component, reply, [&](FakeRobotValues& v) {
      return fake_set_settings(v, component, assignments);
    });
  }
  void start_mission(const api::MissionRequest& request, api::Reply<api::MissionAccepted> reply) override {
    read<api::MissionAccepted>("start_mission " + request.id, reply,
                               [&](FakeRobotValues& v) { return fake_start_mission(v, request); });
  }
  void command_mission(api::MissionCommand command, api::Reply<void> reply) override {
    change("command_mission", reply, [&](FakeRobotValues& v) -> Status {
      if (!v.mission || v.mission->end) {
        return fail(Errc::kNotFound, "no mission runs");
      }
      if (command == api::MissionCommand::kStop) {
        fake_end_mission(v);
      } else {
        v.mission->state =
            command == api::MissionCommand::kPause ? api::MissionState::kPaused : api::MissionState::kRunning;
      }
      return {};
    });
  }
  void get_mission(api::Reply<api::MissionStatus> reply) override {
    read<api::MissionStatus>("get_mission", reply, [](const FakeRobotValues& v) -> Result<api::MissionStatus> {
      if (!v.mission) {
        return fail(Errc::kNotFound, "there was no mission since the robot started");
      }
      return *v.mission;
    });
  }
  void stop(api::Reply<void> reply) override {
    change("stop", reply, [](FakeRobotValues& v) -> Status {
      if (v.mission && !v.mission->end) {
        fake_end_mission(v);
      }
      v.lease.epoch += v.lease.owner.empty() ? 0 : 1;  // commands that are on their way are void
      return {};
    });
  }
  void set_estop(bool engaged, api::Reply<void> reply) override {
    change(engaged ? "set_estop on" : "set_estop off", reply, [&](FakeRobotValues& v) -> Status {
      v.estop = engaged;
      return {};
    });
  }
  void command_lease(const api::LeaseCommand& command, api::Reply<api::LeaseState> reply) override {
    Result<api::LeaseState> result;
    {
      const std::lock_guard lock(shared_->mutex);
      shared_->values.calls.push_back(caller_.client_name + " command_lease");
      result = fake_lease(shared_->values.lease, command.action, caller_.client_name);
    }
    shared_->answer(reply, std::move(result));
  }
  void drive(const api::DriveCommand& command, api::Reply<void> reply) override {
    change("drive", reply, [&](FakeRobotValues& v) -> Status {
      if (v.lease.owner == caller_.client_name && v.lease.epoch != command.lease_epoch) {
        return fail(Errc::kRefused, "the robot was stopped while it was driven by hand; acquire the lease again");
      }
      if (v.lease.owner != caller_.client_name) {
        return fail(Errc::kRefused, "the lease belongs to '" + v.lease.owner + "'; acquire it first");
      }
      v.drives.push_back(command);
      if (v.on_drive) {
        v.on_drive(command);
      }
      return {};
    });
  }
  void get_tiles(std::uint64_t since_revision, api::Reply<api::TileUpdate> reply) override {
    read<api::TileUpdate>("get_tiles", reply, [&](const FakeRobotValues& v) {
      api::TileUpdate update = v.tiles;
      std::erase_if(update.tiles, [&](const OccupancyTile& tile) { return tile.revision <= since_revision; });
      return update;
    });
  }
  void get_grid(api::Reply<api::GridReport> reply) override {
    read<api::GridReport>("get_grid", reply, [](const FakeRobotValues& v) { return v.grid; });
  }
  void get_detections(api::Reply<std::vector<api::Detection>> reply) override {
    read<std::vector<api::Detection>>("get_detections", reply, [](const FakeRobotValues& v) { return v.detections; });
  }
  void get_trajectory(api::Reply<std::vector<api::StampedPose>> reply) override {
    read<std::vector<api::StampedPose>>("get_trajectory", reply, [](const FakeRobotValues& v) { return v.trajectory; });
  }
  void grab_image(const std::string& camera, api::Reply<api::ImageFrame> reply) override {
    read<api::ImageFrame>("grab_image " + camera, reply, [&](const FakeRobotValues& v) -> Result<api::ImageFrame> {
      const auto found = camera.empty() ? v.cameras.begin() : v.cameras.find(camera);
      if (found == v.cameras.end()) {
        return fail(Errc::kNotFound, "no camera '" + camera + "'");
      }
      return found->second;
    });
  }
  void get_segments(std::uint64_t since_revision, api::Reply<api::SegmentUpdate> reply) override {
    read<api::SegmentUpdate>("get_segments " + std::to_string(since_revision), reply,
                             [](const FakeRobotValues& v) -> Result<api::SegmentUpdate> {
                               return v.segments ? *v.segments : Result<api::SegmentUpdate>(no_map());
                             });
  }
  void save_map(const std::string& name, bool replace, api::Reply<api::MapSummary> reply) override {
    read<api::MapSummary>("save_map " + name, reply, [&](FakeRobotValues& v) -> Result<api::MapSummary> {
      if (!v.segments) {
        return no_map();
      }
      if (fake_find_map(v, name) && !replace) {
        return fail(Errc::kRefused, "there is a map '" + name + "' already; take another name, or --replace it");
      }
      std::erase_if(v.maps, [&](const api::MapSummary& map) { return map.name == name; });
      v.maps.emplace_back().name = name;
      v.maps.back().segments = static_cast<std::uint32_t>(v.segments->changed.size());
      return v.maps.back();
    });
  }
  void load_map(const std::string& name, api::MapUse use, api::Reply<api::MapSummary> reply) override {
    read<api::MapSummary>("load_map " + name + " " + std::string(api::to_string(use)), reply,
                          [&](const FakeRobotValues& v) { return fake_find_map(v, name); });
  }
  void list_maps(api::Reply<std::vector<api::MapSummary>> reply) override {
    read<std::vector<api::MapSummary>>("list_maps", reply, [](const FakeRobotValues& v) { return v.maps; });
  }
  void inspect_map(const std::string& name, bool verify, api::Reply<api::MapSummary> reply) override {
    read<api::MapSummary>("inspect_map " + name + (verify ? " verify" : ""), reply,
                          [&](const FakeRobotValues& v) { return fake_find_map(v, name); });
  }
  void delete_map(const std::string& name, api::Reply<void> reply) override {
    change("delete_map " + name, reply, [&](FakeRobotValues& v) -> Status {
      const auto known = fake_find_map(v, name);
      std::erase_if(v.maps, [&](const api::MapSummary& map) { return map.name == name; });
      return known ? Status() : Status(tl::unexpected<Error>(known.error()));
    });
  }
  void download_map(const std::string& name, api::Reply<std::vector<std::uint8_t>> reply) override {
    read<std::vector<std::uint8_t>>(
        "download_map " + name, reply, [&](const FakeRobotValues& v) -> Result<std::vector<std::uint8_t>> {
          const auto found = v.map_files.find(name);
          return found != v.map_files.end() ? found->second : Result<std::vector<std::uint8_t>>(fake_no_such_map(name));
        });
  }
  void upload_map(const api::MapUpload& upload, api::Reply<api::MapSummary> reply) override {
    read<api::MapSummary>("upload_map " + upload.name, reply, [&](FakeRobotValues& v) {
      v.uploads.push_back(upload);
      api::MapSummary summary;
      summary.name = upload.name;
      summary.file_bytes = upload.bytes.size();
      return summary;
    });
  }
  void relocalise(const std::optional<Pose2>& map_T_base, api::Reply<void> reply) override {
    change("relocalise", reply, [&](FakeRobotValues& v) -> Status {
      v.relocalisations.push_back(map_T_base);
      return v.segments ? Status() : Status(no_map());
    });
  }
  void begin_upload(const api::FileOffer& offer, api::Reply<std::uint64_t> reply) override {
    read<std::uint64_t>("begin_upload", reply, [&](FakeRobotValues& v) { return fake_begin_upload(v, offer); });
  }
  void upload_piece(const api::UploadPiece& piece, api::Reply<std::uint64_t> reply) override {
    read<std::uint64_t>("upload_piece", reply, [&](FakeRobotValues& v) { return fake_upload_piece(v, piece); });
  }
  void finish_upload(const api::UploadEnd& end, api::Reply<api::UploadedFile> reply) override {
    read<api::UploadedFile>("finish_upload " + end.name, reply,
                            [&](FakeRobotValues& v) { return fake_finish_upload(v, end); });
  }
  void read_file(const api::FileRead& wish, api::Reply<api::FilePiece> reply) override {
    read<api::FilePiece>("read_file " + wish.name, reply,
                         [&](const FakeRobotValues& v) { return fake_read_file(v, wish); });
  }
  void list_landmarks(api::Reply<std::vector<api::LandmarkSummary>> reply) override {
    read<std::vector<api::LandmarkSummary>>("list_landmarks", reply, fake_list_landmarks);
  }
  void inspect_landmarks(const std::string& name, bool verify, api::Reply<api::LandmarkSummary> reply) override {
    read<api::LandmarkSummary>("inspect_landmarks " + name + (verify ? " verify" : ""), reply,
                               [&](const FakeRobotValues& v) { return fake_inspect_landmarks(v, name); });
  }
  void get_landmarks(const std::string& name, api::Reply<std::vector<api::LandmarkPoint>> reply) override {
    read<std::vector<api::LandmarkPoint>>("get_landmarks " + name, reply,
                                          [&](const FakeRobotValues& v) { return fake_landmarks(v, name); });
  }
  void prune_landmarks(const std::string& name, int min_views, api::Reply<api::LandmarkSummary> reply) override {
    read<api::LandmarkSummary>("prune_landmarks " + name + " " + std::to_string(min_views), reply,
                               [&](FakeRobotValues& v) { return fake_prune_landmarks(v, name, min_views); });
  }
  void revert_landmarks(const std::string& name, api::Reply<api::LandmarkSummary> reply) override {
    read<api::LandmarkSummary>("revert_landmarks " + name, reply,
                               [&](FakeRobotValues& v) { return fake_revert_landmarks(v, name); });
  }
  void delete_landmarks(const std::string& name, api::Reply<void> reply) override {
    change("delete_landmarks " + name, reply, [&](FakeRobotValues& v) {
      const auto known = fake_landmarks(v, name);
      v.landmarks.erase(name);
      return known ? Status() : Status(tl::unexpected<Error>(known.error()));
    });
  }
  void get_diagnosis(api::Reply<std::vector<api::Finding>> reply) override {
    read<std::vector<api::Finding>>("get_diagnosis", reply, [](const FakeRobotValues& v) {
      return v.diagnosis ? Result<std::vector<api::Finding>>(*v.diagnosis)
                         : fail(Errc::kNotReady, "this robot does not check its machine");
    });
  }
  void get_audit(const api::AuditQuery& query, api::Reply<std::vector<api::AuditRecord>> reply) override {
    read<std::vector<api::AuditRecord>>("get_audit", reply, [&](FakeRobotValues& v) {
      v.audit_queries.push_back(query);
      return v.audit ? Result<std::vector<api::AuditRecord>>(*v.audit)
                     : fail(Errc::kNotReady, "this robot keeps no records");
    });
  }
  Result<std::unique_ptr<api::Subscription>> subscribe(const std::vector<api::TopicRequest>& topics,
                                                       api::UpdateSink sink) override;

 private:
  template <class T, class Read>
  void read(const std::string& call, const api::Reply<T>& reply, Read&& make) {
    Result<T> result;
    {
      const std::lock_guard lock(shared_->mutex);
      shared_->values.calls.push_back(caller_.client_name + " " + call);
      result = make(shared_->values);
    }
    shared_->answer(reply, std::move(result));
  }
  template <class Change>
  void change(const std::string& call, const api::Reply<void>& reply, Change&& apply) {
    Status result;
    {
      const std::lock_guard lock(shared_->mutex);
      shared_->values.calls.push_back(caller_.client_name + " " + call);
      result = apply(shared_->values);
    }
    shared_->answer(reply, std::move(result));
  }
  static tl::unexpected<Error> no_map() {
    return fail(Errc::kNotReady, "the estimator keeps no map of segments; start the robot with estimator: line_slam");
  }

  std::shared_ptr<FakeRobotHost::Shared> shared_;
  api::Caller caller_;
};

namespace {

class FakeSubscription final : public api::Subscription {
 public:
  explicit FakeSubscription(std::function<void()> end) : end_(std::move(end)) {}
  FakeSubscription(const FakeSubscription&) = delete;
  FakeSubscription& operator=(const FakeSubscription&) = delete;
  ~FakeSubscription() override { end_(); }

 private:
  std::function<void()> end_;
};

}  // namespace

Result<std::unique_ptr<api::Subscription>> FakeRobot::subscribe(const std::vector<api::TopicRequest>& topics,
                                                                api::UpdateSink sink) {
  const std::lock_guard lock(shared_->delivery);
  const std::uint64_t id = shared_->next_subscriber++;
  auto& subscriber = shared_->subscribers[id];
  for (const api::TopicRequest& request : topics) {
    subscriber.topics.push_back(request.topic);
  }
  subscriber.sink = std::move(sink);
  return std::make_unique<FakeSubscription>([shared = shared_, id] {
    const std::lock_guard ending(shared->delivery);
    shared->subscribers.erase(id);
  });
}

FakeRobotHost::FakeRobotHost() : shared_(std::make_shared<Shared>()) {}
FakeRobotHost::~FakeRobotHost() = default;

std::shared_ptr<api::RobotApi> FakeRobotHost::open(const api::Caller& caller) {
  const std::lock_guard lock(shared_->mutex);
  shared_->values.opened.push_back(caller);
  return std::make_shared<FakeRobot>(shared_, caller);
}

void FakeRobotHost::closed(const api::Caller& caller) {
  const std::lock_guard lock(shared_->mutex);
  shared_->values.closed.push_back(caller);
}

void FakeRobotHost::lost(const api::Caller& caller, const std::string& why) {
  const std::lock_guard lock(shared_->mutex);
  shared_->values.lost.emplace_back(caller, why);
}

FakeRobotValues FakeRobotHost::values() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->values;
}

void FakeRobotHost::edit(const std::function<void(FakeRobotValues&)>& change) {
  const std::lock_guard lock(shared_->mutex);
  change(shared_->values);
}

void FakeRobotHost::publish(api::Topic topic, RobotTime stamp, api::Payload payload) {
  const std::lock_guard lock(shared_->delivery);
  auto update = std::make_shared<api::Update>();
  update->topic = topic;
  update->sequence = ++shared_->sequences[static_cast<std::size_t>(topic)];
  update->stamp = stamp;
  update->payload = std::move(payload);
  for (const auto& [id, subscriber] : shared_->subscribers) {
    if (std::find(subscriber.topics.begin(), subscriber.topics.end(), topic) != subscriber.topics.end()) {
      subscriber.sink(update);
    }
  }
}

void FakeRobotHost::hold_replies(bool hold) {
  const std::lock_guard lock(shared_->mutex);
  shared_->hold = hold;
}

void FakeRobotHost::release_replies() {
  std::vector<std::function<void()>> held;
  {
    const std::lock_guard lock(shared_->mutex);
    held.swap(shared_->held);
  }
  for (const auto& reply : held) {
    reply();
  }
}

}  // namespace seeker::testing
