#include "server/emulator/emulator_command.hpp"

#include <cstdlib>
#include <thread>
#include <utility>

#include "common/files/config_folder.hpp"
#include "common/files/files.hpp"
#include "common/log/log.hpp"
#include "common/net/link_security.hpp"
#include "common/net/random_id.hpp"
#include "common/pki/bundle.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/app/runtime/termination_signals.hpp"
#include "server/drivers/emulator/emulator_wire.hpp"
#include "server/emulator/emulator_server.hpp"
#include "server/emulator/truth_log.hpp"
#include "server/emulator/world_devices.hpp"
#include "server/emulator/world_host.hpp"
#include "server/options/world_options.hpp"

namespace seeker::emulator {
namespace {

constexpr int kExitConfig = 78;  // sysexits EX_CONFIG
constexpr const char* kPart = "emulator";
constexpr Duration kLiveStep = std::chrono::milliseconds(20);
/// Devices send in between: bytes are carried, and commands obeyed, that often.
constexpr Duration kDeviceStep = std::chrono::milliseconds(5);

std::vector<sim::RobotPlace> places_of(const EmulatorArguments& arguments, const app::SimSettings& settings) {
  std::vector<sim::RobotPlace> places;
  for (std::size_t i = 0; i < arguments.robots; ++i) {
    // Each robot's noise is its own, and the same whoever else is there.
    places.push_back({settings.robot, settings.seed + i, i < arguments.starts.size() ? arguments.starts[i] : i});
  }
  return places;
}

Result<drivers::SharedDevices> make_world(const EmulatorArguments& arguments, const app::SimSettings& settings) {
  if (arguments.robots == 0 || arguments.robots > sim::kMaxRobotsInWorld) {
    return fail(Errc::kInvalidArgument, "--robots must be from 1 to " + std::to_string(sim::kMaxRobotsInWorld));
  }
  if (arguments.lockstep && !arguments.devices.empty()) {
    return fail(Errc::kInvalidArgument, "devices need a world that goes with the clock; leave --lockstep out");
  }
  if (!arguments.lockstep && settings.speed <= 0.0) {
    return fail(Errc::kInvalidArgument, "without --lockstep sim.speed must be above 0; 1 is the speed of life");
  }
  Result<sim::World> world = options::load_world(files::named_file(arguments.world, files::config_folder() / "worlds"));
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  world->people_walk = world->people_walk || settings.people;
  return drivers::make_shared_devices(std::move(*world), places_of(arguments, settings), settings.speed,
                                      settings.devices);
}

/// Devices that the command line asks for, reachable, with their faults on the clock.
Result<WorldDevices> make_world_devices(const EmulatorArguments& arguments, sim::SharedWorld& world,
                                        std::uint64_t seed) {
  std::vector<DeviceSpec> specs;
  specs.reserve(arguments.devices.size());
  for (const std::string& text : arguments.devices) {
    Result<DeviceSpec> spec = parse_device_spec(text);
    if (!spec) {
      return tl::unexpected<Error>(spec.error());
    }
    specs.push_back(*std::move(spec));
  }
  Result<WorldDevices> devices = WorldDevices::make(world, specs, seed);
  for (const std::string& text : arguments.faults) {
    Result<FaultCommand> fault = parse_fault_command(text);
    const Status added = !devices ? Status() : !fault ? tl::unexpected<Error>(fault.error()) : devices->add(*fault);
    if (!added) {
      return tl::unexpected<Error>(added.error());
    }
  }
  if (const Status plugged = devices ? devices->plug() : Status(); !plugged) {
    return tl::unexpected<Error>(plugged.error());
  }
  return devices;
}

net::LinkSecurity security_of(const EmulatorArguments& arguments) {
  net::LinkSecurity security;
  if (!arguments.tls.empty()) {
    security.files = pki::bundle_in(arguments.tls);
  }
  security.insecure = arguments.insecure;
  return security;
}

Status announce(const EmulatorArguments& arguments, const WorldDevices& devices) {
  if (!arguments.devices.empty()) {
    log::info(kPart, "devices:\n" + devices.addresses());
  }
  return arguments.devices_file.empty() ? Status() : files::write_file(arguments.devices_file, devices.addresses());
}

Status serve(const EmulatorArguments& arguments, drivers::SharedDevices devices, double speed) {
  const app::TerminationSignals signals;
  sim::SharedWorld& world = *devices.world;
  Result<WorldDevices> lines = make_world_devices(arguments, world, net::random_id());
  if (!lines) {
    return tl::unexpected<Error>(lines.error());
  }
  WorldHost host(std::move(devices), {net::random_id(), arguments.lockstep, speed});
  EmulatorServer server(host, {.address = arguments.address,
                               .port = arguments.port.value_or(drivers::kEmulatorPort),
                               .lockstep = arguments.lockstep,
                               .speed = speed,
                               .live_step = arguments.devices.empty() ? kLiveStep : kDeviceStep,
                               .security = security_of(arguments)});
  TruthLog truth;
  if (!arguments.truth_file.empty()) {
    if (Status opened = truth.open(arguments.truth_file); !opened) {
      return opened;
    }
  }
  server.on_step = [&] {
    lines->step();
    if (!arguments.truth_file.empty()) {
      truth.add(host.world());
    }
  };
  const Result<std::uint16_t> port = server.listen();
  if (!port) {
    return tl::unexpected<Error>(port.error());
  }
  if (Status announced = announce(arguments, *lines); !announced) {
    return announced;
  }
  log::info(kPart, "world '" + host.world().world().name + "' with " + std::to_string(host.robots()) +
                       " robots on port " + std::to_string(*port));
  if (!arguments.port_file.empty()) {
    if (Status written = files::write_file(arguments.port_file, std::to_string(*port) + "\n"); !written) {
      return written;
    }
  }
  std::thread network([&] { server.run(); });
  constexpr std::chrono::milliseconds kPoll{200};
  while (!signals.wait(kPoll)) {
  }
  server.stop();
  network.join();
  return {};
}

}  // namespace

int run_emulator(const EmulatorArguments& arguments) {
  log::set_level(log::parse_level(arguments.log_level).value_or(log::Level::kInfo));
  const Result<app::RobotOptions> options = app::load_robot_options(
      files::named_file(arguments.config, files::config_folder() / "robots"), arguments.overrides);
  if (!options) {
    log::error(kPart, options.error().message);
    return kExitConfig;
  }
  if (const Status allowed = net::check_allowed(arguments.address, security_of(arguments)); !allowed) {
    log::error(kPart, "--tls or --insecure: " + allowed.error().message);
    return kExitConfig;
  }
  Result<drivers::SharedDevices> devices = make_world(arguments, options->sim);
  if (!devices) {
    log::error(kPart, devices.error().message);
    return kExitConfig;
  }
  if (const Status served = serve(arguments, std::move(*devices), options->sim.speed); !served) {
    log::error(kPart, served.error().message);
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

}  // namespace seeker::emulator
