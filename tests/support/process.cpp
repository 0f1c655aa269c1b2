#include "tests/support/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>

extern char** environ;  // NOLINT: POSIX asks for it

namespace seeker::testing {
namespace {

/// Programs of an instrumented build take so many times as long.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr int kSlowdown = 10;
#else
constexpr int kSlowdown = 1;
#endif

}  // namespace

ChildProcess::ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                           std::filesystem::path output)
    : output_(std::move(output)) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  const int error = posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    std::cerr << "cannot start " << program << ": build it first\n";
    std::abort();
  }
}

ChildProcess::~ChildProcess() {
  if (!code_) {
    send(SIGKILL);
    static_cast<void>(wait(std::chrono::seconds(10)));
  }
}

void ChildProcess::send(int signal) const { ::kill(pid_, signal); }

void ChildProcess::kill() {
  send(SIGKILL);
  EXPECT_EQ(wait(std::chrono::seconds(10)), 128 + SIGKILL) << output();
}

std::optional<int> ChildProcess::wait(std::chrono::seconds limit) {
  if (code_) {
    return code_;
  }
  // A pidfd becomes readable when the process ends: no polling.
  const int handle = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  pollfd entry{.fd = handle, .events = POLLIN, .revents = 0};
  const int ready = poll(&entry, 1, static_cast<int>(std::chrono::milliseconds(kSlowdown * limit).count()));
  close(handle);
  if (ready <= 0) {
    return std::nullopt;
  }
  int status = 0;
  waitpid(pid_, &status, 0);
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return code_;
}

std::string ChildProcess::output() const {
  std::ostringstream text;
  text << std::ifstream(output_).rdbuf();
  return text.str();
}

std::filesystem::path program(const std::string& name) {
  // All programs and tests of a build lie in one folder.
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

std::optional<std::string> wait_for_file(const std::filesystem::path& path, std::chrono::seconds limit) {
  const auto end = std::chrono::steady_clock::now() + kSlowdown * limit;
  while (std::chrono::steady_clock::now() < end) {
    std::string text;
    if (std::getline(std::ifstream(path), text) && !text.empty()) {
      return text;
    }
    std::this_thread::yield();
  }
  return std::nullopt;
}

namespace {

/// Of tests that failed they stay: what the programs wrote says why.
class FolderKeeper : public ::testing::EmptyTestEventListener {
 public:
  static FolderKeeper& instance() {
    static FolderKeeper* const keeper = [] {
      auto* made = new FolderKeeper;  // gtest deletes it
      ::testing::UnitTest::GetInstance()->listeners().Append(made);
      return made;
    }();
    return *keeper;
  }
  void add(const std::filesystem::path& folder) { folders_.insert(folder); }

  void OnTestProgramEnd(const ::testing::UnitTest& tests) override {
    for (const std::filesystem::path& folder : folders_) {
      std::error_code ignored;  // a folder left behind is no failure
      if (tests.Passed()) {
        std::filesystem::remove_all(folder, ignored);
      } else {
        std::cout << "kept: " << folder.string() << "\n";
      }
    }
  }

 private:
  std::set<std::filesystem::path> folders_;
};

}  // namespace

std::filesystem::path fresh_folder(const std::string& name) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / (name + "-" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  FolderKeeper::instance().add(folder);
  return folder;
}

}  // namespace seeker::testing
