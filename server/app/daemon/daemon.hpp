/// \file
/// The onboard server as a program: arguments, composition, signals, orderly end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::app {

/// What the command line says.
struct DaemonArguments {
  std::string config = "sim";          ///< robot file, or the name of one in robots/ of files::config_folder()
  std::vector<std::string> overrides;  ///< key.path=value
  std::optional<std::uint16_t> port;   ///< 0: any free one
  std::filesystem::path port_file;     ///< the port is written here once the robot can be reached
  std::filesystem::path state;         ///< empty: $STATE_DIRECTORY, $XDG_STATE_HOME/seeker, ~/.local/state/seeker
  std::string record;                  ///< file that the drive is recorded into; empty: as the robot file says
  std::string log_level = "info";
  std::string log_format;  ///< text, journald or json; empty: by who reads it
  bool print_config = false;
};

/// Runs until SIGTERM, SIGINT or the end of a replay with exit_at_end. The exit code: 0 ended on request, 1 failed,
/// 78 wrong configuration (sysexits EX_CONFIG, so that a service manager does not restart it).
[[nodiscard]] int run_daemon(const DaemonArguments& arguments);

/// Where state is kept when the command line does not say.
[[nodiscard]] std::filesystem::path default_state_folder();

}  // namespace seeker::app
