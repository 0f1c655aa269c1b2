#include "common/rpc/client_impl.hpp"

#include <algorithm>
#include <future>
#include <utility>

#include <boost/asio/post.hpp>

#include "common/log/log.hpp"
#include "common/net/random_id.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/outcome.hpp"
#include "common/wire/server_session.hpp"

namespace seeker::rpc {
namespace {

namespace asio = boost::asio;
namespace pb = ::seeker::v1;
using boost::system::error_code;

constexpr std::string_view kPart = "rpc";
constexpr int kTicksPerHeartbeat = 5;
constexpr Duration kMinTick = std::chrono::milliseconds(5);
constexpr Duration kMaxTick = std::chrono::milliseconds(100);
/// Wall time for goodbye to leave.
constexpr Duration kLinger = std::chrono::milliseconds(300);
constexpr std::size_t kMaxQueuedFrames = 1024;
constexpr std::size_t kMaxQueuedBytes = 64UL * 1024 * 1024;
/// Lost after so many heartbeats without a sign of life, as the robot does by default.
constexpr int kLostHeartbeats = 3;

}  // namespace

std::string_view to_string(LinkState state) {
  switch (state) {
    case LinkState::kConnected: return "connected";
    case LinkState::kStale: return "stale";
    case LinkState::kLost: return "lost";
    case LinkState::kClosed: return "closed";
  }
  return "closed";
}

RobotClient::Impl::Impl(Endpoint endpoint, ClientParams params)
    : endpoint_(std::move(endpoint)),
      params_(std::move(params)),
      instance_(net::random_id()),
      io_(1),
      work_(asio::make_work_guard(io_)),
      tick_(io_),
      retry_(io_),
      backoff_(params_.reconnect.first_delay, params_.reconnect.max_delay),
      outbox_(kMaxQueuedFrames, kMaxQueuedBytes) {}

RobotClient::Impl::~Impl() {
  if (thread_.joinable()) {
    thread_.detach();  // only when the last owner was the thread itself, which ends now
  }
}

Status RobotClient::Impl::take_certified_name() {
  if (!params_.tls) {
    return {};
  }
  const Result<pki::Certificate> own = pki::Certificate::read(params_.tls->certificate);
  if (!own) {
    return fail(own.error().code == Errc::kNotFound ? Errc::kInvalidArgument : own.error().code,
                own.error().message + "; have a bundle issued with 'seeker pki issue'");
  }
  params_.client_name = wire::certified_client_name(own->facts().name, params_.client_name);
  return {};
}

Status RobotClient::Impl::open() {
  if (Status named = take_certified_name(); !named) {
    return named;
  }
  if (!wire::is_client_name(params_.client_name)) {
    return fail(Errc::kInvalidArgument, "the client name must have 1 to 64 printable characters without spaces");
  }
  auto promise = std::make_shared<std::promise<Status>>();
  std::future<Status> first = promise->get_future();
  on_first_ = [promise](Status result) { promise->set_value(std::move(result)); };
  asio::post(io_, [this] {
    connect_now();
    tick();
  });
  // The thread keeps the object alive: a callback may drop the last reference to the client.
  thread_ = std::thread([self = shared_from_this()] { self->io_.run(); });
  if (first.wait_for(params_.connect_timeout) != std::future_status::ready) {
    return fail(Errc::kTimeout, "no hello from " + rpc::to_string(endpoint_) + " in " +
                                    std::to_string(to_seconds(params_.connect_timeout)) +
                                    " s; check address and network");
  }
  return first.get();
}

void RobotClient::Impl::shut_down() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(stopped_, true)) {
      return;
    }
  }
  asio::post(io_, [self = shared_from_this()] { self->close_now(); });
  if (thread_.joinable()) {
    if (thread_.get_id() == std::this_thread::get_id()) {
      thread_.detach();
    } else {
      thread_.join();
    }
  }
}

void RobotClient::Impl::close_now() {
  closing_ = true;
  tick_.cancel();
  retry_.cancel();
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
  for (const auto& [id, stream] : streams_) {
    stream->cancel();
  }
  streams_.clear();
  first_result(fail(Errc::kCancelled, "the client was closed"));
  set_link(LinkState::kClosed, "closed by this program");
  work_.reset();
}

void RobotClient::Impl::connect_now() {
  const auto self = shared_from_this();
  net::async_connect(io_, {endpoint_.host, endpoint_.port, params_.connect_timeout, params_.tls},
                     [self](Result<net::Transport> transport) { self->on_connected(std::move(transport)); });
}

void RobotClient::Impl::on_connected(Result<net::Transport> transport) {
  if (closing_) {
    return;
  }
  if (!transport) {
    end_connection(transport.error(), transport.error().code == Errc::kRefused);
    return;
  }
  wire::ClientSessionParams p;
  p.client_name = params_.client_name;
  p.robot_id = params_.robot_id;
  p.instance = instance_;
  p.role = params_.role;
  p.liveness = {params_.heartbeat, kLostHeartbeats * params_.heartbeat};
  session_.emplace(p, net::wall_now());
  outbox_ = wire::Outbox(kMaxQueuedFrames, kMaxQueuedBytes);
  connection_ = std::make_shared<net::Connection>(std::move(*transport), net::ConnectionParams{});
  const std::uint64_t number = ++connection_number_;
  const auto self = shared_from_this();
  const bool pushed = send(session_->hello());
  SEEKER_ASSERT(pushed);
  connection_->start(
      {[self, number](std::string_view payload) {
         if (number == self->connection_number_ && self->session_) {
           self->on_payload(payload);
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
           self->end_connection({refused ? error.code : Errc::kLinkLost, error.message}, refused);
         }
       }});
}

