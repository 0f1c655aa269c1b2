/// \file
/// An operator who has a robot start, pause and stop missions, keep maps and stand still, without a rest.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/core/rng.hpp"
#include "common/image/png.hpp"
#include "common/rpc/wait.hpp"
#include "tests/integration/processes/daemon.hpp"
#include "tests/integration/processes/told_ledger.hpp"

namespace seeker::testing {

/// Asks for one thing after the other on a thread of its own, until the link breaks.
class BusyOperator {
 public:
  BusyOperator(const Daemon& daemon, std::uint64_t seed, ToldLedger& ledger)
      : ledger_(ledger), rng_(seed), prefix_("m" + std::to_string(seed) + "-"), client_(connect_once(daemon)) {
    auto subscription = client_->subscribe(
        {{.topic = api::Topic::kMission}, {.topic = api::Topic::kEvent}, {.topic = api::Topic::kDetection}},
        [this](const api::UpdatePtr& update) { ledger_.take(update); });
    EXPECT_TRUE(subscription);
    subscription_ = std::move(*subscription);
    thread_ = std::thread([this] { work(); });
  }
  BusyOperator(const BusyOperator&) = delete;
  BusyOperator& operator=(const BusyOperator&) = delete;
  ~BusyOperator() { finish(); }

  /// Waits until it has noticed that the robot is gone.
  void finish() {
    if (thread_.joinable()) {
      thread_.join();
    }
  }

 private:
  static std::shared_ptr<rpc::RobotClient> connect_once(const Daemon& daemon) {
    rpc::ClientParams params;
    params.client_name = "operator";
    params.reconnect.enabled = false;
    auto client = rpc::RobotClient::connect(rpc::parse_endpoint(daemon.address()).value(), params);
    EXPECT_TRUE(client) << client.error().message;
    return client.value();
  }

  void work() {
    using Step = void (BusyOperator::*)();
    // What is named more often happens more often.
    constexpr std::array<Step, 13> kSteps{
        &BusyOperator::start,  &BusyOperator::start,  &BusyOperator::start, &BusyOperator::save,   &BusyOperator::save,
        &BusyOperator::upload, &BusyOperator::upload, &BusyOperator::pause, &BusyOperator::resume, &BusyOperator::stop,
        &BusyOperator::estop,  &BusyOperator::estop,  &BusyOperator::remove};
    while (linked_) {
      (this->*kSteps[rng_.below(kSteps.size())])();
    }
  }

  /// True when it was acknowledged; nothing when nobody knows.
  template <class T>
  std::optional<bool> ask(const std::function<void(api::Reply<T>)>& call, Result<T>* answer = nullptr) {
    Result<T> result = rpc::wait<T>(call, kCall);
    const bool unknown = !result && (result.error().code == Errc::kLinkLost || result.error().code == Errc::kTimeout ||
                                     result.error().code == Errc::kCancelled);
    linked_ = linked_ && !unknown;
    const bool done = result.has_value();
    if (answer != nullptr) {
      *answer = std::move(result);
    }
    return unknown ? std::nullopt : std::optional(done);
  }

  void start() {
    api::MissionRequest request;
    request.id = prefix_ + std::to_string(++missions_);
    request.link_policy = api::LinkPolicy::kContinue;
    if (rng_.below(2) == 0) {
      api::ExploreMission exploration;
      exploration.strategy = api::ExploreStrategy::kFrontier;
      request.task = exploration;
    } else {
      api::TargetSpec cross;
      cross.name = "cross";
      cross.picture = image::read_png(source_file("config/targets/cross.png")).value();
      api::SearchMission search;
      search.targets = {cross};
      request.task = search;
    }
    ledger_.asked_to_start(request.id);
    const auto started = ask<api::MissionAccepted>([&](auto reply) { client_->start_mission(request, reply); });
    if (started && *started) {
      ledger_.started(request.id);
      running_ = request.id;
    } else if (started) {
      ledger_.not_started(request.id);
    }
  }
  void stop() {
    const auto stopped = ask<void>([&](auto reply) { client_->stop(reply); });
    if (stopped && *stopped && !running_.empty()) {
      ledger_.stopped(running_);
    }
  }
  void pause() {
    ask<void>([&](auto reply) { client_->command_mission(api::MissionCommand::kPause, reply); });
  }
  void resume() {
    ask<void>([&](auto reply) { client_->command_mission(api::MissionCommand::kResume, reply); });
  }
  void estop() {
    const bool engaged = rng_.below(3) == 0;
    const Known before = ledger_.estop();
    ledger_.set_estop(Known::kInDoubt);
    const auto done = ask<void>([&](auto reply) { client_->set_estop(engaged, reply); });
    if (done) {
      ledger_.set_estop(!*done ? before : engaged ? Known::kYes : Known::kNo);
    }
  }

  std::string any_name() { return "map-" + std::to_string(rng_.below(4)); }
  void save() {
    const std::string name = any_name();
    keep_map(name, [&](auto reply) { client_->save_map(name, true, reply); });
    Result<std::vector<std::uint8_t>> bytes;
    if (const auto got =
            ask<std::vector<std::uint8_t>>([&](auto reply) { client_->download_map(name, reply); }, &bytes);
        got && *got) {
      map_ = std::move(*bytes);
    }
  }
  void upload() {
    const std::string name = any_name();
    if (!map_.empty()) {
      keep_map(name, [&](auto reply) { client_->upload_map({name, map_, true, false}, reply); });
    }
  }
  /// A refusal leaves what there was.
  void keep_map(const std::string& name, const std::function<void(api::Reply<api::MapSummary>)>& call) {
    const Known before = ledger_.map(name);
    ledger_.set_map(name, Known::kInDoubt);
    if (const auto kept = ask<api::MapSummary>(call)) {
      ledger_.set_map(name, *kept ? Known::kYes : before);
    }
  }
  void remove() {
    const std::string name = any_name();
    const Known before = ledger_.map(name);
    ledger_.set_map(name, Known::kInDoubt);
    if (const auto removed = ask<void>([&](auto reply) { client_->delete_map(name, reply); })) {
      ledger_.set_map(name, *removed ? Known::kNo : before);
    }
  }

  ToldLedger& ledger_;
  Rng rng_;
  std::string prefix_;
  std::shared_ptr<rpc::RobotClient> client_;
  std::unique_ptr<api::Subscription> subscription_;
  bool linked_ = true;
  int missions_ = 0;
  std::string running_;
  std::vector<std::uint8_t> map_;
  std::thread thread_;
};

}  // namespace seeker::testing
