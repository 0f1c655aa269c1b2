#include "server/emulator/emulator_server.hpp"

#include <algorithm>
#include <utility>

#include <boost/asio/post.hpp>

#include "common/log/log.hpp"
#include "common/net/connection.hpp"
#include "common/net/frame_queue.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/outcome.hpp"
#include "server/drivers/emulator/emulator_wire.hpp"

namespace seeker::emulator {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

constexpr std::string_view kPart = "emulator";
constexpr Duration kLinger = std::chrono::milliseconds(500);
/// Replies that a robot has not read yet; it makes one request at a time, so more is malice.
constexpr std::size_t kMaxQueued = 64;
/// After a pause the world starts afresh and does not hurry to catch up.
constexpr Duration kMaxLag = std::chrono::milliseconds(250);

/// The world is for robots, not for the people who command them.
Status may_enter(const pki::Certificate* certificate) {
  return certificate == nullptr || certificate->facts().role == pki::Role::kRobot
             ? Status()
             : fail(Errc::kRefused, "the certificate of '" + certificate->facts().name +
                                        "' is not a robot's; issue one with --role robot");
}

}  // namespace

/// One connection.
struct EmulatorServer::Peer {
  Peer(asio::io_context& io, std::shared_ptr<net::Connection> with) : connection(std::move(with)), hello(io) {}
  std::shared_ptr<net::Connection> connection;
  std::shared_ptr<const pki::Certificate> certificate;  ///< null: plain TCP
  asio::steady_timer hello;                             ///< until it must have said who it is
  std::optional<std::size_t> robot;
  net::FrameQueue outgoing{kMaxQueued};
};

EmulatorServer::EmulatorServer(WorldHost& host, EmulatorServerParams params)
    : host_(host),
      params_(std::move(params)),
      listener_(io_, kPart,
                {[this](net::Transport transport) { admit(std::move(transport)); }, [this] { check_certificates(); }}),
      pace_(io_) {}

EmulatorServer::~EmulatorServer() = default;

Result<std::uint16_t> EmulatorServer::listen() {
  Result<std::uint16_t> port = listener_.open(params_.address, params_.port, params_.security);
  if (port) {
    listener_.accept();
    if (!params_.lockstep) {
      step_live();
    }
  }
  return port;
}

void EmulatorServer::run() { io_.run(); }

void EmulatorServer::stop() {
  asio::post(io_, [this] { close_all(); });
}

void EmulatorServer::close_all() {
  stopping_ = true;
  listener_.close();
  pace_.cancel();
  for (const auto& peer : std::exchange(peers_, {})) {
    peer->hello.cancel();
    peer->connection->close();
  }
  robots_.clear();
}

void EmulatorServer::check_certificates() {
  for (const auto& peer : std::set<std::shared_ptr<Peer>>(peers_)) {
    if (const Status believed = listener_.check(peer->certificate.get()); !believed) {
      drop(peer, believed.error().message);
    }
  }
}

void EmulatorServer::admit(net::Transport transport) {
  net::ConnectionParams params;
  params.max_frame_bytes = drivers::kMaxEmulatorRequestBytes;
  const std::shared_ptr<const pki::Certificate> certificate = transport.peer();
  const auto peer = std::make_shared<Peer>(io_, std::make_shared<net::Connection>(std::move(transport), params));
  peer->certificate = certificate;
  // The handlers hold the peer until its connection is closed.
  net::Connection::Handlers handlers;
  handlers.on_frame = [this, peer](std::string_view payload) { on_frame(peer, payload); };
  handlers.next_frame = [peer] { return peer->outgoing.pop(); };
  handlers.on_end = [this, peer](const Error& error) { drop(peer, error.message); };
  peer->hello.expires_after(params_.hello_timeout);
  peer->hello.async_wait([this, peer](error_code error) {
    if (!error && !peer->robot) {
      drop(peer, "it did not say which robot it is");
    }
  });
  peers_.insert(peer);
  peer->connection->start(std::move(handlers));
}