void RobotClient::Impl::on_payload(std::string_view payload) { act(session_->on_payload(payload, net::wall_now())); }

void RobotClient::Impl::act(wire::ClientStep step) {
  if (closing_) {
    return;
  }
  if (step.opened) {
    on_open();
  }
  if (step.update) {
    on_update(*step.update);
  }
  if (step.send) {
    (void)send(*step.send);
  }
  if (step.end && !closing_) {
    end_connection(*step.end, step.final_end);
  }
}

void RobotClient::Impl::on_open() {
  opened_at_ = net::wall_now();
  best_sync_.reset();  // another run of the robot has another clock
  {
    const std::lock_guard lock(mutex_);
    robot_ = session_->robot();
    role_ = session_->role();
  }
  const bool restarted = was_open_ && stream_id_ != session_->stream_id();
  const std::string why =
      was_open_ ? (restarted ? "connected again; the robot's server was restarted meanwhile" : "connected again") : "";
  stream_id_ = session_->stream_id();
  const bool again = std::exchange(was_open_, true);
  for (const auto& [id, stream] : streams_) {
    send_subscription(stream);
    if (again) {
      catch_up_tiles(stream, restarted);
    }
  }
  set_link(LinkState::kConnected, why, restarted);
  first_result({});
}

void RobotClient::Impl::first_result(Status result) {
  if (const auto done = std::exchange(on_first_, nullptr)) {
    done(std::move(result));
  }
}

void RobotClient::Impl::on_update(const pb::StreamUpdate& message) {
  const auto found = streams_.find(message.subscription_id());
  if (found == streams_.end()) {
    return;  // ended meanwhile
  }
  Result<api::Update> update = wire::from_message<api::Update>(message);
  if (!update) {
    log::warning(kPart, "an update of the robot is not valid: " + update.error().message);
    return;
  }
  const std::shared_ptr<ClientStream> stream = found->second;
  stream->deliver(std::make_shared<const api::Update>(std::move(*update)));
}

void RobotClient::Impl::end_connection(const Error& error, bool final_end) {
  if (closing_) {
    return;
  }
  if (connection_) {
    connection_->close();
    connection_.reset();
  }
  ++connection_number_;
  // Taken out first: an answer may make the next call at once.
  std::optional<wire::ClientSession> ended = std::exchange(session_, std::nullopt);
  const bool first_failed = !was_open_;
  if (first_failed) {
    first_result(tl::unexpected<Error>(error));
  }
  const bool retry = params_.reconnect.enabled && !final_end && was_open_;
  set_link(retry ? LinkState::kLost : LinkState::kClosed, error.message);
  if (ended) {
    ended->fail_all({Errc::kLinkLost, error.message});
  }
  if (!retry || closing_) {
    return;
  }
  const auto opened_at = std::exchange(opened_at_, std::nullopt);
  retry_.expires_after(opened_at ? backoff_.after(net::wall_now() - *opened_at) : backoff_.next());
  retry_.async_wait([self = shared_from_this()](error_code cancelled) {
    if (!cancelled && !self->closing_) {
      self->connect_now();
    }
  });
}

void RobotClient::Impl::tick() {
  if (closing_) {
    return;
  }
  const wire::WallTime now = net::wall_now();
  if (session_) {
    const std::uint64_t number = connection_number_;
    wire::ClientStep step = session_->on_tick(now);
    if (number == connection_number_) {
      act(std::move(step));
    }
    if (session_ && session_->open()) {
      const bool stale = session_->stale(now);
      if (stale && link() == LinkState::kConnected) {
        set_link(LinkState::kStale, "no frame was received from the robot for more than a heartbeat");
      } else if (!stale && link() == LinkState::kStale) {
        set_link(LinkState::kConnected, "frames of the robot are received again");
      }
    }
  }
  if (closing_) {
    return;
  }
  tick_.expires_after(std::clamp(params_.heartbeat / kTicksPerHeartbeat, kMinTick, kMaxTick));
  tick_.async_wait([self = shared_from_this()](error_code error) {
    if (!error) {
      self->tick();
    }
  });
}

void RobotClient::Impl::set_link(LinkState state, std::string why, bool restarted) {
  {
    const std::lock_guard lock(mutex_);
    if (link_ == state && was_open_ && state != LinkState::kConnected) {
      return;
    }
    link_ = state;
  }
  if (params_.on_link && was_open_) {
    params_.on_link({state, std::move(why), restarted});
  }
}

api::RobotInfo RobotClient::Impl::robot() const {
  const std::lock_guard lock(mutex_);
  return robot_;
}
std::string RobotClient::Impl::client_name() const { return params_.client_name; }
api::Role RobotClient::Impl::role() const {
  const std::lock_guard lock(mutex_);
  return role_;
}
LinkState RobotClient::Impl::link() const {
  const std::lock_guard lock(mutex_);
  return link_;
}

}  // namespace seeker::rpc
