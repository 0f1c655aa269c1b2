#include "server/app/composition/device_factory.hpp"
#include "server/app/composition/link_options.hpp"

#include <utility>

#include "common/core/assert.hpp"
#include "common/core/rng.hpp"
#include "common/rpc/endpoint.hpp"
#include "server/app/composition/watched_base.hpp"
#include "server/drivers/camera/cameras.hpp"
#include "server/drivers/emulator/emulator_devices.hpp"
#include "server/drivers/hardware/hardware_devices.hpp"
#include "server/drivers/merged/merged_lidar.hpp"
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

MadeDevices of_sim(drivers::SimDevices parts) {
  MadeDevices made{{}, parts.simulation, parts.faults};
  take_devices(parts, "sim", made.devices);
  if (made.simulation->model().camera == sim::CameraKind::kTank) {
    made.devices.camera_name = "tank";
  }
  return made;
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

Result<MadeDevices> make_sim(const RobotOptions& options) {
  Result<drivers::SharedDevices> devices = sim_devices({&options, 1});
  if (!devices) {
    return tl::unexpected<Error>(devices.error());
  }
  return of_sim(std::move(devices->robots.front()));
}

Result<MadeDevices> make_emulator(const RobotOptions& options) {
  Result<rpc::Endpoint> endpoint = rpc::parse_endpoint(options.emulator.address);
  if (!endpoint) {
    return fail_with_context("emulator.address", endpoint.error());
  }
  drivers::EmulatorParams params;
  params.host = endpoint->host;
  params.port = endpoint->port;
  if (options.emulator.tls) {
    params.tls = link_security(options).files;
  }
  params.robot = static_cast<std::uint32_t>(options.emulator.robot);
  const Result<std::shared_ptr<drivers::EmulatorLink>> link = drivers::EmulatorLink::connect(params);
  if (!link) {
    return tl::unexpected<Error>(link.error());
  }
  drivers::EmulatorDevices devices = drivers::make_emulator_devices(*link);
  MadeDevices made;
  take_devices(devices, "emulator", made.devices);
  return made;
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

/// Takes out what the driver could offer and the robot does not have.
void leave_fitted(const FittedSensors& sensors, Devices& devices) {
  devices.lidar = sensors.lidar ? devices.lidar : nullptr;
  devices.sonar = sensors.sonar ? devices.sonar : nullptr;
  devices.camera = sensors.camera ? devices.camera : nullptr;
  devices.stereo = sensors.stereo ? devices.stereo : nullptr;
}

/// From the devices of the driver to those of the robot.
Status fit_out(const RobotOptions& options, Devices& devices) {
  if (const Status ok = use_camera(options, devices); !ok) {
    return ok;
  }
  leave_fitted(options.sensors, devices);
  return {};
}

Result<MadeDevices> make_replay(const RobotOptions& options) {
  if (options.replay.log.empty()) {
    return fail(Errc::kInvalidArgument, "replay.log is empty; name a log with --set replay.log=FILE");
  }
  const Result<std::shared_ptr<drivers::ReplaySource>> source =
      drivers::ReplaySource::open(resolve(options, options.replay.log), options.replay.params);
  if (!source) {
    return tl::unexpected<Error>(source.error());
  }
  MadeDevices made;
  Devices& out = made.devices;
  out.type = "replay";
  out.base = std::make_shared<drivers::ReplayBase>(*source);
  out.lidar = std::make_shared<drivers::ReplayLidar>(*source);
  out.clock = std::make_shared<drivers::ReplayClock>(*source, options.replay.speed);
  out.runs_without_mission = true;
  out.summary = [log = *source] { return drivers::describe(log->summary()); };
  return made;
}

/// Both scanners as one, in the frame of the base.
void merge_lidars(std::shared_ptr<drivers::LidarDriver> second, Devices& devices) {
  auto history = std::make_shared<OdometryHistory>();
  devices.base = std::make_shared<WatchedBase>(std::move(devices.base), history);
  devices.lidar =
      std::make_shared<drivers::MergedLidar>(std::vector{std::move(devices.lidar), std::move(second)},
                                             [history](RobotTime stamp) { return history->predicted_at(stamp); });
}

Result<MadeDevices> make_real(const RobotOptions& options) {
  const RealSettings& settings = options.hardware;
  Result<drivers::HardwareDevices> devices = drivers::make_hardware(settings.devices);
  if (!devices) {
    return tl::unexpected<Error>(devices.error());
  }
  MadeDevices made;
  Devices& out = made.devices;
  out.type = "hardware";
  out.clock = devices->clock;
  out.base = std::move(devices->base);
  out.lidar = std::move(devices->lidar);
  out.sonar = std::move(devices->sonar);
  if (devices->second_lidar) {
    merge_lidars(std::move(devices->second_lidar), out);
  }
  if (settings.camera) {
    out.camera = std::make_shared<drivers::CaptureCamera>(
        drivers::make_capture_source(*settings.camera), [clock = devices->clock] { return clock->now(); },
        settings.camera_reader);
  }
  return made;
}

Result<MadeDevices> make_driver(const RobotOptions& options) {
  switch (options.driver) {
    case DriverType::kSim: return make_sim(options);
    case DriverType::kReplay: return make_replay(options);
    case DriverType::kEmulator: return make_emulator(options);
    case DriverType::kHardware: return make_real(options);
  }
  return fail(Errc::kInvalidArgument, "driver is not known");
}

}  // namespace

Result<MadeDevices> make_devices(const RobotOptions& options) {
  Result<MadeDevices> made = make_driver(options);
  if (!made) {
    return made;
  }
  if (const Status ok = fit_out(options, made->devices); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return made;
}

Result<MadeSharedDevices> make_shared_devices(std::span<const RobotOptions> robots) {
  SEEKER_ASSERT(!robots.empty());
  Result<drivers::SharedDevices> devices = sim_devices(robots);
  if (!devices) {
    return tl::unexpected<Error>(devices.error());
  }
  MadeSharedDevices made{devices->world, devices->barrier, {}};
  made.robots.reserve(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    made.robots.push_back(of_sim(std::move(devices->robots[i])));
    if (const Status ok = fit_out(robots[i], made.robots.back().devices); !ok) {
      return tl::unexpected<Error>(ok.error());
    }
  }
  return made;
}

}  // namespace seeker::app
