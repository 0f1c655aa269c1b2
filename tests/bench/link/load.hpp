/// \file
/// The clients of the benchmark, whatever stack carries their traffic.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"
#include "common/pki/bundle.hpp"

namespace seeker::link_bench {

/// A client with a subscription, from its constructor to its destructor. It connects again when its link breaks.
class Client {
 public:
  Client() = default;
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  virtual ~Client() = default;

  /// Sends a command as it is. `answered` is called once, on another thread.
  virtual void drive(const api::DriveCommand& command, std::function<void(Status)> answered) = 0;
};

struct ClientWish {
  std::string name;
  pki::BundleFiles bundle;
  std::uint16_t port = 0;  ///< of 127.0.0.1
  bool drives = false;     ///< drive() will be called: the lease is taken at once
  std::vector<api::Topic> topics;
  /// Called for each update with its stamp, once it is read; never in two threads at once.
  std::function<void(api::Topic topic, RobotTime stamp)> on_update;
};

using Connect = std::function<Result<std::unique_ptr<Client>>(const ClientWish& wish)>;

/// The program: measures, or keeps clients connected until SIGTERM. Prints figures as lines "name value". Returns the
/// exit code.
[[nodiscard]] int run_load(int argc, char** argv, const Connect& connect);

}  // namespace seeker::link_bench
