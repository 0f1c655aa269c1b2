/// \file
/// Another program as a child of this one, for runs over real sockets between processes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::lab {

/// Ends its child (SIGTERM, then SIGKILL) when it is destroyed.
class ChildProcess {
 public:
  /// Starts a program. `arguments` do not include the program's name; stdout and stderr go to the file `log`. Error:
  /// kIo.
  [[nodiscard]] static Result<ChildProcess> start(const std::filesystem::path& program,
                                                  const std::vector<std::string>& arguments,
                                                  const std::filesystem::path& log);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// The exit code (128 + signal where a signal ended the child). Nothing: it still runs after `limit`.
  [[nodiscard]] std::optional<int> wait(std::chrono::milliseconds limit);
  /// Sends SIGTERM; the exit code is that of wait().
  [[nodiscard]] std::optional<int> terminate(std::chrono::milliseconds limit);
  [[nodiscard]] bool running() { return !wait(std::chrono::milliseconds(0)).has_value(); }

 private:
  explicit ChildProcess(pid_t pid) : pid_(pid) {}

  pid_t pid_ = -1;
  std::optional<int> exit_code_;
};

/// The folder of this program's own executable; empty when the system does not report it.
[[nodiscard]] std::filesystem::path own_folder();

}  // namespace seeker::lab
