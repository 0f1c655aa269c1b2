/// \file
/// Where other robots, and the operator's program, reach the main robot of a fleet.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/net/listen.hpp"
#include "common/wire/audit_rows.hpp"
#include "seeker/v1/fleet.pb.h"
#include "server/app/fleet/fleet_leader.hpp"

namespace seeker::app {

/// One thread does its network work: it alone uses the connections and calls the leader, so that there is no mutex. The
/// leader's worker hands a joint map over by posting to that thread. start() and the end are for the owner's thread. A
/// connection that sends what is no request is closed; the others do not notice.
class FleetServer {
 public:
  /// `leader` must outlive this; its own robot receives a view of the others every `refresh_period` of wall time.
  /// `audit` receives each decision of an operator, also those that are refused; it may be empty.
  FleetServer(FleetLeader& leader, Duration refresh_period, wire::AuditRows::Sink audit = {});
  FleetServer(const FleetServer&) = delete;
  FleetServer& operator=(const FleetServer&) = delete;
  /// Closes all connections.
  ~FleetServer();

  /// Listens and starts the thread; the answer is the port.
  [[nodiscard]] Result<std::uint16_t> start(const std::string& address, std::uint16_t port,
                                            const net::LinkSecurity& security = {});

 private:
  struct Peer;
  void admit(net::Transport transport);
  /// Drops those who are not believed any more.
  void check_certificates();
  void on_frame(const std::shared_ptr<Peer>& peer, std::string_view payload);
  void send(const std::shared_ptr<Peer>& peer, const v1::FleetReply& reply);
  /// Has a decision recorded; other requests are left out.
  static void record(Peer& peer, const v1::FleetRequest& request, const v1::CommonError& outcome);
  void drop(const std::shared_ptr<Peer>& peer);
  void close_all();
  void refresh();

  FleetLeader& leader_;
  boost::asio::io_context io_{1};
  net::Listener listener_;
  boost::asio::steady_timer timer_;
  Duration refresh_period_;
  wire::AuditRows::Sink audit_;  ///< not empty
  std::set<std::shared_ptr<Peer>> peers_;
  bool stopping_ = false;
  std::thread thread_;
};

/// Whether the owner of a certificate may make a request: a robot speaks for itself alone, decisions need an operator,
/// reading needs any certificate. Null (plain TCP) may do everything. kRefused names the remedy.
[[nodiscard]] Status may_ask(const pki::Certificate* peer, const v1::FleetRequest& request);

/// The reply to everything but a map, which comes later.
[[nodiscard]] v1::FleetReply answer_of(FleetLeader& leader, const v1::FleetRequest& request);

}  // namespace seeker::app
