/// \file
/// One session with a robot over one connection, which is made again when it breaks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/net/connect.hpp"
#include "common/net/connection.hpp"
#include "common/rpc/endpoint.hpp"
#include "common/rpc/robot_client.hpp"
#include "common/wire/client_session.hpp"
#include "common/wire/outbox.hpp"

namespace seeker::rpc {

/// How to connect, and as whom.
struct RobotLinkParams {
  Endpoint endpoint;
  wire::ClientSessionParams session;
  std::optional<pki::BundleFiles> tls;
  Duration connect_timeout = std::chrono::seconds(3);  ///< wall time for address look-up and connection
  ReconnectParams reconnect;
  bool persistent = false;  ///< true: also a first connection that fails is tried again
};

/// All of it runs on the thread of the io_context.
class RobotLink : public std::enable_shared_from_this<RobotLink> {
 public:
  struct Handlers {
    std::function<void()> opened;  ///< hello was answered: calls may be made
    std::function<void(const seeker::v1::StreamUpdate&)> update;
    std::function<void(const Error& why, bool again)> broken;  ///< `again`: it is being tried again
  };

  RobotLink(boost::asio::io_context& io, RobotLinkParams params, Handlers handlers);

  void connect();
  /// Sends a request; its answer has `timeout`. An answer of kLinkLost comes at once where there is no session.
  void call(seeker::v1::Request request, Duration timeout, wire::ClientSession::Answer answer);
  /// To be called a few times per heartbeat.
  void tick(wire::WallTime now);
  /// Ends the session on purpose and its calls with kCancelled. No handler is called afterwards.
  void close();

  /// Whether calls can be made now.
  [[nodiscard]] bool open() const { return session_ && session_->open(); }
  [[nodiscard]] bool stale(wire::WallTime now) const { return session_ && session_->stale(now); }
  /// Only while it is open.
  [[nodiscard]] const wire::ClientSession& session() const { return *session_; }

 private:
  void on_connected(Result<net::Transport> transport);
  void start_session(net::Transport transport);
  void act(wire::ClientStep step);
  void break_off(const Error& error, bool final_end);
  void retry();
  bool send(const seeker::v1::Envelope& envelope);

  boost::asio::io_context& io_;
  RobotLinkParams params_;
  Handlers handlers_;
  std::function<void()> give_up_connecting_;
  boost::asio::steady_timer retry_;
  net::Backoff backoff_;
  std::optional<wire::WallTime> opened_at_;  ///< when the session that there is was opened
  std::shared_ptr<net::Connection> connection_;
  std::optional<wire::ClientSession> session_;
  std::uint64_t connection_number_ = 0;  ///< distinguishes late handlers of a former connection
  wire::Outbox outbox_;
  bool was_open_ = false;
  bool closed_ = false;
};

}  // namespace seeker::rpc
