#include "server/net/session.hpp"

#include <algorithm>
#include <utility>

#include "common/wire/outcome.hpp"
#include "server/net/handlers.hpp"

namespace seeker::server_net {
namespace {

namespace pb = ::seeker::v1;

/// What a certificate allows a client of the robot. Another robot has nothing to command here.
api::Role role_of(const pki::Certificate& certificate) {
  switch (certificate.facts().role.value_or(pki::Role::kObserver)) {
    case pki::Role::kOperator: return api::Role::kOperator;
    case pki::Role::kAdmin: return api::Role::kAdmin;
    case pki::Role::kObserver:
    case pki::Role::kRobot: return api::Role::kObserver;
  }
  return api::Role::kObserver;
}

wire::ServerSessionParams session_params(const SessionHub& hub, const pki::Certificate* certificate, bool full) {
  const ServerParams& p = hub.params;
  wire::ServerSessionParams out;
  out.robot = hub.robot;
  out.stream_id = hub.stream_id;
  out.liveness = {p.heartbeat, p.lost_after};
  out.hello_timeout = p.session.hello_timeout;
  out.idle_limit = p.session.idle_limit;
  out.max_role = p.max_role;
  if (certificate != nullptr) {
    out.max_role = std::min(p.max_role, role_of(*certificate));
    out.certified_name = certificate->facts().name;
  }
  out.in_flight = p.session.in_flight;
  out.requests_per_s = p.session.requests_per_s;
  out.request_burst = p.session.request_burst;
  out.refused_requests = p.session.refused_requests;
  out.full = full;
  out.stuck = hub.loop_stuck;
  return out;
}

/// What a broken connection means for the session.
wire::Ending ending_of(const Error& error) {
  wire::Ending ending;
  ending.text = error.message;
  ending.send_close = error.code != Errc::kLinkLost && error.code != Errc::kRefused;
  ending.reason = error.code == Errc::kTooLarge  ? pb::Close::REASON_FRAME_TOO_LARGE
                  : error.code == Errc::kTimeout ? pb::Close::REASON_TOO_SLOW
                                                 : pb::Close::REASON_SILENT;
  return ending;
}

}  // namespace

Session::Session(SessionHub& hub, net::Transport transport, bool full)
    : hub_(hub),
      since_(net::wall_now()),
      certificate_(transport.peer()),
      audit_([&hub](const api::AuditRecord& record) { hub.host.commanded(record); }, net::peer_address(transport),
             certificate_ ? &certificate_->facts() : nullptr),
      session_(session_params(hub, certificate_.get(), full), since_),
      outbox_(hub.params.session.queued_replies, hub.params.session.queued_bytes),
      streams_(hub.backlogs, hub.stream_id, &hub.stats.dropped),
      connection_(std::make_shared<net::Connection>(
          std::move(transport), net::ConnectionParams{wire::kMaxFrameBytes, hub.params.session.write_timeout})),
      due_(*hub.io) {}

void Session::start() {
  const auto self = shared_from_this();
  connection_->start({[self](std::string_view payload) { self->on_payload(payload); },
                      [self] { return self->next_frame(); },
                      [self](std::size_t bytes) {
                        ++self->hub_.stats.frames_sent;
                        self->hub_.stats.bytes_sent += bytes;
                        self->session_.on_sent(net::wall_now());
                      },
                      [self](const Error& error) { self->end(ending_of(error)); }});
}

void Session::on_payload(std::string_view payload) {
  act(session_.on_payload(payload, net::wall_now(), hub_.robot_now()));
}

void Session::tick(wire::WallTime now) {
  if (!ended_) {
    audit_.tick(now);
    act(session_.on_tick(now, hub_.robot_now(), hub_.loop_pass(), streams_.subscriptions() > 0));
  }
}

void Session::act(wire::ServerStep step) {
  if (ended_) {
    return;
  }
  if (step.opened) {
    robot_ = hub_.host.open(session_.caller());
    hub_.opened(shared_from_this());
  }
  if (step.send) {
    hub_.stats.refused_requests += step.send->has_response() ? 1 : 0;
    if (step.refused) {
      audit_.refused(*step.refused, step.send->response(), session_.caller(), clocks());
    }
    send(*step.send);
  }
  if (step.request && !ended_) {
    if (!hub_.once_calls.known(*step.request)) {
      audit_.asked(*step.request, session_.caller(), clocks());
    }
    handle(shared_from_this(), *step.request, hub_.robot_now());
  }
  if (step.end) {
    end(*step.end);
  }
}

void Session::send(const pb::Envelope& envelope) {
  if (ended_) {
    return;
  }
  Result<wire::OutFrame> frame = wire::frame_of(envelope);
  if (!frame || !outbox_.push(std::move(*frame))) {
    end({pb::Close::REASON_TOO_SLOW, "the client does not read its answers", false, true});
    return;
  }
  connection_->wake();
}

void Session::respond(const pb::Response& response, wire::CallNumber call, bool last) {
  if (last) {
    session_.answered();
    audit_.answered(response, clocks());
  }
  pb::Envelope envelope;
  *envelope.mutable_response() = response;
  if (envelope.ByteSizeLong() > wire::kMaxFrameBytes) {
    pb::Response small;
    *small.mutable_header() = response.header();
    wire::set_outcome(small, call,
                      fail(Errc::kTooLarge, "the answer has " + std::to_string(envelope.ByteSizeLong()) +
                                                " bytes, more than the 16 MiB of one frame"));
    *envelope.mutable_response() = std::move(small);
  }
  send(envelope);
}

std::optional<wire::OutFrame> Session::next_frame() {
  if (auto frame = outbox_.pop()) {
    return frame;
  }
  if (ended_) {
    return std::nullopt;
  }
  const wire::WallTime now = net::wall_now();
  auto frame = streams_.next(now);
  if (!frame) {
    if (const auto due = streams_.next_due(); due && *due > now) {
      wake_at(*due);
    }
  }
  return frame;
}

void Session::wake_at(wire::WallTime due) {
  due_.expires_at(std::chrono::time_point_cast<std::chrono::steady_clock::duration>(due));
  due_.async_wait([weak = weak_from_this()](boost::system::error_code error) {
    const auto self = weak.lock();
    if (!error && self && !self->ended_) {
      self->connection_->wake();
    }
  });
}

void Session::wake() {
  if (ended_) {
    return;
  }
  if (const auto topic = streams_.overrun()) {
    end({pb::Close::REASON_TOO_SLOW,
         "the client reads too slowly for the topic " + std::string(api::to_string(*topic)) +
             "; connect again and resume",
         false, true});
    return;
  }
  connection_->wake();
}

AuditClocks Session::clocks() const { return {net::unix_ns_now(), hub_.robot_now(), net::wall_now()}; }

void Session::end(const wire::Ending& ending) {
  if (std::exchange(ended_, true)) {
    return;
  }
  due_.cancel();
  audit_.end(clocks());
  if (ending.send_close) {
    pb::Envelope envelope;
    envelope.mutable_close()->set_reason(ending.reason);
    envelope.mutable_close()->set_message(ending.text);
    if (auto frame = wire::frame_of(envelope)) {
      outbox_.replace_all(std::move(*frame));
    }
  }
  // Refused hellos leave a reply in the outbox, all others at most a close: let it go, then close.
  connection_->finish(hub_.params.linger);
  hub_.ended(shared_from_this(), ending);
  robot_.reset();
}

}  // namespace seeker::server_net
