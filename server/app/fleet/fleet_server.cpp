#include "server/app/fleet/fleet_server.hpp"

#include <optional>
#include <string>
#include <utility>

#include <boost/asio/post.hpp>

#include "common/log/log.hpp"
#include "common/net/connection.hpp"
#include "common/net/frame_queue.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/outcome.hpp"
#include "server/app/fleet/fleet_settings.hpp"

namespace seeker::app {
namespace {

namespace asio = boost::asio;

constexpr std::size_t kMaxPeers = 64;
/// Replies that a peer has not read yet; it asks one thing at a time, so more is malice.
constexpr std::size_t kMaxQueued = 16;
/// A manifest of the largest map, or a chunk with its frame.
constexpr std::size_t kMaxRequestBytes = 8UL << 20U;

/// Calls `go` with the value of a message; the outcome of one of them.
template <class T, class M, class Go>
Status with_value(const M& message, Go go) {
  const Result<T> value = wire::from_message<T>(message);
  return value ? go(*value) : Status(tl::unexpected<Error>(value.error()));
}

/// Writes the value of a result with `put`.
template <class T, class Put>
Status report(const Result<T>& result, Put put) {
  if (!result) {
    return tl::unexpected<Error>(result.error());
  }
  put(*result);
  return {};
}

Status announce(FleetLeader& leader, const api::FleetManifest& manifest, v1::FleetReply& reply) {
  return report(leader.announce(manifest), [&](const api::FleetAnswer& answer) {
    for (const api::FleetMissing& missing : answer.missing) {
      wire::write(missing, reply.add_missing());
    }
    wire::write(answer.fleet, reply.mutable_fleet());
  });
}

Status serve(FleetLeader& leader, const v1::FleetRequest& request, v1::FleetReply& reply) {
  const auto put_fleet = [&](const api::FleetStatus& fleet) { wire::write(fleet, reply.mutable_fleet()); };
  switch (request.call_case()) {
    case v1::FleetRequest::kAnnounce:
      return with_value<api::FleetManifest>(
          request.announce(), [&](const api::FleetManifest& manifest) { return announce(leader, manifest, reply); });
    case v1::FleetRequest::kChunk:
      return with_value<api::FleetChunk>(request.chunk(), [&](const api::FleetChunk& chunk) {
        return report(leader.receive(chunk), [&](std::uint64_t received) { reply.set_received_bytes(received); });
      });
    case v1::FleetRequest::kShare:
      return with_value<api::FleetShare>(request.share(), [&](const api::FleetShare& share) {
        return report(leader.share(share), [&](const api::FleetShared& shared) { wire::write(shared, &reply); });
      });
    case v1::FleetRequest::kSeen:
      return with_value<api::FleetSeen>(request.seen(), [&](const api::FleetSeen& seen) {
        return report(leader.seen(seen), [&](const api::FleetSightings& others) { wire::write(others, &reply); });
      });
    case v1::FleetRequest::kScene:
      return report(leader.scene(), [&](const api::FleetScene& scene) { wire::write(scene, &reply); });
    case v1::FleetRequest::kDecide:
      return with_value<api::FleetDecision>(request.decide(), [&](const api::FleetDecision& decision) {
        return report(leader.decide(decision), put_fleet);
      });
    case v1::FleetRequest::kStatus: put_fleet(leader.status()); return {};
    default: return fail(Errc::kInvalidArgument, "the main robot does not know this request");
  }
}

std::string essentials_of(const v1::FleetDecision& decision) {
  const std::string verb = decision.verb() == v1::FLEET_VERB_MERGE
                               ? "merge by hypothesis " + std::to_string(decision.hypothesis()) + ": "
                           : decision.verb() == v1::FLEET_VERB_SPLIT ? "split: "
                                                                     : "?: ";
  return wire::one_line(verb + "'" + decision.robot_id() + "'", api::kMaxAuditEssentials_bytes);
}

/// The robot in whose name a request speaks; nothing: in nobody's.
std::optional<std::string> sender_of(const v1::FleetRequest& request) {
  switch (request.call_case()) {
    case v1::FleetRequest::kAnnounce: return request.announce().robot_id();
    case v1::FleetRequest::kChunk: return request.chunk().robot_id();
    case v1::FleetRequest::kShare: return request.share().robot_id();
    case v1::FleetRequest::kSeen: return request.seen().robot_id();
    default: return std::nullopt;
  }
}

}  // namespace

Status may_ask(const pki::Certificate* peer, const v1::FleetRequest& request) {
  if (peer == nullptr) {
    return {};
  }
  const pki::CertificateFacts& facts = peer->facts();
  if (request.call_case() == v1::FleetRequest::kDecide) {
    return facts.role == pki::Role::kOperator || facts.role == pki::Role::kAdmin
               ? Status()
               : fail(Errc::kRefused, "the certificate of '" + facts.name +
                                          "' does not allow this; have one issued with --role operator");
  }
  const std::optional<std::string> robot = sender_of(request);
  if (robot && (facts.role != pki::Role::kRobot || *robot != facts.name)) {
    return fail(Errc::kRefused, "the certificate of '" + facts.name + "' does not allow to speak for the robot '" +
                                    *robot + "'; issue one of that name with --role robot");
  }
  return {};
}

v1::FleetReply answer_of(FleetLeader& leader, const v1::FleetRequest& request) {
  v1::FleetReply reply;
  const Status done = request.protocol() == wire::kFleetProtocol
                          ? serve(leader, request, reply)
                          : Status(fail(Errc::kUnsupportedVersion,
                                        "the robot speaks protocol " + std::to_string(request.protocol()) +
                                            " of fleets, the main one " + std::to_string(wire::kFleetProtocol) +
                                            "; use programs of one version"));
  wire::set_error(*reply.mutable_error(), done);
  return reply;
}

/// One connection.
struct FleetServer::Peer {
  explicit Peer(wire::AuditRows::Sink sink) : rows(std::move(sink)) {}

