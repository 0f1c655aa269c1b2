/// \file
/// The robot on the network: listens, keeps one session per client, sends streams to all of them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/api/robot_api.hpp"

namespace seeker::server_net {

/// What one client may ask of the server.
struct SessionLimits {
  double requests_per_s = 200.0;        ///< sustained; a request above it is answered with kBusy
  double request_burst = 400.0;         ///< at once
  std::size_t refused_requests = 2000;  ///< consecutive ones before the session is closed as flooding
  std::size_t in_flight = 64;           ///< unanswered requests
  std::size_t subscriptions = 16;
  std::size_t queued_replies = 1024;                  ///< not yet sent; more: closed as too slow
  std::size_t queued_bytes = 64UL * 1024 * 1024;      ///< of replies not yet sent
  Duration write_timeout = std::chrono::seconds(10);  ///< wall time for one frame to leave
  Duration hello_timeout = std::chrono::seconds(3);   ///< wall time from connection to hello
  Duration idle_limit = Duration::zero();             ///< wall time without request and subscription; zero: no limit
};

/// What is kept of RELIABLE topics for clients that resume or lag.
struct BacklogLimits {
  std::size_t items = 4096;                ///< per topic
  std::size_t bytes = 32UL * 1024 * 1024;  ///< per topic
};

struct ServerParams {
  std::string address = "127.0.0.1";  ///< of the interface to listen on
  std::uint16_t port = 7471;          ///< 0: any free one
  std::size_t max_sessions = 256;     ///< connections at a time, those without hello included: they make room
  Duration heartbeat = std::chrono::seconds(1);      ///< wall time
  Duration lost_after = std::chrono::seconds(3);     ///< wall time without a sign of life
  Duration linger = std::chrono::milliseconds(500);  ///< wall time for the last frames of a session to leave
  api::Role max_role = api::Role::kAdmin;            ///< granted at most
  SessionLimits session;
  BacklogLimits backlog;
  /// Robot time now; called on the server's thread. Empty: the newest stamp that was published.
  std::function<RobotTime()> robot_now;
};

/// Figures for the log and for tests.
struct ServerStats {
  std::size_t sessions = 0;    ///< open now
  std::uint64_t accepted = 0;  ///< connections since the start
  std::uint64_t lost = 0;      ///< sessions that ended without goodbye
  std::uint64_t refused_requests = 0;
  std::uint64_t frames_sent = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t encoded = 0;  ///< stream updates encoded, each once for all clients
};

/// One thread does all network work. `host` is called on it (and must outlive the server); replies and updates may come
/// from any thread.
class Server {
 public:
  Server(api::RobotHost& host, ServerParams params);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  /// stop()
  ~Server();

  /// Opens the robot, listens, starts the thread; the answer is the port. Errors: kIo names the address and the cause,
  /// or what the robot said.
  [[nodiscard]] Result<std::uint16_t> start();
  /// In order: no new connections, no new updates, tell each client, let the last frames leave, close. Waits for it.
  /// The robot is told of each client as lost, since clients did not leave on purpose. Harmless when repeated.
  void stop();
  [[nodiscard]] ServerStats stats() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seeker::server_net
