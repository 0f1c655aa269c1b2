/// \file
/// A program of ours as a child process.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seeker::testing {

/// Runs until it ends or is killed; killed by the destructor. Output goes to a file.
class ChildProcess {
 public:
  /// `arguments` without the program itself. Aborts when the program cannot be started.
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               std::filesystem::path output);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  void send(int signal) const;
  /// Kills it and waits until it is gone; expects that nothing else has ended it.
  void kill();
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Exit code (128 + signal where one ended it); nothing when it still runs after `limit` (ten times that in a build
  /// with sanitizers).
  [[nodiscard]] std::optional<int> wait(std::chrono::seconds limit);
  /// What it has printed so far, both streams.
  [[nodiscard]] std::string output() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> code_;
  std::filesystem::path output_;
};

/// A program of this build, e.g. "seekerd".
[[nodiscard]] std::filesystem::path program(const std::string& name);
/// The text of a file once it is there and not empty; nothing after `limit` (as above).
[[nodiscard]] std::optional<std::string> wait_for_file(const std::filesystem::path& path, std::chrono::seconds limit);
/// A new empty folder below the test's temporary folder; removed at the end, unless a test has failed.
[[nodiscard]] std::filesystem::path fresh_folder(const std::string& name);

}  // namespace seeker::testing
