/// \file
/// The robot of the benchmark, whatever stack carries its traffic.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "common/api/robot_api.hpp"
#include "tests/bench/link/latencies.hpp"
#include "tests/bench/link/options.hpp"

namespace seeker::link_bench {

/// Serves clients from its constructor to its destructor.
class Host {
 public:
  Host() = default;
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  virtual ~Host() = default;

  [[nodiscard]] virtual std::uint16_t port() const = 0;
  /// Hands an item to all subscribers. Called on one thread.
  virtual void publish(api::Topic topic, RobotTime stamp, const api::Payload& payload) = 0;
};

/// Makes a host that adds to `acts`, for each drive command it obeys, the time since DriveCommand::sent.
using MakeHost = std::function<Result<std::unique_ptr<Host>>(const HostOptions& options, Latencies& acts)>;

/// The program: publishes Traffic until SIGTERM. Returns the exit code.
[[nodiscard]] int run_host(int argc, char** argv, const MakeHost& make);

}  // namespace seeker::link_bench
