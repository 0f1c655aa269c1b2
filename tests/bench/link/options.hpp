/// \file
/// Command lines of the programs that `./run bench link` starts.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>

#include "common/core/time.hpp"

namespace seeker::link_bench {

struct HostOptions {
  std::filesystem::path bundle;     ///< folder with the robot's certificates
  std::filesystem::path port_file;  ///< gets the port once clients can connect
  std::filesystem::path acts;       ///< gets the delays from command to act
};

struct LoadOptions {
  std::filesystem::path bundle;  ///< folder with the operator's certificates
  std::uint16_t port = 0;
  std::size_t clients = 0;           ///< with video, until SIGTERM; 0: one client measures
  std::filesystem::path ready_file;  ///< of clients with video: written when each has got an image
  std::size_t cuts = 0;              ///< how often the link of the one client is cut; 0: it measures latencies
  Duration measured = std::chrono::seconds(10);
  Duration warm_up = std::chrono::seconds(2);
  pid_t host = 0;                ///< whose processor time and memory are printed
  std::filesystem::path states;  ///< gets the delays of states, or from cuts to fresh states
  std::filesystem::path drives;  ///< gets the delays from commands to their answers
};

/// Both end the program where the command line is wrong.
[[nodiscard]] HostOptions read_host_options(int argc, char** argv);
[[nodiscard]] LoadOptions read_load_options(int argc, char** argv);

/// Has SIGTERM wait for wait_for_end(). Call it before threads are started.
void hold_back_end();
void wait_for_end();

}  // namespace seeker::link_bench
