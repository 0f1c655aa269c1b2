#include "common/rpc/client_impl.hpp"

#include <algorithm>
#include <future>
#include <utility>

#include <boost/asio/post.hpp>

#include "common/log/log.hpp"
#include "common/net/random_id.hpp"
#include "common/wire/convert.hpp"
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
/// Lost after so many heartbeats without a sign of life, as the robot does by default.
constexpr int kLostHeartbeats = 3;
/// Robots that speak less would carry a copy of a request out again.
constexpr std::uint32_t kOnceMinor = 7;
constexpr int kMostStopLinks = 8;

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
      io_(1),
      work_(asio::make_work_guard(io_)),
      tick_(io_) {}

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
  const auto self = shared_from_this();
  main_ = std::make_shared<RobotLink>(
      io_, link_params(),
      RobotLink::Handlers{[self] { self->on_open(); },
                          [self](const pb::StreamUpdate& update) { self->on_update(update); },
                          [self](const Error& why, bool again) { self->on_broken(why, again); }});
  asio::post(io_, [self] {
    self->main_->connect();
    self->tick();
  });
  // The thread keeps the object alive: a callback may drop the last reference to the client.
  thread_ = std::thread([self] { self->io_.run(); });
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
  for (const auto& link : stop_links_) {
    link->close();
  }
  main_->close();
  for (const auto& [id, stream] : streams_) {
    stream->cancel();
  }
  streams_.clear();
  first_result(fail(Errc::kCancelled, "the client was closed"));
  set_link(LinkState::kClosed, "closed by this program");
  work_.reset();
}

RobotLinkParams RobotClient::Impl::link_params() const {
  RobotLinkParams p;
  p.endpoint = endpoint_;
  p.session.client_name = params_.client_name;
  p.session.robot_id = params_.robot_id;
  p.session.instance = net::random_id();
  p.session.role = params_.role;
  p.session.liveness = {params_.heartbeat, kLostHeartbeats * params_.heartbeat};
  p.tls = params_.tls;
  p.connect_timeout = params_.connect_timeout;
  p.reconnect = params_.reconnect;
  return p;
}

void RobotClient::Impl::on_open() {
  const wire::ClientSession& session = main_->session();
  best_sync_.reset();  // another run of the robot has another clock
  {
    const std::lock_guard lock(mutex_);
    robot_ = session.robot();
    role_ = session.role();
  }
  const bool restarted = was_open_ && stream_id_ != session.stream_id();
  const std::string why =
      was_open_ ? (restarted ? "connected again; the robot's server was restarted meanwhile" : "connected again") : "";
  stream_id_ = session.stream_id();
  const bool again = std::exchange(was_open_, true);
  if (!again) {
    open_stop_links();
  }
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

void RobotClient::Impl::on_broken(const Error& error, bool again) {
  if (!was_open_) {
    first_result(tl::unexpected<Error>(error));
  }
  set_link(again ? LinkState::kLost : LinkState::kClosed, error.message);
}

void RobotClient::Impl::open_stop_links() {
  if (main_->session().robot().protocol_minor < kOnceMinor) {
    return;
  }
  RobotLinkParams p = link_params();
  p.session.role = api::Role::kObserver;  // who may stop the robot
  p.session.robot_id = main_->session().robot().robot_id;
  p.persistent = p.reconnect.enabled = true;
  for (int k = 0; k < std::min(params_.stop_links, kMostStopLinks); ++k) {
    // Under a name of its own: whether this client is heard is for its first link to say.
    const std::string suffix = "/stop" + std::to_string(k + 1);
    p.session.client_name = params_.client_name.substr(0, wire::kMaxNameBytes - suffix.size()) + suffix;
    p.session.instance = net::random_id();
    const auto slot = stop_links_.size();
    stop_links_.push_back(std::make_shared<RobotLink>(
        io_, p,
        RobotLink::Handlers{[self = shared_from_this(), slot] { self->urgent_.opened(*self->stop_links_[slot]); },
                            {},
                            [](const Error& why, bool again) {
                              if (!again) {
                                log::warning(kPart, "a connection for stops is gone for good: " + why.message);
                              }
                            }}));
    stop_links_.back()->connect();
  }
}

void RobotClient::Impl::tick() {
  if (closing_) {
    return;
  }
  const wire::WallTime now = net::wall_now();
  main_->tick(now);
  for (const auto& link : stop_links_) {
    link->tick(now);
  }
  note_staleness(now);
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

void RobotClient::Impl::note_staleness(wire::WallTime now) {
  if (!main_->open()) {
    return;
  }
  const bool stale = main_->stale(now);
  if (stale && link() == LinkState::kConnected) {
    set_link(LinkState::kStale, "no frame was received from the robot for more than a heartbeat");
  } else if (!stale && link() == LinkState::kStale) {
    set_link(LinkState::kConnected, "frames of the robot are received again");
  }
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
