#include "server/app/composition/device_factory.hpp"

#include "common/core/rng.hpp"
#include "common/rpc/endpoint.hpp"
#include "server/app/composition/estimators.hpp"
#include "server/app/estimators/tracker_estimator.hpp"
#include "server/app/missions/explore_behaviour.hpp"
#include "server/app/missions/localise_behaviour.hpp"
#include "server/app/missions/recognise_behaviour.hpp"
#include "server/drivers/emulator/emulator_devices.hpp"
#include "server/drivers/replay/replay.hpp"
#include "server/options/world_options.hpp"
#include "server/sim/placement.hpp"

namespace seeker::app {
namespace {

/// The world that the robot file names, its target placed.
Result<sim::World> sim_world(const RobotOptions& options) {
  const SimSettings& settings = options.sim;
  Result<sim::World> world = options::load_world(resolve(options, settings.world));
  if (!world) {
    return fail_with_context("sim.world", world.error());
  }
  world->people_walk = world->people_walk || settings.people;
  if (settings.random_target && !world->targets.empty()) {
    // Its own stream: the world does not change what the sensors draw.
    Rng rng = Rng(settings.seed).fork("target-placement");
    if (const Result<Pose2> placed = sim::place_target(*world, 0, rng); !placed) {
      return fail_with_context("sim.random_target", placed.error());
    }
  }
  return world;
}

template <class Parts>
void take_devices(Parts& parts, const char* type, Devices& out) {
  out.type = type;
  out.base = std::move(parts.base);
  out.lidar = std::move(parts.lidar);
  out.sonar = std::move(parts.sonar);
  out.camera = std::move(parts.camera);
  out.stereo = std::move(parts.stereo);
  out.clock = std::move(parts.clock);
}

void use_sim(drivers::SimDevices devices, Assembly& assembly) {
  assembly.simulation = devices.simulation;
  assembly.faults = devices.faults;
  take_devices(devices, "sim", assembly.parts.devices);
  if (assembly.simulation->model().camera == sim::CameraKind::kTank) {
    assembly.parts.devices.camera_name = "tank";
  }
}

Result<drivers::SharedDevices> sim_devices(std::span<const RobotOptions> robots) {
  Result<sim::World> world = sim_world(robots.front());
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  std::vector<sim::RobotPlace> places;
  places.reserve(robots.size());
  for (const RobotOptions& robot : robots) {
    places.push_back({robot.sim.robot, robot.sim.seed, static_cast<std::size_t>(robot.sim.start)});
  }
  const SimSettings& common = robots.front().sim;
  Result<drivers::SharedDevices> devices =
      drivers::make_shared_devices(std::move(*world), std::move(places), common.speed, common.devices);
  return devices ? std::move(devices) : fail_with_context("sim", devices.error());
}

Status make_sim(const RobotOptions& options, Assembly& assembly) {
  Result<drivers::SharedDevices> devices = sim_devices({&options, 1});
  if (!devices) {
    return tl::unexpected<Error>(devices.error());
  }
  use_sim(std::move(devices->robots.front()), assembly);
  return {};
}

Status make_emulator(const RobotOptions& options, Assembly& assembly) {
  Result<rpc::Endpoint> endpoint = rpc::parse_endpoint(options.emulator.address);
  if (!endpoint) {
    return fail_with_context("emulator.address", endpoint.error());
  }
  drivers::EmulatorParams params;
  params.host = endpoint->host;
  params.port = endpoint->port;
  params.robot = static_cast<std::uint32_t>(options.emulator.robot);
  const Result<std::shared_ptr<drivers::EmulatorLink>> link = drivers::EmulatorLink::connect(params);
  if (!link) {
    return tl::unexpected<Error>(link.error());
  }
  drivers::EmulatorDevices devices = drivers::make_emulator_devices(*link);
  take_devices(devices, "emulator", assembly.parts.devices);
  return {};
}

/// A real stereo camera instead of the simulated one.
Status use_camera(const RobotOptions& options, Devices& devices) {
  if (!options.stereo.camera) {
    return {};
  }
  drivers::StereoCameraParams params = *options.stereo.camera;
  if (!params.calibration.empty()) {
    params.calibration = resolve(options, params.calibration.string());
  }
  if (!params.files.folder.empty()) {
    params.files.folder = resolve(options, params.files.folder.string());
  }
  Result<std::unique_ptr<drivers::StereoDriver>> camera =
      drivers::make_stereo_camera(params, [clock = devices.clock] { return clock->now(); });
  if (!camera) {
    return fail_with_context("stereo.camera", camera.error());
  }
  devices.stereo = std::move(*camera);
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

Status validate(const StereoSettings& settings) {
  if (Status ok = vision::validate(settings.features); !ok) {
    return fail_with_context("features", ok.error());
  }
  if (Status ok = localize::validate(settings.database); !ok) {
    return fail_with_context("database", ok.error());
  }
  if (Status ok = localize::validate(settings.estimator.update); !ok) {
    return fail_with_context("estimator.update", ok.error());
  }
  const Status ok = localize::validate(settings.localiser);
  return ok ? ok : fail_with_context("localiser", ok.error());
}

Result<std::unique_ptr<Estimator>> make_estimator(const RobotOptions& options, const Assembly& assembly) {
  if (is_tracker(options.estimator)) {
    return std::unique_ptr<Estimator>(std::make_unique<TrackerEstimator>(make_tracker(options.estimator, options)));
  }
  if (assembly.parts.devices.stereo == nullptr) {
    return fail(Errc::kInvalidArgument, "estimator landmarks needs a stereo camera, and this robot has none");
  }
  const LandmarkEstimatorParams& params = options.stereo.estimator;
  if (const Status ok = validate_map_name(params.database); !ok) {
    return fail(Errc::kInvalidArgument,
                "estimator landmarks needs the name of a database; give it with --set stereo.estimator.database=NAME");
  }
  const Result<LoadedLandmarks> loaded = assembly.landmarks.library->load(params.database);
  if (!loaded) {
    return tl::unexpected<Error>(loaded.error());
  }
  Result<localize::StereoLocaliser> localiser = localize::StereoLocaliser::create(
      assembly.parts.devices.stereo->geometry(), loaded->database, options.stereo.localiser);
  if (!localiser) {
    return fail_with_context("database '" + params.database + "'", localiser.error());
  }
  return std::unique_ptr<Estimator>(
      std::make_unique<LandmarkEstimator>(std::move(*localiser), loaded->database, params,
                                          LandmarkUpdating{.library = assembly.landmarks.library,
                                                           .geometry = assembly.parts.devices.stereo->geometry(),
                                                           .inline_work = assembly.parts.devices.clock->lockstep()},
                                          Rng(options.sim.seed).fork("landmark-estimator")));
}

/// Makes the missions of a robot with a stereo camera.
class StereoMissions {
 public:
  StereoMissions(const RobotOptions& options, const Devices& devices, LandmarkUse landmarks)
      : localiser_(options.stereo.localiser), landmarks_(std::move(landmarks)) {
    settings_.params = options.stereo.survey;
    settings_.go = options.go;
    settings_.geometry = devices.stereo->geometry();
    settings_.database = options.stereo.database;
    settings_.arm = localiser_.arm;
    settings_.eye_height_m = localiser_.eye_height_m;
    settings_.inline_work = devices.clock->lockstep();
  }

  [[nodiscard]] Result<std::unique_ptr<Behaviour>> survey(const api::SurveyMission& mission,
                                                          const Situation& situation) const {
    return SurveyBehaviour::create(settings_, mission, landmarks_.library, situation);
  }
  [[nodiscard]] Result<std::unique_ptr<Behaviour>> localise(const api::LocaliseMission& mission,
                                                            const Situation& situation) const {
    return LocaliseBehaviour::create({.look = settings_.params.look,
                                      .geometry = settings_.geometry,
                                      .localiser = localiser_,
                                      .estimator_database = landmarks_.in_use},
                                     mission, *landmarks_.library, situation);
  }

 private:
  SurveySettings settings_;
  localize::LocaliserParams localiser_;
  LandmarkUse landmarks_;
};

/// Makes behaviours; holds what they share over missions.
class Behaviours {
 public:
  Behaviours(const RobotOptions& options, SearchTools tools, bool has_camera, std::optional<StereoMissions> stereo)
      : go_(options.go),
        search_(options.search),
        explore_{options.explore, options.topology},
        tools_(std::move(tools)),
        has_camera_(has_camera),
        stereo_(std::move(stereo)) {}

  Result<std::unique_ptr<Behaviour>> operator()(const api::MissionTask& task, const Situation& situation) {
    if (const auto* go = std::get_if<api::GotoMission>(&task)) {
      return std::unique_ptr<Behaviour>(std::make_unique<GotoBehaviour>(go_, *go));
    }
    if (const auto* home = std::get_if<api::ReturnMission>(&task)) {
      return way_home(*home);
    }
    if (const auto* explore = std::get_if<api::ExploreMission>(&task)) {
      return ExploreBehaviour::create(explore_, *explore, situation);
    }
    if (const auto* survey = std::get_if<api::SurveyMission>(&task)) {
      return stereo_ ? stereo_->survey(*survey, situation) : no_stereo();
    }
    if (const auto* localise = std::get_if<api::LocaliseMission>(&task)) {
      return stereo_ ? stereo_->localise(*localise, situation) : no_stereo();
    }
    if (!has_camera_) {
      return fail(Errc::kRefused, "this robot has no camera to search with");
    }
    if (const auto* recognise = std::get_if<api::RecogniseMission>(&task)) {
      return RecogniseBehaviour::create(search_, *recognise, tools_.solids.get(), situation);
    }
    return search(std::get<api::SearchMission>(task), situation);
  }

 private:
  static Result<std::unique_ptr<Behaviour>> no_stereo() {
    return fail(Errc::kRefused, "this robot has no stereo camera to find landmarks with");
  }
  [[nodiscard]] Result<std::unique_ptr<Behaviour>> way_home(const api::ReturnMission& mission) const {
    api::GotoMission home;
    home.waypoints = {Point2::Zero()};  // the map begins where the robot was started
    home.keep_out = mission.keep_out;
    GotoParams go = go_;
    go.cost_map.unknown_traversable = false;  // the robot came over floor that it has seen
    return std::unique_ptr<Behaviour>(std::make_unique<GotoBehaviour>(go, std::move(home), mission.bound));
  }
  [[nodiscard]] Result<std::unique_ptr<Behaviour>> search(const api::SearchMission& mission,
                                                          const Situation& situation) const {
    std::unique_ptr<MapViewFinder> views;
    if (mission.explore) {
      if (const Status grows = check_map_grows(situation); !grows) {
        return tl::unexpected<Error>(grows.error());
      }
      views = std::make_unique<MapViewFinder>(explore_.params, nav::ForbiddenAreas{mission.bound, mission.keep_out});
    }
    return SearchBehaviour::create(search_, mission, tools_, std::move(views));
  }

  GotoParams go_;
  SearchBehaviourParams search_;
  ExploreSettings explore_;
  SearchTools tools_;
  bool has_camera_;
  std::optional<StereoMissions> stereo_;
};

/// The evidence of other searches is forgotten with the map.
Result<SearchTools> make_search_tools(const RobotOptions& options) {
  Result<search::ControlTable> table = search::ControlTable::create(options.control_table);
  if (!table) {
    return fail_with_context("control_table", table.error());
  }
  Result<std::shared_ptr<const vision::SolidModel>> solids = load_solids(options);
  if (!solids) {
    return tl::unexpected<Error>(solids.error());
  }
  return SearchTools{std::make_shared<const search::ControlTable>(std::move(*table)),
                     std::make_shared<std::optional<search::EvidenceGrid>>(), std::move(*solids)};
}

Status make_devices(const RobotOptions& options, Assembly& assembly) {
  switch (options.driver) {
    case DriverType::kSim: return make_sim(options, assembly);
    case DriverType::kReplay: return make_replay(options, assembly);
    case DriverType::kEmulator: return make_emulator(options, assembly);
  }
  return fail(Errc::kInvalidArgument, "driver is not known");
}

/// Everything but the devices.
Result<Assembly> complete(const RobotOptions& options, LandmarkStorage landmarks, Assembly assembly) {
  assembly.landmarks.library = std::make_shared<LandmarkLibrary>(std::move(landmarks));
  if (const Status ok = use_camera(options, assembly.parts.devices); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (const Status ok = search::validate(options.search.search); !ok) {
    return fail_with_context("search.coverage", ok.error());
  }
  if (const Status ok = explore::validate(options.explore); !ok) {
    return fail_with_context("explore", ok.error());
  }
  if (const Status ok = fleet::validate(options.topology); !ok) {
    return fail_with_context("topology", ok.error());
  }
  const Result<SearchTools> tools = make_search_tools(options);
  if (!tools) {
    return tl::unexpected<Error>(tools.error());
  }
  LoopParts& parts = assembly.parts;
  std::optional<StereoMissions> stereo;
  if (parts.devices.stereo != nullptr) {
    if (const Status ok = validate(options.stereo); !ok) {
      return fail_with_context("stereo", ok.error());
    }
    parts.stereo = vision::make_stereo_extractor(parts.devices.stereo->geometry(), options.stereo.features);
  }
  if (options.estimator == EstimatorType::kLandmarks) {
    assembly.landmarks.in_use = options.stereo.estimator.database;
  }
  Result<std::unique_ptr<Estimator>> estimator = make_estimator(options, assembly);
  if (!estimator) {
    return tl::unexpected<Error>(estimator.error());
  }
  parts.estimator = std::move(*estimator);
  if (parts.devices.stereo != nullptr) {
    stereo.emplace(options, parts.devices, assembly.landmarks);
  }
  parts.estimator_type = to_string(options.estimator);
  parts.occupancy = options.occupancy;
  parts.forget_places = [memory = tools->memory] { memory->reset(); };
  parts.behaviours = Behaviours(options, *tools, parts.devices.camera != nullptr, std::move(stereo));
  return assembly;
}

}  // namespace

Result<Assembly> assemble(const RobotOptions& options, LandmarkStorage landmarks) {
  Assembly assembly;
  if (const Status made = make_devices(options, assembly); !made) {
    return tl::unexpected<Error>(made.error());
  }
  return complete(options, std::move(landmarks), std::move(assembly));
}

Result<SharedAssembly> assemble_shared(std::span<const RobotOptions> robots) {
  SEEKER_ASSERT(!robots.empty());
  Result<drivers::SharedDevices> devices = sim_devices(robots);
  if (!devices) {
    return tl::unexpected<Error>(devices.error());
  }
  SharedAssembly shared{devices->world, devices->barrier, {}};
  shared.robots.reserve(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    Assembly assembly;
    use_sim(std::move(devices->robots[i]), assembly);
    Result<Assembly> completed = complete(robots[i], {}, std::move(assembly));
    if (!completed) {
      return tl::unexpected<Error>(completed.error());
    }
    shared.robots.push_back(std::move(*completed));
  }
  return shared;
}

}  // namespace seeker::app
