/// \file
/// The program without its process: parsing, connecting, one verb, the exit code.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "client/cli/command_line.hpp"
#include "client/cli/connection.hpp"
#include "client/cli/context.hpp"

namespace seeker::cli {

struct ConnectRequest {
  std::string robot;                ///< HOST[:PORT]
  std::string tls;                  ///< as given with --tls
  std::optional<Duration> timeout;  ///< wall time for the connection
  bool reconnect = false;           ///< true: a broken connection is made again, for verbs that run long
  bool stops = false;               ///< true: the verb runs long and may have to stop the robot
  std::string client_name = {};     ///< empty: of program, host and process
};
using Connector = std::function<Result<Connection>(const ConnectRequest&)>;

/// The parts of the process that the program uses.
struct Process {
  std::ostream* out = nullptr;
  std::ostream* err = nullptr;
  bool out_is_tty = false;
  bool err_is_tty = false;
  bool no_colour = false;  ///< NO_COLOR is set
  std::function<bool()> interrupted = [] { return false; };
  /// Whether the reader of `out` has closed it, as head does at the end of a pipe.
  std::function<bool()> out_ended = [] { return false; };
};

/// Runs one command line (without the program's name).
[[nodiscard]] ExitCode run_program(const std::vector<std::string>& arguments, const Process& process,
                                   const Connector& connect);

/// Connects over the network (connect.cpp).
[[nodiscard]] Result<Connection> connect_robot(const ConnectRequest& request);

}  // namespace seeker::cli
