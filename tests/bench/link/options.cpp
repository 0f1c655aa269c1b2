#include "tests/bench/link/options.hpp"

#include <csignal>
#include <cstdlib>

#include <CLI/CLI.hpp>

namespace seeker::link_bench {
namespace {

void parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
}

sigset_t end_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  return signals;
}

}  // namespace

HostOptions read_host_options(int argc, char** argv) {
  CLI::App app("A robot that publishes status and images, for ./run bench link; runs until SIGTERM.");
  HostOptions out;
  app.add_option("--bundle", out.bundle, "Folder with the robot's certificates")->required();
  app.add_option("--port-file", out.port_file, "Gets the port once clients can connect")->required();
  app.add_option("--acts", out.acts, "Gets the microseconds from command to act")->required();
  parse(app, argc, argv);
  return out;
}

LoadOptions read_load_options(int argc, char** argv) {
  CLI::App app("Clients of the robot of ./run bench link: one that measures, or N with video until SIGTERM.");
  LoadOptions out;
  double seconds_measured = to_seconds(out.measured);
  double seconds_before = to_seconds(out.warm_up);
  app.add_option("--bundle", out.bundle, "Folder with the operator's certificates")->required();
  app.add_option("--port", out.port, "Of the host")->required();
  app.add_option("--clients", out.clients, "Clients with video; 0: one client measures");
  app.add_option("--ready-file", out.ready_file, "Written when each client has got an image");
  app.add_option("--cuts", out.cuts, "Cut the link so often and measure the time to the next fresh state");
  app.add_option("--seconds", seconds_measured, "How long is measured")->check(CLI::PositiveNumber);
  app.add_option("--warm-up", seconds_before, "Seconds before that")->check(CLI::NonNegativeNumber);
  app.add_option("--host-pid", out.host, "Process of the host");
  app.add_option("--states", out.states, "Gets the microseconds from a state to the client, or from a cut to that");
  app.add_option("--drives", out.drives, "Gets the microseconds from a command to its answer");
  parse(app, argc, argv);
  out.measured = seconds(seconds_measured);
  out.warm_up = seconds(seconds_before);
  return out;
}

void hold_back_end() {
  const sigset_t signals = end_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

void wait_for_end() {
  const sigset_t signals = end_signals();
  int received = 0;
  sigwait(&signals, &received);
}

}  // namespace seeker::link_bench
