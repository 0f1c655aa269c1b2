/// \file
/// The client's side of one connection as a state machine: hello, heartbeats, matching of answers. No sockets.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/api/robot_api.hpp"
#include "common/wire/liveness.hpp"
#include "seeker/v1/session.pb.h"

namespace seeker::wire {

struct ClientSessionParams {
  std::string client_name;
  std::string robot_id;  ///< expected; empty: any
  std::uint64_t instance = 0;
  api::Role role = api::Role::kOperator;
  LivenessParams liveness;
};

/// What the client has to do after one input.
struct ClientStep {
  std::optional<seeker::v1::Envelope> send;
  bool opened = false;  ///< true: the robot has accepted hello
  std::optional<seeker::v1::StreamUpdate> update;
  std::optional<Error> end;  ///< why the connection is to be closed; empty: it is not
  bool final_end = false;    ///< true: another attempt to connect would fail as well
};

class ClientSession {
 public:
  /// Receives all responses of a call together; called once.
  using Answer = std::function<void(Result<std::vector<seeker::v1::Response>>)>;

  ClientSession(ClientSessionParams params, WallTime now);

  /// The first message of the client.
  [[nodiscard]] seeker::v1::Envelope hello() const;
  /// Completes the header of a request and remembers who waits for its answer.
  [[nodiscard]] seeker::v1::Envelope call(seeker::v1::Request request, WallTime now, Duration timeout, Answer answer);
  [[nodiscard]] ClientStep on_payload(std::string_view payload, WallTime now);
  [[nodiscard]] ClientStep on_tick(WallTime now);
  void on_sent(WallTime now) { liveness_.on_sent(now); }
  /// Ends all open calls with `error`.
  void fail_all(const Error& error);

  [[nodiscard]] bool open() const { return open_; }
  [[nodiscard]] bool stale(WallTime now) const { return liveness_.stale(now); }
  [[nodiscard]] std::size_t open_calls() const { return pending_.size(); }
  /// Identity of the robot, from the accepted hello.
  [[nodiscard]] const api::RobotInfo& robot() const { return robot_; }
  [[nodiscard]] api::Role role() const { return role_; }
  [[nodiscard]] std::uint64_t stream_id() const { return stream_id_; }

 private:
  struct Pending {
    int call = 0;
    WallTime deadline;
    Duration timeout{};
    Answer answer;
    std::vector<seeker::v1::Response> parts;
  };

  [[nodiscard]] ClientStep on_hello(const seeker::v1::HelloReply& reply);
  [[nodiscard]] ClientStep on_response(seeker::v1::Response& response, WallTime now);

  ClientSessionParams params_;
  Liveness liveness_;
  bool open_ = false;
  api::RobotInfo robot_;
  api::Role role_ = api::Role::kObserver;
  std::uint64_t stream_id_ = 0;
  std::uint64_t next_request_ = 1;
  std::map<std::uint64_t, Pending> pending_;
};

}  // namespace seeker::wire
