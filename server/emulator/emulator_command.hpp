/// \file
/// seeker-emulator: hosts a simulated world that several seekerd share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seeker::emulator {

/// The parsed command line.
struct EmulatorArguments {
  std::string world;           ///< world file, or the name of one in worlds/ of files::config_folder()
  std::string config = "sim";  ///< robot file, or the name of one in robots/: its `sim` section is that of every robot
  std::vector<std::string> overrides;  ///< key.path=value, over the values of the robot file
  std::size_t robots = 2;
  std::vector<std::size_t> starts;     ///< index of each robot's start pose; empty: 0, 1, ...
  std::optional<std::uint16_t> port;   ///< 0: any free one
  std::string address = "127.0.0.1";   ///< of the interface to listen on
  std::filesystem::path tls;           ///< folder of a bundle of certificates; empty: plain TCP
  bool insecure = false;               ///< plain TCP is allowed beyond this machine
  std::filesystem::path port_file;     ///< the port is written here once the world can be reached
  std::vector<std::string> devices;    ///< as parse_device_spec() reads them
  std::vector<std::string> faults;     ///< as parse_fault_command() reads them
  std::filesystem::path devices_file;  ///< names and addresses of the devices are written here
  std::filesystem::path truth_file;    ///< the true poses of the robots are written here; empty: nowhere
  bool lockstep = false;
  std::string log_level = "info";
};

/// Runs until SIGTERM or SIGINT. The exit code: 0 ended on request, 1 failed, 78 wrong configuration.
[[nodiscard]] int run_emulator(const EmulatorArguments& arguments);

}  // namespace seeker::emulator