  std::shared_ptr<net::Connection> connection;
  std::shared_ptr<const pki::Certificate> certificate;  ///< null: plain TCP
  std::string address;
  wire::AuditRows rows;  ///< of its decisions
  net::FrameQueue outgoing{kMaxQueued};
};

FleetServer::FleetServer(FleetLeader& leader, Duration refresh_period, wire::AuditRows::Sink audit)
    : leader_(leader),
      listener_(io_, kFleetPart,
                {[this](net::Transport transport) { admit(std::move(transport)); }, [this] { check_certificates(); }}),
      timer_(io_),
      refresh_period_(refresh_period),
      audit_(audit ? std::move(audit) : [](const api::AuditRecord&) {}) {}

FleetServer::~FleetServer() {
  if (thread_.joinable()) {
    asio::post(io_, [this] { close_all(); });
    thread_.join();
  }
}

Result<std::uint16_t> FleetServer::start(const std::string& address, std::uint16_t port,
                                         const net::LinkSecurity& security) {
  Result<std::uint16_t> opened = listener_.open(address, port, security);
  if (opened) {
    listener_.accept();
    refresh();
    thread_ = std::thread([this] { io_.run(); });
  }
  return opened;
}

void FleetServer::refresh() {
  leader_.refresh();
  for (const auto& peer : peers_) {
    peer->rows.tick(net::wall_now());
  }
  timer_.expires_after(refresh_period_);
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error && !stopping_) {
      refresh();
    }
  });
}

void FleetServer::close_all() {
  stopping_ = true;
  timer_.cancel();
  listener_.close();
  for (const auto& peer : std::exchange(peers_, {})) {
    peer->connection->close();
    peer->rows.end();
  }
}

void FleetServer::check_certificates() {
  for (const auto& peer : std::set<std::shared_ptr<Peer>>(peers_)) {
    if (const Status believed = listener_.check(peer->certificate.get()); !believed) {
      log::warning(kFleetPart, "a connection was closed: " + believed.error().message);
      drop(peer);
    }
  }
}

void FleetServer::admit(net::Transport transport) {
  if (peers_.size() >= kMaxPeers) {
    return;  // closes it
  }
  net::ConnectionParams params;
  params.max_frame_bytes = kMaxRequestBytes;
  const auto peer = std::make_shared<Peer>(audit_);
  peer->certificate = transport.peer();
  peer->address = net::peer_address(transport);
  peer->connection = std::make_shared<net::Connection>(std::move(transport), params);
  // The handlers hold the peer until its connection is closed.
  net::Connection::Handlers handlers;
  handlers.on_frame = [this, peer](std::string_view payload) { on_frame(peer, payload); };
  handlers.next_frame = [peer] { return peer->outgoing.pop(); };
  handlers.on_end = [this, peer](const Error& /*error*/) { drop(peer); };
  peers_.insert(peer);
  peer->connection->start(std::move(handlers));
}

void FleetServer::on_frame(const std::shared_ptr<Peer>& peer, std::string_view payload) {
  v1::FleetRequest request;
  if (const Status parsed = wire::parse_within_limits(payload, request); !parsed) {
    log::info(kFleetPart, "a connection was closed: " + parsed.error().message);
    drop(peer);
    return;
  }
  if (const Status allowed = may_ask(peer->certificate.get(), request); !allowed) {
    v1::FleetReply refusal;
    wire::set_error(*refusal.mutable_error(), allowed);
    record(*peer, request, refusal.error());
    send(peer, refusal);
    return;
  }
  if (request.call_case() != v1::FleetRequest::kMap) {
    const v1::FleetReply reply = answer_of(leader_, request);
    record(*peer, request, reply.error());
    send(peer, reply);
    return;
  }
  leader_.map([this, peer](const Result<std::vector<std::uint8_t>>& file) {
    v1::FleetReply reply;
    wire::set_error(*reply.mutable_error(),
                    report(file, [&](const auto& bytes) { reply.set_file(bytes.data(), bytes.size()); }));
    asio::post(io_, [this, peer, reply = std::move(reply)] { send(peer, reply); });
  });
}

void FleetServer::record(Peer& peer, const v1::FleetRequest& request, const v1::CommonError& outcome) {
  if (request.call_case() != v1::FleetRequest::kDecide) {
    return;
  }
  api::AuditRecord record;
  record.unix_ns = net::unix_ns_now();
  if (peer.certificate) {
    const pki::CertificateFacts& facts = peer.certificate->facts();
    record.client = facts.name;
    record.certificate = facts.name;
    record.serial = facts.serial;
    record.role = facts.role ? pki::to_string(*facts.role) : "";
  }
  record.address = peer.address;
  record.call = "fleet_decide";
  record.essentials = essentials_of(request.decide());
  wire::set_outcome(record, wire::status_of(outcome));
  const std::string kind = record.call + " " + record.essentials;
  peer.rows.add(std::move(record), kind, net::wall_now());
}

void FleetServer::send(const std::shared_ptr<Peer>& peer, const v1::FleetReply& reply) {
  if (peer->connection->closed()) {
    return;
  }
  if (reply.ByteSizeLong() > wire::kMaxFrameBytes ||
      !peer->outgoing.push(wire::make_frame(reply.SerializeAsString()))) {
    drop(peer);
    return;
  }
  peer->connection->wake();
}

void FleetServer::drop(const std::shared_ptr<Peer>& peer) {
  peer->connection->close();
  peer->rows.end();
  peers_.erase(peer);
}

}  // namespace seeker::app
