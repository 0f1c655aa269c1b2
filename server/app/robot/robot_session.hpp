/// \file
/// The robot as one client sees it. A part of robot.cpp.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/app/robot/robot.hpp"

namespace seeker::app {

/// One client's view: every call becomes a task of the loop's thread.
class Robot::Session final : public api::RobotApi, public std::enable_shared_from_this<Robot::Session> {
 public:
  Session(Robot& robot, api::Caller caller) : robot_(robot), caller_(std::move(caller)), client_(caller_.client_name) {}

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
  void start_mission(const api::MissionRequest& request, api::Reply<api::MissionAccepted> reply) override {
    if (!by_hash(request)) {
      start(request, unless_stopped(), std::move(reply));
      return;
    }
    robot_.transfers_.add_pictures(request, [self = shared_from_this(), wanted = unless_stopped(),
                                             reply = std::move(reply)](Result<api::MissionRequest> whole) {
      if (whole) {
        self->start(*whole, wanted, reply);
      } else {
        reply(tl::unexpected<Error>(whole.error()));
      }
    });
  }
  void command_mission(api::MissionCommand command, api::Reply<void> reply) override {
    if (command == api::MissionCommand::kResume) {
      robot_.checkpoints_.resume_mission(
          client_, unless_stopped(),
          [self = shared_from_this(), reply](const Status& done) { self->robot_.answer_kept(done, reply); });
      return;
    }
    ask_kept(std::move(reply), [this, command] { return loop().commands().command_mission(command, client_); });
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
    ++robot_.stops_;
    ask_kept(std::move(reply), [this] {
      loop().commands().stop();
      return Status();
    });
  }
  void set_estop(bool engaged, api::Reply<void> reply) override {
    robot_.stops_ += engaged ? 1 : 0;
    on_loop(std::move(reply), [this, engaged](const api::Reply<void>& answer) {
      loop().commands().set_estop(engaged, client_);
      robot_.keep_estop(engaged, answer);
    });
  }
  void command_lease(const api::LeaseCommand& command, api::Reply<api::LeaseState> reply) override {
    ask(std::move(reply), [this, command] {
      return loop().commands().command_lease(caller_, command, std::chrono::steady_clock::now());
    });
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
  void begin_upload(const api::FileOffer& offer, api::Reply<std::uint64_t> reply) override {
    robot_.transfers_.begin(offer, reply);
  }
  void upload_piece(const api::UploadPiece& piece, api::Reply<std::uint64_t> reply) override {
    robot_.transfers_.append(piece, reply);
  }
  void finish_upload(const api::UploadEnd& end, api::Reply<api::UploadedFile> reply) override {
    robot_.transfers_.finish(end, reply);
  }
  void read_file(const api::FileRead& wish, api::Reply<api::FilePiece> reply) override {
    robot_.transfers_.read(wish, reply);
  }
  void relocalise(const std::optional<Pose2>& map_T_base, api::Reply<void> reply) override {
    ask(std::move(reply), [this, map_T_base] { return loop().commands().relocalise(map_T_base); });
  }
  void get_diagnosis(api::Reply<std::vector<api::Finding>> reply) override {
    if (!robot_.diagnosis_) {
      reply(fail(Errc::kNotReady, "this robot does not check its machine; start it with seekerd"));
      return;
    }
    robot_.diagnosis_->ask(reply);
  }
  void get_audit(const api::AuditQuery& query, api::Reply<std::vector<api::AuditRecord>> reply) override {
    if (!robot_.audit_) {
      reply(fail(Errc::kNotReady, "this robot keeps no records of who commanded what; start it with seekerd"));
      return;
    }
    robot_.audit_->newest(query, reply);
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
  /// Call it when something is asked for: what was asked for before a stop must not begin after it. Any thread.
  [[nodiscard]] StillWanted unless_stopped() const {
    return [&robot = robot_, before = robot_.stops_.load()] {
      return robot.stops_.load() == before
                 ? Status()
                 : fail(Errc::kCancelled,
                        "the robot was stopped before the mission could begin; start or resume it again");
    };
  }
  /// Whether a target's picture is named by its hash.
  [[nodiscard]] static bool by_hash(const api::MissionRequest& request) {
    const auto named = [](const api::TargetSpec& target) { return target.picture_hash.has_value(); };
    return std::visit(
        [&](const auto& task) {
          if constexpr (requires { task.targets; }) {
            return std::any_of(task.targets.begin(), task.targets.end(), named);
          } else {
            return false;
          }
        },
        request.task);
  }
  void start(const api::MissionRequest& request, StillWanted still_wanted, api::Reply<api::MissionAccepted> reply) {
    on_loop(std::move(reply),
            [this, request, still_wanted = std::move(still_wanted)](const api::Reply<api::MissionAccepted>& answer) {
              if (const Status wanted = still_wanted(); !wanted) {
                answer(tl::unexpected<Error>(wanted.error()));
                return;
              }
              const bool again = loop().mission_control().runs(request.id);
              const Result<api::MissionId> id = loop().commands().start_mission(request, client_);
              if (!id) {
                answer(tl::unexpected<Error>(id.error()));
                return;
              }
              robot_.accept({*id, loop().missions().last()->link_steps}, again, answer);
            });
  }

  template <class T, class Work>
  void ask(api::Reply<T> reply, Work work) {
    on_loop(std::move(reply), [work = std::move(work)](const api::Reply<T>& answer) mutable { answer(work()); });
  }
  /// Answers when what the work has changed is on the disk, so that a kill after the answer does not undo it.
  template <class Work>
  void ask_kept(api::Reply<void> reply, Work work) {
    on_loop(std::move(reply), [this, work = std::move(work)](const api::Reply<void>& answer) mutable {
      robot_.answer_kept(work(), answer);
    });
  }
  /// Lets the loop's thread do work(reply).
  template <class T, class Work>
  void on_loop(api::Reply<T> reply, Work work) {
    const auto shared = std::make_shared<api::Reply<T>>(std::move(reply));
    // The task keeps the session alive: its client may be gone before the loop comes to it.
    if (!robot_.mailbox_.post(
            [shared, self = shared_from_this(), work = std::move(work)]() mutable { work(*shared); })) {
      (*shared)(fail(Errc::kBusy, "the robot is overloaded or shutting down; try again"));
    }
  }

  Robot& robot_;
  api::Caller caller_;
  std::string client_;
};

}  // namespace seeker::app
