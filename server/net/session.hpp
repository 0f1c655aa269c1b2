/// \file
/// One client: its connection, its protocol state, its streams and its RobotApi.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include <boost/asio/io_context.hpp>

#include "common/api/robot_api.hpp"
#include "common/net/connection.hpp"
#include "common/wire/outbox.hpp"
#include "common/wire/outcome.hpp"
#include "common/wire/server_session.hpp"
#include "common/wire/stream_sender.hpp"
#include "server/net/once_calls.hpp"
#include "server/net/server.hpp"
#include "server/net/session_audit.hpp"

namespace seeker::server_net {

class Session;

/// State that all sessions of a server share; used on the network thread.
struct SessionHub {
  const ServerParams& params;
  api::RobotHost& host;
  std::shared_ptr<boost::asio::io_context> io;
  const wire::Backlogs& backlogs;
  api::RobotInfo robot;
  std::uint64_t stream_id = 0;
  std::function<RobotTime()> robot_now;
  std::function<std::uint64_t()> loop_pass;
  bool loop_stuck = false;  ///< no pass of the control loop for ServerParams::lost_after
  std::function<void(const std::shared_ptr<Session>&)> opened;
  std::function<void(const std::shared_ptr<Session>&, const wire::Ending&)> ended;
  ServerStats stats;
  /// By topic: what a new subscriber gets at once, since a robot that stands still in a simulation publishes nothing
  /// more. Null for RELIABLE topics, which are resumed, and for tiles, which get_tiles gives.
  std::array<api::UpdatePtr, api::kTopicCount> newest;
  OnceCalls once_calls;
};

/// All methods run on the network thread.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(SessionHub& hub, net::Transport transport, bool full);

  void start();
  void tick(wire::WallTime now);
  /// Sends the reason and closes. Further calls have no effect.
  void end(const wire::Ending& ending);

  void offer(api::Topic topic, std::uint64_t sequence, const wire::SharedBody& body) {
    streams_.offer(topic, sequence, body);
  }
  void offer_tiles(const wire::EncodedTiles& tiles) { streams_.offer_tiles(tiles); }
  /// Writes new items of streams, or ends the session when the client is too far behind.
  void wake();

  /// Sends a response of a handler. The last response of a request allows another request.
  void respond(const seeker::v1::Response& response, wire::CallNumber call, bool last = true);
  [[nodiscard]] api::RobotApi& robot() { return *robot_; }
  [[nodiscard]] wire::StreamSender& streams() { return streams_; }
  [[nodiscard]] const SessionHub& hub() const { return hub_; }
  [[nodiscard]] OnceCalls& once_calls() { return hub_.once_calls; }
  /// Bytes of answers that the client has not taken yet.
  [[nodiscard]] std::size_t queued_bytes() const { return outbox_.bytes(); }
  [[nodiscard]] bool open() const { return session_.open(); }
  [[nodiscard]] wire::WallTime since() const { return since_; }
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] const api::Caller& caller() const { return session_.caller(); }
  [[nodiscard]] std::uint64_t instance() const { return session_.instance(); }
  [[nodiscard]] std::uint32_t minor() const { return session_.minor(); }
  /// The client has compared the clocks in this session.
  [[nodiscard]] bool time_synced() const { return time_synced_; }
  void note_time_sync() { time_synced_ = true; }
  [[nodiscard]] Duration silence(wire::WallTime now) const { return session_.silence(now); }
  [[nodiscard]] bool stale(wire::WallTime now) const { return session_.stale(now); }
  /// The client's certificate; null: plain TCP.
  [[nodiscard]] const pki::Certificate* certificate() const { return certificate_.get(); }

 private:
  void on_payload(std::string_view payload);
  void act(wire::ServerStep step);
  void send(const seeker::v1::Envelope& envelope);
  [[nodiscard]] std::optional<wire::OutFrame> next_frame();
  void wake_at(wire::WallTime due);
  [[nodiscard]] AuditClocks clocks() const;

  SessionHub& hub_;
  wire::WallTime since_;  ///< when it connected
  std::shared_ptr<const pki::Certificate> certificate_;
  SessionAudit audit_;
  wire::ServerSession session_;
  wire::Outbox outbox_;
  wire::StreamSender streams_;
  std::shared_ptr<net::Connection> connection_;
  std::shared_ptr<api::RobotApi> robot_;
  boost::asio::steady_timer due_;
  bool time_synced_ = false;
  bool ended_ = false;
};

}  // namespace seeker::server_net
