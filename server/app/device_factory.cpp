#include "server/app/device_factory.hpp"

#include "common/core/rng.hpp"
#include "server/app/estimators.hpp"
#include "server/app/explore_behaviour.hpp"
#include "server/app/tracker_estimator.hpp"
#include "server/drivers/replay/replay.hpp"
#include "server/options/world_options.hpp"
#include "server/sim/placement.hpp"

namespace seeker::app {
namespace {

Status make_sim(const RobotOptions& options, Assembly& assembly) {
  const SimSettings& settings = options.sim;
  Result<sim::World> world = options::load_world(resolve(options, settings.world));
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  world->people_walk = settings.people;
  if (settings.random_target && !world->targets.empty()) {
    // Its own stream: the world does not change what the sensors draw.
    Rng rng = Rng(settings.seed).fork("target-placement");
    if (const Result<Pose2> placed = sim::place_target(*world, 0, rng); !placed) {
      return fail_with_context("sim.random_target", placed.error());
    }
  }
  Result<drivers::SimDevices> devices =
      drivers::make_sim_devices(std::move(*world), settings.robot, settings.seed, settings.speed, settings.devices,
                                static_cast<std::size_t>(settings.start));
  if (!devices) {
    return fail_with_context("sim", devices.error());
  }
  assembly.simulation = devices->simulation;
  assembly.faults = devices->faults;
  Devices& out = assembly.parts.devices;
  out.type = "sim";
  out.base = std::move(devices->base);
  out.lidar = std::move(devices->lidar);
  out.sonar = std::move(devices->sonar);
  out.camera = std::move(devices->camera);
  out.clock = std::move(devices->clock);
  return {};
}

Status make_replay(const RobotOptions& options, Assembly& assembly) {
  if (options.replay.log.empty()) {
    return fail(Errc::kInvalidArgument, "replay.log is empty; name a log with --set replay.log=FILE");
  }
  const Result<std::shared_ptr<drivers::ReplaySource>> source =
      drivers::ReplaySource::open(resolve(options, options.replay.log), options.replay.params);
  if (!source) {
    return tl::unexpected<Error>(source.error());
  }
  Devices& out = assembly.parts.devices;
  out.type = "replay";
  out.base = std::make_shared<drivers::ReplayBase>(*source);
  out.lidar = std::make_shared<drivers::ReplayLidar>(*source);
  out.clock = std::make_shared<drivers::ReplayClock>(*source, options.replay.speed);
  out.runs_without_mission = true;
  out.summary = [log = *source] { return drivers::describe(log->summary()); };
  return {};
}

/// Makes behaviours; holds what they share over missions.
class Behaviours {
 public:
  Behaviours(const RobotOptions& options, std::shared_ptr<const search::ControlTable> table, bool has_camera)
      : go_(options.go),
        search_(options.search),
        explore_(options.explore),
        table_(std::move(table)),
        has_camera_(has_camera) {}

  Result<std::unique_ptr<Behaviour>> operator()(const api::MissionTask& task, const Situation& situation) {
    if (const auto* go = std::get_if<api::GotoMission>(&task)) {
      return std::unique_ptr<Behaviour>(std::make_unique<GotoBehaviour>(go_, *go));
    }
    if (std::holds_alternative<api::ReturnMission>(task)) {
      // The map begins where the robot was started.
      api::GotoMission home;
      home.waypoints = {Point2::Zero()};
      return std::unique_ptr<Behaviour>(std::make_unique<GotoBehaviour>(go_, home));
    }
    if (const auto* explore = std::get_if<api::ExploreMission>(&task)) {
      return ExploreBehaviour::create(explore_, *explore, situation);
    }
    if (!has_camera_) {
      return fail(Errc::kRefused, "this robot has no camera to search with");
    }
    return search(std::get<api::SearchMission>(task), situation);
  }

  [[nodiscard]] const EvidenceMemory& memory() const { return memory_; }

 private:
  [[nodiscard]] Result<std::unique_ptr<Behaviour>> search(const api::SearchMission& mission,
                                                          const Situation& situation) const {
    std::unique_ptr<MapViewFinder> views;
    if (mission.explore) {
      if (const Status grows = check_map_grows(situation); !grows) {
        return tl::unexpected<Error>(grows.error());
      }
      views = std::make_unique<MapViewFinder>(explore_, nav::ForbiddenAreas{mission.bound, mission.keep_out});
    }
    return SearchBehaviour::create(search_, mission, table_, memory_, std::move(views));
  }

  GotoParams go_;
  SearchBehaviourParams search_;
  explore::ExploreParams explore_;
  std::shared_ptr<const search::ControlTable> table_;
  bool has_camera_;
  EvidenceMemory memory_ = std::make_shared<std::optional<search::EvidenceGrid>>();
};

}  // namespace

Result<Assembly> assemble(const RobotOptions& options) {
  Assembly assembly;
  const Status made = options.driver == DriverType::kSim ? make_sim(options, assembly) : make_replay(options, assembly);
  if (!made) {
    return tl::unexpected<Error>(made.error());
  }
  if (const Status ok = search::validate(options.search.search); !ok) {
    return fail_with_context("search.coverage", ok.error());
  }
  if (const Status ok = explore::validate(options.explore); !ok) {
    return fail_with_context("explore", ok.error());
  }
  Result<search::ControlTable> table = search::ControlTable::create(options.control_table);
  if (!table) {
    return fail_with_context("control_table", table.error());
  }
  LoopParts& parts = assembly.parts;
  parts.estimator = std::make_unique<TrackerEstimator>(make_tracker(options.estimator, options));
  parts.estimator_type = to_string(options.estimator);
  parts.occupancy = options.occupancy;
  Behaviours behaviours(options, std::make_shared<const search::ControlTable>(std::move(*table)),
                        parts.devices.camera != nullptr);
  parts.forget_places = [memory = behaviours.memory()] { memory->reset(); };
  parts.behaviours = std::move(behaviours);
  return assembly;
}

}  // namespace seeker::app
