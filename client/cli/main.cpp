#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include <poll.h>
#include <unistd.h>

#include "client/cli/program.hpp"
#include "common/log/log.hpp"

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

extern "C" void on_signal(int /*signal*/) { interrupted = true; }

}  // namespace

int main(int argc, char** argv) {
  struct sigaction action {};
  action.sa_handler = on_signal;
  // A second Ctrl-C ends the program at once.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  ::signal(SIGPIPE, SIG_IGN);

  seeker::log::set_level(seeker::log::Level::kWarning);
  seeker::cli::Process process;
  process.out = &std::cout;
  process.err = &std::cerr;
  process.out_is_tty = ::isatty(STDOUT_FILENO) != 0;
  process.err_is_tty = ::isatty(STDERR_FILENO) != 0;
  const char* no_colour = std::getenv("NO_COLOR");
  process.no_colour = no_colour != nullptr && *no_colour != '\0';
  process.interrupted = [] { return interrupted.load(); };
  process.out_ended = [] {
    pollfd out{STDOUT_FILENO, 0, 0};
    return ::poll(&out, 1, 0) > 0 && (out.revents & POLLERR) != 0;
  };
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return static_cast<int>(seeker::cli::run_program(arguments, process, seeker::cli::connect_robot));
}
