#include "common/rpc/robot_link.hpp"

#include <utility>

#include "common/core/assert.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/limits.hpp"

namespace seeker::rpc {
namespace {

namespace pb = ::seeker::v1;

/// Wall time for goodbye to leave.
constexpr Duration kLinger = std::chrono::milliseconds(300);
constexpr std::size_t kMaxQueuedFrames = 1024;
constexpr std::size_t kMaxQueuedBytes = 64UL * 1024 * 1024;

}  // namespace

RobotLink::RobotLink(boost::asio::io_context& io, RobotLinkParams params, Handlers handlers)
    : io_(io),
      params_(std::move(params)),
      handlers_(std::move(handlers)),
      retry_(io),
      backoff_(params_.reconnect.first_delay, params_.reconnect.max_delay),
      outbox_(kMaxQueuedFrames, kMaxQueuedBytes) {}

void RobotLink::connect() {
  give_up_connecting_ = net::async_connect(
      io_, {params_.endpoint.host, params_.endpoint.port, params_.connect_timeout, params_.tls},
      [self = shared_from_this()](Result<net::Transport> transport) { self->on_connected(std::move(transport)); });
}

void RobotLink::on_connected(Result<net::Transport> transport) {
  if (closed_) {
    return;
  }
  if (transport) {
    start_session(std::move(*transport));
  } else {
    break_off(transport.error(), transport.error().code == Errc::kRefused);
  }
}

void RobotLink::start_session(net::Transport transport) {
  session_.emplace(params_.session, net::wall_now());
  outbox_ = wire::Outbox(kMaxQueuedFrames, kMaxQueuedBytes);
  connection_ = std::make_shared<net::Connection>(std::move(transport), net::ConnectionParams{});
  const std::uint64_t number = ++connection_number_;
  const auto self = shared_from_this();
  const bool pushed = send(session_->hello());
  SEEKER_ASSERT(pushed);
  connection_->start(
      {[self, number](std::string_view payload) {
         if (number == self->connection_number_ && self->session_) {
           self->act(self->session_->on_payload(payload, net::wall_now()));
         }
       },
       [self, number] { return number == self->connection_number_ ? self->outbox_.pop() : std::nullopt; },
       [self, number](std::size_t) {
         if (number == self->connection_number_ && self->session_) {
           self->session_->on_sent(net::wall_now());
         }
       },
       [self, number](const Error& error) {
         if (number == self->connection_number_) {
           const bool refused = error.code == Errc::kRefused;  // asking again would change nothing
           self->break_off({refused ? error.code : Errc::kLinkLost, error.message}, refused);
         }
       }});
}

void RobotLink::act(wire::ClientStep step) {
  if (closed_) {
    return;
  }
  if (step.opened) {
    opened_at_ = net::wall_now();
    was_open_ = true;
    handlers_.opened();
  }
  if (step.update && handlers_.update) {
    handlers_.update(*step.update);
  }
  if (step.send) {
    (void)send(*step.send);
  }
  if (step.end && !closed_) {
    break_off(*step.end, step.final_end);
  }
}

bool RobotLink::send(const pb::Envelope& envelope) {
  Result<wire::OutFrame> frame = wire::frame_of(envelope);
  if (!frame || !outbox_.push(std::move(*frame))) {
    return false;
  }
  connection_->wake();
  return true;
}

void RobotLink::call(pb::Request request, Duration timeout, wire::ClientSession::Answer answer) {
  if (closed_ || !open()) {
    answer(closed_ ? fail(Errc::kCancelled, "the client was closed")
                   : fail(Errc::kLinkLost, "there is no connection to the robot now; it is tried again"));
    return;
  }
  if (request.ByteSizeLong() + wire::kMaxTextBytes > wire::kMaxFrameBytes) {
    answer(fail(Errc::kTooLarge, "the request has more than the 16 MiB of one frame; give smaller pictures"));
    return;
  }
  if (!send(session_->call(std::move(request), net::wall_now(), timeout, std::move(answer)))) {
    break_off({Errc::kLinkLost, "the robot does not read: too many requests wait to be sent"}, false);
  }
}

void RobotLink::tick(wire::WallTime now) {
  if (!session_) {
    return;
  }
  const std::uint64_t number = connection_number_;
  wire::ClientStep step = session_->on_tick(now);
  // An answer to a call that took too long may have ended this session.
  if (number == connection_number_) {
    act(std::move(step));
  }
}

void RobotLink::break_off(const Error& error, bool final_end) {
  if (closed_) {
    return;
  }
  if (connection_) {
    connection_->close();
    connection_.reset();
  }
  ++connection_number_;
  // Taken out first: an answer may make the next call at once.
  std::optional<wire::ClientSession> ended = std::exchange(session_, std::nullopt);
  const bool again = params_.reconnect.enabled && !final_end && (was_open_ || params_.persistent);
  handlers_.broken(error, again);
  if (ended) {
    ended->fail_all({Errc::kLinkLost, error.message});
  }
  if (again && !closed_) {
    retry();
  }
}

void RobotLink::retry() {
  const auto opened_at = std::exchange(opened_at_, std::nullopt);
  retry_.expires_after(opened_at ? backoff_.after(net::wall_now() - *opened_at) : backoff_.next());
  retry_.async_wait([self = shared_from_this()](boost::system::error_code cancelled) {
    if (!cancelled && !self->closed_) {
      self->connect();
    }
  });
}

void RobotLink::close() {
  if (std::exchange(closed_, true)) {
    return;
  }
  retry_.cancel();
  if (give_up_connecting_) {
    give_up_connecting_();
  }
  if (session_) {
    session_->fail_all({Errc::kCancelled, "the client was closed"});
  }
  if (connection_) {
    pb::Envelope goodbye;
    goodbye.mutable_close()->set_reason(pb::Close::REASON_GOODBYE);
    (void)send(goodbye);
    connection_->finish(kLinger);
    connection_.reset();
  }
  session_.reset();
  handlers_ = {};
}

}  // namespace seeker::rpc
