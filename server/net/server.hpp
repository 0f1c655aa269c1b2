/// \file
/// The robot on the network: listens, keeps one session per client, sends streams to all of them.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"
#include "common/net/link_security.hpp"

namespace seeker::server_net {

/// Limits of one session.
struct SessionLimits {
  double requests_per_s = 200.0;        ///< sustained; a request above it is answered with kBusy
  double request_burst = 400.0;         ///< requests that may arrive at once
  std::size_t refused_requests = 2000;  ///< consecutive ones before the session is closed as flooding
  std::size_t in_flight = 64;           ///< number of requests without a response
  std::size_t subscriptions = 16;
  std::size_t queued_replies = 1024;              ///< responses not yet sent; a session with more is closed as too slow
  std::size_t queued_bytes = 64UL * 1024 * 1024;  ///< of responses not yet sent
  Duration write_timeout = std::chrono::seconds(10);  ///< wall time for one frame to leave
  Duration hello_timeout = std::chrono::seconds(3);   ///< wall time from connection to hello
  Duration idle_limit = Duration::zero();             ///< wall time without request and subscription; zero: no limit
};

/// How much of each RELIABLE topic is kept for clients that resume or lag.
struct BacklogLimits {
  std::size_t items = 4096;                ///< per topic
  std::size_t bytes = 32UL * 1024 * 1024;  ///< per topic
};

struct ServerParams {
  std::string address = "127.0.0.1";              ///< of the interface to listen on
  std::uint16_t port = 7471;                      ///< 0: any free one
  std::size_t max_sessions = 256;                 ///< open connections; those without hello count and are closed first
  Duration heartbeat = std::chrono::seconds(1);   ///< wall time between heartbeats
  Duration lost_after = std::chrono::seconds(3);  ///< wall time without a received frame after which a client is lost
  Duration linger = std::chrono::milliseconds(500);  ///< wall time for the last frames of a session to leave
  api::Role max_role =
      api::Role::kAdmin;  ///< the highest role that is granted, also to a certificate with a higher one
  net::LinkSecurity security;
  SessionLimits session;
  BacklogLimits backlog;
  /// Returns the present robot time; called on the server's thread. Empty: the newest published stamp is used.
  std::function<RobotTime()> robot_now;
  /// Returns the number of passes of the robot's control loop; called on the server's thread. While it stands still no
  /// heartbeat is sent, and after lost_after nobody can connect. Empty: each call counts as a pass.
  std::function<std::uint64_t()> loop_pass;
  /// Receives what is wrong with the port's protection, at the start and when that changes; called on the server's
  /// thread (the first time by start()). May be empty.
  std::function<void(const std::vector<api::Fault>&)> on_link_faults;
};

/// Counters for the log and for tests.
struct ServerStats {
  std::size_t sessions = 0;    ///< number of open sessions
  std::uint64_t accepted = 0;  ///< number of connections since the start
  std::uint64_t lost = 0;      ///< number of sessions that clients did not end on purpose
  std::uint64_t refused_requests = 0;
  std::uint64_t frames_sent = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t encoded = 0;  ///< number of encoded stream updates, each once for all clients
  /// By topic: items that clients missed, since they were too slow.
  std::array<std::uint64_t, api::kTopicCount> dropped{};
  std::size_t queued_bytes = 0;  ///< of answers that clients have not taken yet
};

/// One thread does all network work. `host` is called on it (and must outlive the server); replies and updates may come
/// from any thread.
class Server {
 public:
  Server(api::RobotHost& host, ServerParams params);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  /// Calls stop().
  ~Server();

  /// Opens the robot, listens, starts the thread, and returns the port. Errors: kIo, which names the address and the
  /// cause, or the error of the robot.
  [[nodiscard]] Result<std::uint16_t> start();
  /// Accepts no more connections and updates, notifies each client, sends the last frames, closes, and waits for all of
  /// it. Each client is reported to the robot as lost, since it did not leave on purpose. Further calls have no effect.
  void stop();
  [[nodiscard]] ServerStats stats() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seeker::server_net
