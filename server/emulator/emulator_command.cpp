#include "server/emulator/emulator_command.hpp"

#include <cstdlib>
#include <thread>
#include <utility>

#include "common/files/files.hpp"
#include "common/log/log.hpp"
#include "common/net/random_id.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/app/runtime/termination_signals.hpp"
#include "server/drivers/emulator/emulator_wire.hpp"
#include "server/emulator/emulator_server.hpp"
#include "server/emulator/truth_log.hpp"
#include "server/emulator/world_host.hpp"
#include "server/options/world_options.hpp"

namespace seeker::emulator {
namespace {

constexpr int kExitConfig = 78;  // sysexits EX_CONFIG
constexpr const char* kPart = "emulator";

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
  if (!arguments.lockstep && settings.speed <= 0.0) {
    return fail(Errc::kInvalidArgument, "without --lockstep sim.speed must be above 0; 1 is the speed of life");
  }
  Result<sim::World> world = options::load_world(arguments.world);
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  world->people_walk = world->people_walk || settings.people;
  return drivers::make_shared_devices(std::move(*world), places_of(arguments, settings), settings.speed,
                                      settings.devices);
}

Status serve(const EmulatorArguments& arguments, drivers::SharedDevices devices, double speed) {
  const app::TerminationSignals signals;
  WorldHost host(std::move(devices), {net::random_id(), arguments.lockstep, speed});
  EmulatorServer server(host, {.address = arguments.address,
                               .port = arguments.port.value_or(drivers::kEmulatorPort),
                               .lockstep = arguments.lockstep,
                               .speed = speed});
  TruthLog truth;
  if (!arguments.truth_file.empty()) {
    if (Status opened = truth.open(arguments.truth_file); !opened) {
      return opened;
    }
    server.on_step = [&] { truth.add(host.world()); };
  }
  const Result<std::uint16_t> port = server.listen();
  if (!port) {
    return tl::unexpected<Error>(port.error());
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
  const Result<app::RobotOptions> options = app::load_robot_options(arguments.config, arguments.overrides);
  if (!options) {
    log::error(kPart, options.error().message);
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
