/// \file
/// The robot's side of one session as a state machine without sockets: its inputs are messages and times, its outputs
/// what to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/api/robot_api.hpp"
#include "common/wire/liveness.hpp"
#include "common/wire/token_bucket.hpp"
#include "seeker/v1/session.pb.h"

namespace seeker::wire {

struct ServerSessionParams {
  api::RobotInfo robot;
  std::uint64_t stream_id = 0;
  LivenessParams liveness;
  Duration hello_timeout = std::chrono::seconds(3);
  Duration idle_limit = Duration::zero();  ///< wall time without request and subscription; zero: no limit
  api::Role max_role = api::Role::kAdmin;
  std::string certified_name;  ///< in the client's certificate; empty: it has shown none
  std::size_t in_flight = 64;
  double requests_per_s = 200.0;
  double request_burst = 400.0;
  std::size_t refused_requests = 2000;  ///< consecutive ones before the session is closed
  bool full = false;                    ///< true: hello is refused, since there are too many sessions
  bool stuck = false;                   ///< true: hello is refused, since the robot's control loop is stuck
};

/// Reason and manner of the end of a session.
struct Ending {
  seeker::v1::Close::Reason reason = seeker::v1::Close::REASON_PROTOCOL_ERROR;
  std::string text;
  bool goodbye = false;    ///< true: the client has left on purpose
  bool send_close = true;  ///< true: Close is sent before the connection is closed
};

/// What the server has to do after one input.
struct ServerStep {
  std::optional<seeker::v1::Envelope> send;
  std::optional<seeker::v1::Request> request;  ///< to be carried out, and then reported with answered()
  std::optional<seeker::v1::Request> refused;  ///< will not be carried out; `send` is its response
  bool opened = false;                         ///< true: hello was accepted
  std::optional<Ending> end;
};

class ServerSession {
 public:
  ServerSession(ServerSessionParams params, WallTime now);

  [[nodiscard]] ServerStep on_payload(std::string_view payload, WallTime now, RobotTime robot_now);
  /// To be called a few times per heartbeat.
  /// `loop_pass` counts the passes of the robot's control loop: without a new one since the last heartbeat no other is
  /// sent, so that a robot whose loop is stuck is silent.
  [[nodiscard]] ServerStep on_tick(WallTime now, RobotTime robot_now, std::uint64_t loop_pass, bool has_subscriptions);
  void on_sent(WallTime now) { liveness_.on_sent(now); }
  void answered();

  [[nodiscard]] bool open() const { return open_; }
  [[nodiscard]] const api::Caller& caller() const { return caller_; }
  [[nodiscard]] std::uint64_t instance() const { return instance_; }
  /// The minor version of the protocol that both sides speak.
  [[nodiscard]] std::uint32_t minor() const { return minor_; }
  /// Wall time since a frame of the client was received.
  [[nodiscard]] Duration silence(WallTime now) const { return liveness_.silence(now); }
  [[nodiscard]] bool stale(WallTime now) const { return liveness_.stale(now); }
  [[nodiscard]] std::uint64_t refused_requests() const { return refused_total_; }

 private:
  [[nodiscard]] ServerStep on_hello(const seeker::v1::Hello& hello);
  [[nodiscard]] ServerStep on_request(seeker::v1::Request& request, WallTime now, RobotTime robot_now);
  [[nodiscard]] ServerStep refuse_hello(seeker::v1::HelloReply::Status status, std::string message) const;
  [[nodiscard]] ServerStep refuse_request(seeker::v1::Request& request, RobotTime robot_now,
                                          seeker::v1::CommonError::Code code, const std::string& message);
  [[nodiscard]] seeker::v1::HelloReply reply_base() const;

  ServerSessionParams params_;
  Liveness liveness_;
  TokenBucket tokens_;
  TokenBucket urgent_tokens_;
  WallTime started_;
  WallTime last_request_;
  bool open_ = false;
  api::Caller caller_;
  std::uint64_t instance_ = 0;
  std::uint32_t minor_ = 0;
  std::optional<std::uint64_t> beat_pass_;  ///< the pass of the loop of the last heartbeat
  std::size_t in_flight_ = 0;
  std::size_t refused_in_a_row_ = 0;
  std::uint64_t refused_total_ = 0;
};

/// Fills the header of the response to a request.
void begin_response(const seeker::v1::RequestHeader& request, const std::string& robot_id, RobotTime received,
                    RobotTime now, seeker::v1::Response& response);

/// The role that a request needs. Every role may stop the robot.
[[nodiscard]] api::Role required_role(const seeker::v1::Request& request);
/// Whether a request stops the robot or engages the emergency stop: such requests are exempt from rate limits.
[[nodiscard]] bool is_urgent(const seeker::v1::Request& request);
/// Whether a name is one of a client: 1 to 64 printable ASCII characters without spaces.
[[nodiscard]] bool is_client_name(std::string_view name);
/// Whether a client whose certificate has the name `certified` may call itself `name`: so, or "CERTIFIED/..." for one
/// of its programs. An empty `certified` (no certificate) allows all.
[[nodiscard]] bool agrees_with_certificate(std::string_view name, std::string_view certified);
/// The name "CERTIFIED/PROGRAM" for a program that calls itself `program`, cut to the length of a client's name.
[[nodiscard]] std::string certified_client_name(std::string_view certified, std::string_view program);

}  // namespace seeker::wire