void EmulatorServer::on_frame(const std::shared_ptr<Peer>& peer, std::string_view payload) {
  v1::EmulatorRequest request;
  if (const Status parsed = wire::parse_within_limits(payload, request); !parsed) {
    drop(peer, parsed.error().message);
    return;
  }
  if (!peer->robot) {
    greet(peer, request);
    return;
  }
  if (const std::optional<v1::EmulatorReply> reply = host_.handle(*peer->robot, request)) {
    send(peer, *reply);
  }
  schedule_step();
}

void EmulatorServer::greet(const std::shared_ptr<Peer>& peer, const v1::EmulatorRequest& request) {
  const Status allowed = may_enter(peer->certificate.get());
  const Result<std::size_t> robot = !allowed ? Result<std::size_t>(tl::unexpected<Error>(allowed.error()))
                                    : request.has_hello()
                                        ? host_.enter(request.hello())
                                        : fail(Errc::kInvalidArgument, "the first request must be a hello");
  if (!robot) {
    v1::EmulatorReply refusal;
    refusal.set_id(request.id());
    wire::set_error(*refusal.mutable_error(), tl::unexpected<Error>(robot.error()));
    log::info(kPart, "a robot was refused: " + robot.error().message);
    send(peer, refusal);
    peer->hello.cancel();
    peer->connection->finish(kLinger);
    peers_.erase(peer);
    return;
  }
  if (const auto before = robots_.find(*robot); before != robots_.end()) {
    // The same program has connected again; its former connection may still look alive.
    before->second->robot.reset();
    before->second->connection->close();
    peers_.erase(before->second);
  }
  peer->hello.cancel();
  peer->robot = *robot;
  robots_[*robot] = peer;
  log::info(kPart, "robot " + std::to_string(*robot) + " is here");
  send(peer, host_.welcome(request.id()));
}

void EmulatorServer::send(const std::shared_ptr<Peer>& peer, const v1::EmulatorReply& reply) {
  if (!peer->outgoing.push(wire::make_frame(reply.SerializeAsString()))) {
    drop(peer, "it does not read its replies");
    return;
  }
  peer->connection->wake();
}

void EmulatorServer::drop(const std::shared_ptr<Peer>& peer, const std::string& why) {
  peer->hello.cancel();
  peer->connection->close();
  peers_.erase(peer);
  if (!peer->robot) {
    log::info(kPart, "a connection ended: " + why);
    return;
  }
  log::info(kPart, "robot " + std::to_string(*peer->robot) + " is gone: " + why);
  host_.leave(*peer->robot);
  robots_.erase(*peer->robot);
  peer->robot.reset();
  schedule_step();
}

void EmulatorServer::schedule_step() {
  if (stopping_ || !params_.lockstep || step_scheduled_ || !host_.next()) {
    return;
  }
  step_scheduled_ = true;
  const auto go = [this] {
    step_scheduled_ = false;
    if (stopping_) {
      return;
    }
    // Somebody may have come, or come back, meanwhile.
    if (const std::optional<RobotTime> to = host_.next()) {
      const Duration period = *to - host_.world().now();
      step(*to);
      if (params_.speed > 0.0) {
        pace(period);
      }
    }
    schedule_step();
  };
  if (params_.speed > 0.0 && pace_.expiry() > net::wall_now()) {
    pace_.async_wait([go](error_code error) {
      if (!error) {
        go();
      }
    });
  } else {
    asio::post(io_, go);
  }
}

void EmulatorServer::pace(Duration period) {
  const auto wall = net::wall_now();
  const auto last = wall - pace_.expiry() > kMaxLag ? wall : pace_.expiry();
  pace_.expires_at(last + seconds(to_seconds(period) / params_.speed));
}

void EmulatorServer::step(RobotTime to) {
  for (const auto& [robot, reply] : host_.go_on(to)) {
    if (const auto peer = robots_.find(robot); peer != robots_.end()) {
      send(std::shared_ptr<Peer>(peer->second), reply);
    }
  }
  if (on_step) {
    on_step();
  }
}

void EmulatorServer::step_live() {
  pace(params_.live_step);
  pace_.async_wait([this](error_code error) {
    if (!error && !stopping_) {
      step(host_.world().now() + params_.live_step);
      step_live();
    }
  });
}

}  // namespace seeker::emulator
