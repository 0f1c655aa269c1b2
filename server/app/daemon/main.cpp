// seekerd: the onboard server. Everything is in libraries; this file reads the command line.

#include <iostream>

#include <CLI/CLI.hpp>

#include "server/app/daemon/daemon.hpp"

int main(int argc, char** argv) {
  seeker::app::DaemonArguments arguments;
  std::uint16_t port = 0;
  CLI::App app{
      "seekerd: the onboard server of a Seeker robot.\n"
      "Example: seekerd --config sim --set sim.world=../worlds/office.yaml"};
  app.set_version_flag("--version", std::string("seekerd ") + SEEKER_VERSION);
  app.add_option("--config", arguments.config, "Robot file, or the name of one in robots/ of the configuration")
      ->capture_default_str();
  app.add_option("--set", arguments.overrides, "Override a field: key.path=value (repeatable)");
  auto* port_option = app.add_option("--port", port, "TCP port; 0 takes any free one (default: the robot file's)");
  app.add_option("--port-file", arguments.port_file, "Write the port to this file once the robot can be reached");
  app.add_option("--state", arguments.state, "Folder for maps, missions and detections");
  app.add_option("--record", arguments.record, "Record odometry and scans: CARMEN log, plain or .gz");
  app.add_option("--log-level", arguments.log_level, "What is logged")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}))
      ->capture_default_str();
  app.add_option("--log-format", arguments.log_format, "How lines are written (default: by who reads them)")
      ->check(CLI::IsMember({"text", "journald", "json"}));
  app.add_flag("--print-config", arguments.print_config, "Print the effective configuration and exit");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : 2;
  }
  if (port_option->count() > 0) {
    arguments.port = port;
  }
  return seeker::app::run_daemon(arguments);
}
