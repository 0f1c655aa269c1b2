// seeker-emulator: hosts a simulated world for several robots. Everything is in libraries; this file reads the command
// line.

#include <CLI/CLI.hpp>

#include "server/emulator/emulator_command.hpp"

int main(int argc, char** argv) {
  seeker::emulator::EmulatorArguments arguments;
  std::uint16_t port = 0;
  CLI::App app{
      "seeker-emulator: a simulated world that several seekerd share.\n"
      "Example: seeker-emulator --world office --robots 2 --lockstep, then for each robot\n"
      "  seekerd --set driver=emulator --set emulator.robot=0 (1, ...) --set robot_id=r0 --port 7471"};
  app.set_version_flag("--version", std::string("seeker-emulator ") + SEEKER_VERSION);
  app.add_option("--world", arguments.world, "World file, or the name of one in worlds/")->required();
  app.add_option("--robots", arguments.robots, "How many robots are in it")->capture_default_str();
  app.add_option("--starts", arguments.starts, "Start pose of each, by number, e.g. 0,2 (default: 0,1,...)")
      ->delimiter(',');
  app.add_option("--config", arguments.config,
                 "Robot file, or the name of one in robots/; its section `sim` describes every robot")
      ->capture_default_str();
  app.add_option("--set", arguments.overrides, "Override a field of it: key.path=value (repeatable)");
  app.add_flag("--lockstep", arguments.lockstep, "The world waits for its robots; else it goes with the wall clock");
  app.add_option("--address", arguments.address, "Interface to listen on")->capture_default_str();
  app.add_option("--tls", arguments.tls, "Folder of certificates made by 'seeker pki issue'; robots need theirs, too");
  app.add_flag("--insecure", arguments.insecure, "Allow plain TCP beyond this machine");
  auto* port_option = app.add_option("--port", port, "TCP port; 0 takes any free one (default: 7472)");
  app.add_option("--port-file", arguments.port_file, "Write the port to this file once the world can be reached");
  app.add_option("--device", arguments.devices,
                 "A device that a robot shows to programs which expect real ones: KIND@LINE[#ROBOT], such as\n"
                 "p2os@/tmp/base, lms200@/tmp/laser, rplidar-a1@/tmp/laser, camera@tcp://127.0.0.1:8080 (repeatable)");
  app.add_option("--fault", arguments.faults,
                 "A fault of a device: AT_S DEVICE FAULT [VALUE] [for SECONDS], such as '20 lms200 unplug for 2' or\n"
                 "'0 p2os bit-errors 1e-6' (repeatable)");
  app.add_option("--devices-file", arguments.devices_file, "Write name and address of each device to this file");
  app.add_option("--truth", arguments.truth_file, "Write where the robots really are to this file (CSV)");
  app.add_option("--log-level", arguments.log_level, "What is logged")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : 2;
  }
  if (port_option->count() > 0) {
    arguments.port = port;
  }
  return seeker::emulator::run_emulator(arguments);
}
