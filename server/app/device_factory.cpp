#include "server/app/device_factory.hpp"

#include "common/core/rng.hpp"
#include "server/app/estimators.hpp"
#include "server/app/explore_behaviour.hpp"
#include "server/app/localise_behaviour.hpp"
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
  out.stereo = std::move(devices->stereo);
  out.clock = std::move(devices->clock);
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
  Behaviours(const RobotOptions& options, std::shared_ptr<const search::ControlTable> table, bool has_camera,
             std::optional<StereoMissions> stereo)
      : go_(options.go),
        search_(options.search),
        explore_(options.explore),
        table_(std::move(table)),
        has_camera_(has_camera),
        stereo_(std::move(stereo)) {}

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
    if (const auto* survey = std::get_if<api::SurveyMission>(&task)) {
      return stereo_ ? stereo_->survey(*survey, situation) : no_stereo();
    }
    if (const auto* localise = std::get_if<api::LocaliseMission>(&task)) {
      return stereo_ ? stereo_->localise(*localise, situation) : no_stereo();
    }
    if (!has_camera_) {
      return fail(Errc::kRefused, "this robot has no camera to search with");
    }
    return search(std::get<api::SearchMission>(task), situation);
  }

  [[nodiscard]] const EvidenceMemory& memory() const { return memory_; }

 private:
  static Result<std::unique_ptr<Behaviour>> no_stereo() {
    return fail(Errc::kRefused, "this robot has no stereo camera to find landmarks with");
  }
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
  std::optional<StereoMissions> stereo_;
  EvidenceMemory memory_ = std::make_shared<std::optional<search::EvidenceGrid>>();
};

}  // namespace

Result<Assembly> assemble(const RobotOptions& options, LandmarkStorage landmarks) {
  Assembly assembly;
  assembly.landmarks.library = std::make_shared<LandmarkLibrary>(std::move(landmarks));
  const Status made = options.driver == DriverType::kSim ? make_sim(options, assembly) : make_replay(options, assembly);
  if (!made) {
    return tl::unexpected<Error>(made.error());
  }
  if (const Status ok = use_camera(options, assembly.parts.devices); !ok) {
    return tl::unexpected<Error>(ok.error());
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
  Behaviours behaviours(options, std::make_shared<const search::ControlTable>(std::move(*table)),
                        parts.devices.camera != nullptr, std::move(stereo));
  parts.forget_places = [memory = behaviours.memory()] { memory->reset(); };
  parts.behaviours = std::move(behaviours);
  return assembly;
}

}  // namespace seeker::app
