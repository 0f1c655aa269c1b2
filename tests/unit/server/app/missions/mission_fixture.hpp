/// \file
/// An executor whose missions do what the test says.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {

/// A behaviour whose next decision the test writes.
struct Script {
  Decision next;
  int steps = 0;
  int resumed = 0;
  std::optional<Pose2> moved;
  std::optional<api::GridReport> grid;
  std::optional<SearchedFloor> searched;
  std::vector<api::Detection> detections;
  Point2 asked_about = Point2::Zero();  ///< for what it has searched
  std::optional<Duration> time_left;
  std::optional<Point2> start;
  std::optional<api::MissionEnd> pending;
};

class ScriptedBehaviour final : public Behaviour {
 public:
  explicit ScriptedBehaviour(std::shared_ptr<Script> script) : script_(std::move(script)) {}
  Decision step(const Situation& situation) override {
    ++script_->steps;
    script_->time_left = situation.time_left;
    return script_->next;
  }
  void resumed(RobotTime /*now*/) override { ++script_->resumed; }
  void map_moved(const MapMove& move) override { script_->moved = move.at({}); }
  std::optional<api::MissionEnd> pending_end() const override { return script_->pending; }
  void remember_start(const Point2& start_map) override { script_->start = start_map; }
  std::optional<api::GridReport> grid() const override { return script_->grid; }
  std::optional<SearchedFloor> searched(const Point2& middle_map, int /*side_cells*/) const override {
    script_->asked_about = middle_map;
    return script_->searched;
  }
  std::vector<api::Detection> detections() const override { return script_->detections; }

 private:
  std::shared_ptr<Script> script_;
};

class MissionFixture : public ::testing::Test {
 protected:
  MissionFixture()
      : executor(
            {},
            [this](const api::MissionTask& task, const Situation& /*situation*/) -> Result<std::unique_ptr<Behaviour>> {
              made.emplace_back(api::task_name(task));
              made_last = task;
              return std::unique_ptr<Behaviour>(std::make_unique<ScriptedBehaviour>(script));
            },
            {.event = [this](const api::Event& event) { events.push_back(event); },
             .status = [this](const api::MissionStatus& status) { reports.push_back(status); },
             .detection = [this](const api::Detection& detection) { told.push_back(detection); }}) {
    situation.pose.quality = LocalisationQuality::kLocalised;
  }

  static api::MissionRequest request(const std::string& id, api::LinkPolicy policy = api::LinkPolicy::kStop) {
    api::MissionRequest r;
    r.id = id;
    r.task = api::GotoMission{.waypoints = {Point2(1, 0)}, .final_heading_rad = std::nullopt, .keep_out = {}};
    r.link_policy = policy;
    return r;
  }

  Decision tick(double dt_s = 0.1, const api::Fault* blocking = nullptr) {
    situation.now += seeker::seconds(dt_s);
    wall += std::chrono::milliseconds(100);
    return executor.step(situation, blocking, wall);
  }

  api::MissionEnd end() const { return executor.last()->end.value_or(api::MissionEnd{}); }

  std::shared_ptr<Script> script = std::make_shared<Script>();
  std::vector<std::string> made;
  api::MissionTask made_last;
  std::vector<api::Event> events;
  std::vector<api::MissionStatus> reports;
  std::vector<api::Detection> told;
  Situation situation;
  WallTime wall;
  MissionExecutor executor;
};

}  // namespace seeker::app
