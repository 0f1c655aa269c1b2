#include "server/emulator/world_devices.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "common/core/rng.hpp"
#include "server/emulator/devices/lms_device.hpp"
#include "server/emulator/devices/p2os_device.hpp"
#include "server/emulator/devices/rplidar_device.hpp"
#include "server/emulator/pseudo_terminal.hpp"
#include "server/emulator/tcp_line.hpp"

namespace seeker::emulator {
namespace {

using Injection = std::function<Status(const std::string&, bool)>;

/// A device's own faults by their names.
Injection injection(std::map<std::string, std::function<void(bool)>> faults) {
  return [faults = std::move(faults)](const std::string& name, bool on) -> Status {
    const auto fault = faults.find(name);
    if (fault != faults.end()) {
      fault->second(on);
      return {};
    }
    std::string names;
    for (const auto& [known, switched] : faults) {
      names += (names.empty() ? "" : ", ") + known;
    }
    return fail(Errc::kNotFound, "the device has no fault '" + name + "'; it has: " + names);
  };
}

HostedDevice make_base(sim::SharedWorld& world, const DeviceSpec& spec) {
  sim::RobotInWorld& robot = world.robot(spec.robot);
  P2osDeviceParams params;
  params.baud = spec.path.empty() ? 0 : params.baud;
  P2osDeviceHooks hooks;
  hooks.read_base = [&robot](RobotTime now) { return robot.odometry(now); };
  hooks.read_sonar = [&robot](RobotTime now) { return robot.sonar(now); };
  hooks.command = [&robot](const Twist2& velocity) { robot.command(velocity); };
  auto device = std::make_unique<P2osDevice>(params, std::move(hooks), world.now());
  auto state = std::make_shared<P2osFaults>();
  const auto set = [raw = device.get(), state](auto change) {
    return [raw, state, change](bool on) {
      change(*state, on);
      raw->set_faults(*state);
    };
  };
  Injection inject = injection({
      {"stuck-wheel", set([](P2osFaults& f, bool on) { f.left_wheel_stuck = on; })},
      {"emergency-stop", set([](P2osFaults& f, bool on) { f.e_stop_pressed = on; })},
      {"charger", set([](P2osFaults& f, bool on) { f.charger_plugged = on; })},
      {"bumper", set([](P2osFaults& f, bool on) { f.front_bumpers = on ? 0x04 : 0; })},
  });
  return {"", std::move(device), nullptr, std::move(inject)};
}

HostedDevice make_lms200(sim::SharedWorld& world, const DeviceSpec& spec, std::uint64_t seed) {
  sim::RobotInWorld& robot = world.robot(spec.robot);
  LmsDeviceParams params;
  params.seed = seed;
  params.flash.unit = static_cast<std::uint8_t>(lms200::Unit::kMillimetre);  // as whoever put it on a robot has set it
  auto device = std::make_unique<LmsDevice>(params, [&robot](RobotTime now) { return robot.scan(now); });
  const auto set = [raw = device.get()](auto change) {
    return [raw, change](bool on) {
      LmsFaults faults = raw->faults();
      change(faults, on);
      raw->set_faults(faults);
    };
  };
  constexpr double kOften = 0.2;
  Injection inject = injection({
      {"pollution", set([](LmsFaults& f, bool on) { f.polluted = on; })},
      {"fatal", set([](LmsFaults& f, bool on) { f.fatal = on; })},
      {"wrong-crc", set([](LmsFaults& f, bool on) { f.wrong_crc = on ? kOften : 0.0; })},
  });
  return {"", std::move(device), nullptr, std::move(inject)};
}

/// One beam of a scanner that turns, with the noise of the robot's own scanner.
RangeInDirection beam_of(const sim::RobotInWorld& robot, double range_max_m, std::uint64_t seed) {
  auto rng = std::make_shared<Rng>(seed);
  return [&robot, range_max_m, rng](double bearing_rad, RobotTime /*at*/) -> std::optional<double> {
    const sim::LidarModel& lidar = robot.model().lidar;
    const Pose2 world_T_laser = robot.truth().world_T_base * lidar.base_T_laser;
    const double heading_rad = world_T_laser.theta_rad + bearing_rad;
    const Point2 direction(std::cos(heading_rad), std::sin(heading_rad));
    const auto hit = robot.scene().nearest(world_T_laser.translation(), direction, range_max_m, lidar.height_m);
    if (!hit || rng->uniform() < lidar.dropout) {
      return std::nullopt;
    }
    return hit->distance_m + rng->normal(lidar.sigma_range_m);
  };
}

HostedDevice make_rplidar(sim::SharedWorld& world, const DeviceSpec& spec, std::uint64_t seed) {
  const RplidarDeviceParams params = spec.kind == DeviceKind::kRplidarA1 ? rplidar_a1() : rplidar_a2();
  auto device = std::make_unique<RplidarDevice>(params, beam_of(world.robot(spec.robot), params.range_max_m, seed));
  constexpr std::uint16_t kCode = 0x8001;
  Injection inject = injection({
      {"protection-stop",
       [raw = device.get()](bool on) {
         if (on) {
           raw->stop_for_protection(kCode);
         }
       }},
      {"warning",
       [raw = device.get()](bool on) {
         if (on) {
           raw->warn(kCode);
         }
       }},
      {"stuck-motor", [raw = device.get()](bool on) { raw->block_rotor(on); }},
  });
  return {"", std::move(device), nullptr, std::move(inject)};
}

HostedDevice make_device(sim::SharedWorld& world, const DeviceSpec& spec, std::uint64_t seed) {
  HostedDevice made = spec.kind == DeviceKind::kP2os     ? make_base(world, spec)
                      : spec.kind == DeviceKind::kLms200 ? make_lms200(world, spec, seed)
                                                         : make_rplidar(world, spec, seed);
  made.name = std::string(to_string(spec.kind)) + (spec.robot == 0 ? "" : "#" + std::to_string(spec.robot));
  if (spec.path.empty()) {
    made.line = std::make_unique<TcpLine>(spec.host, spec.port);
  } else {
    made.line = std::make_unique<PseudoTerminal>(spec.path);
  }
  return made;
}

}  // namespace

Result<WorldDevices> WorldDevices::make(sim::SharedWorld& world, const std::vector<DeviceSpec>& specs,
                                        std::uint64_t seed) {
  std::vector<HostedDevice> devices;
  std::vector<std::unique_ptr<MjpegPort>> cameras;
  devices.reserve(specs.size());
  cameras.reserve(specs.size());
  for (const DeviceSpec& spec : specs) {
    if (spec.robot >= world.size()) {
      return fail(Errc::kInvalidArgument, "there is no robot " + std::to_string(spec.robot) + "; this world has " +
                                              std::to_string(world.size()) + ", counted from 0");
    }
    if (spec.kind == DeviceKind::kCamera) {
      MjpegParams params;
      params.host = spec.host;
      params.port = spec.port;
      cameras.push_back(std::make_unique<MjpegPort>(
          std::move(params), [&world, robot = spec.robot] { return world.robot(robot).omni_image(world.now()); }));
    } else {
      devices.push_back(make_device(world, spec, seed + devices.size()));
    }
  }
  WorldDevices made(world, std::move(devices), seed);
  made.cameras_ = std::move(cameras);
  return made;
}

Status WorldDevices::plug() {
  for (const auto& camera : cameras_) {
    if (Status plugged = camera->plug(); !plugged) {
      return plugged;
    }
  }
  return host_->plug();
}

void WorldDevices::step() {
  host_->step(world_->now());
  for (const auto& camera : cameras_) {
    camera->step(world_->now());
  }
}

std::string WorldDevices::addresses() const {
  std::string text = host_->addresses();
  for (const auto& camera : cameras_) {
    text += "camera " + camera->address() + "\n";
  }
  return text;
}

}  // namespace seeker::emulator
