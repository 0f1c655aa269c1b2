/// \file
/// The loop's collaborators around fake devices, without the loop: for tests of those that need many others.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/app/loop/map_commands.hpp"
#include "server/app/loop/mission_control.hpp"
#include "tests/unit/server/app/loop/fake_robot.hpp"

namespace seeker::app::testing {

/// Stands until a test says that it is done.
class StandStill final : public Behaviour {
 public:
  Decision step(const Situation& /*situation*/) override { return {}; }
};

struct FakeDeck {
  FakeDeck() {
    for (const char* name : {"base", "lidar"}) {
      diagnostics.components().add(name, "driver", "fake", {});
    }
    diagnostics.components().add("pose", "estimator", "fake", {});
    diagnostics.components().activate_all();
    estimator->pose.quality = LocalisationQuality::kLocalised;
    hooks.on_event = [this](const api::Event& event) { events.push_back(event); };
  }
  FakeDeck(const FakeDeck&) = delete;
  FakeDeck& operator=(const FakeDeck&) = delete;

  /// One period passes: the devices are read and the pose is taken.
  std::optional<MapShift> tick() {
    clock->time += std::chrono::milliseconds(100);
    sensing.read();
    return localiser.localise(sensing, neighbours, clock->time);
  }
  [[nodiscard]] Devices devices() const {
    Devices all;
    all.type = "fake";
    all.clock = clock;
    all.base = base;
    all.lidar = lidar;
    return all;
  }
  [[nodiscard]] MissionOutputs outputs() {
    return {.event = [this](const api::Event& event) { mission_events.push_back(event.kind); },
            .status = [](const api::MissionStatus&) {},
            .detection = [](const api::Detection&) {},
            .begun =
                [this](const api::MissionRequest& request) {
                  if (hooks.on_mission_started) {
                    hooks.on_mission_started(request);
                  }
                }};
  }
  [[nodiscard]] static Result<std::unique_ptr<Behaviour>> stand_still(const api::MissionTask& /*task*/,
                                                                      const Situation& /*situation*/) {
    return Result<std::unique_ptr<Behaviour>>(std::make_unique<StandStill>());
  }

  std::shared_ptr<HandClock> clock = std::make_shared<HandClock>();
  std::shared_ptr<FakeBase> base = std::make_shared<FakeBase>();
  std::shared_ptr<FakeLidar> lidar = std::make_shared<FakeLidar>();
  UpdateHub hub;
  LoopHooks hooks;
  std::vector<api::Event> events;
  std::vector<std::string> mission_events;  ///< their kinds
  LoopParams params;
  Diagnostics diagnostics{clock, hub, hooks};
  WorldLink world{clock, "fake", std::chrono::milliseconds(100), std::chrono::seconds(10), diagnostics};
  Sensing sensing{params, devices(), world, diagnostics};
  Neighbours neighbours{params.fleet, params.robot_id};
  FakeEstimator* estimator = new FakeEstimator;  ///< owned by the localiser
  Localiser localiser{params, nav::OccupancyParams{}, std::unique_ptr<Estimator>(estimator), diagnostics};
  SituationSource situation{world, sensing, localiser, neighbours, false};
  MotionControl motion{params.safety, params.odometry_calibration, base, sensing, situation, world, diagnostics};
  MissionExecutor executor{params.mission, &FakeDeck::stand_still, outputs()};
  MapCommands maps{{world, sensing, motion, localiser, neighbours, executor, diagnostics}, nullptr};
  MissionControl missions{params.map,
                          {executor, world, sensing, situation, localiser, maps, motion, diagnostics, hooks}};
};

inline api::MissionRequest go_to(const std::string& id) {
  api::MissionRequest request;
  request.id = id;
  request.task = api::GotoMission{.waypoints = {Point2(1, 0)}, .final_heading_rad = std::nullopt, .keep_out = {}};
  return request;
}

}  // namespace seeker::app::testing
