#include "server/net/server.hpp"

#include <algorithm>
#include <array>
#include <future>
#include <map>
#include <set>
#include <thread>
#include <utility>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/core/assert.hpp"
#include "common/log/log.hpp"
#include "common/net/listen.hpp"
#include "common/net/random_id.hpp"
#include "common/net/refusal_log.hpp"
#include "server/net/client_silences.hpp"
#include "server/net/link_faults.hpp"
#include "server/net/loop_watch.hpp"
#include "server/net/mailbox.hpp"
#include "server/net/session.hpp"

namespace seeker::server_net {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

constexpr std::string_view kPart = "server/net";
/// Sessions are looked after this often per heartbeat.
constexpr int kTicksPerHeartbeat = 5;
constexpr Duration kMinTick = std::chrono::milliseconds(5);
/// Wall time for the robot to report its identity at the start.
constexpr Duration kInfoTimeout = std::chrono::seconds(10);
constexpr Duration kRefusalLogPeriod = std::chrono::seconds(1);
constexpr std::string_view kOwnName = "seekerd/net";

template <std::size_t... I>
wire::Backlogs make_backlogs(const BacklogLimits& limits, std::index_sequence<I...> /*all*/) {
  return {((void)I, wire::Backlog(limits.items, limits.bytes))...};
}

std::vector<api::TopicRequest> all_topics() {
  std::vector<api::TopicRequest> topics;
  for (std::size_t k = 0; k < api::kTopicCount; ++k) {
    topics.push_back({static_cast<api::Topic>(k), 0.0, 0});
  }
  return topics;
}

}  // namespace

/// Everything below start() and stop() runs on the network thread, except push of an update.
class Server::Impl {
 public:
  Impl(api::RobotHost& host, ServerParams params)
      : params_(std::move(params)),
        io_(std::make_shared<asio::io_context>(1)),
        work_(asio::make_work_guard(*io_)),
        listener_(
            *io_, kPart,
            {[this](net::Transport transport) { admit(std::move(transport)); }, [this] { check_certificates(); }}),
        tick_(*io_),
        mailbox_(std::make_shared<Mailbox>(2 * params_.backlog.items)),
        backlogs_(make_backlogs(params_.backlog, std::make_index_sequence<api::kTopicCount>())),
        hub_{params_, host, io_, backlogs_, {}, net::random_id(), {}, {}, false, {}, {}, {}, {}, {}},
        loop_(params_.lost_after, net::wall_now()) {
    hub_.robot_now = [this] { return params_.robot_now ? params_.robot_now() : newest_; };
    hub_.loop_pass = [this] { return params_.loop_pass ? params_.loop_pass() : ++own_passes_; };
    hub_.opened = [this](const std::shared_ptr<Session>& session) { on_opened(session); };
    hub_.ended = [this](const std::shared_ptr<Session>& session, const wire::Ending& end) { on_ended(session, end); };
  }

  Result<std::uint16_t> start() {
    robot_ = hub_.host.open({std::string(kOwnName), api::Role::kObserver});
    Status ready = ask_info();
    if (!ready) {
      return tl::unexpected<Error>(ready.error());
    }
    Result<std::uint16_t> port = listener_.open(params_.address, params_.port, params_.security);
    if (!port) {
      return port;
    }
    ready = follow_robot();
    if (!ready) {
      return tl::unexpected<Error>(ready.error());
    }
    report_link_faults();
    listener_.accept();
    tick();
    thread_ = std::thread([this] { run(); });
    log::info(kPart, "listening on " + params_.address + " port " + std::to_string(*port));
    return port;
  }

  void stop() {
    if (!thread_.joinable()) {
      return;
    }
    asio::post(*io_, [this] { close_all(); });
    subscription_.reset();
    // Connections linger for a bounded time, so run() returns by itself.
    thread_.join();
    robot_.reset();
  }

  ServerStats stats() {
    if (!thread_.joinable()) {
      return hub_.stats;
    }
    auto promise = std::make_shared<std::promise<ServerStats>>();
    auto future = promise->get_future();
    asio::post(*io_, [this, promise] {
      hub_.stats.sessions = sessions_.size();
      hub_.stats.queued_bytes = 0;
      for (const auto& session : sessions_) {
        hub_.stats.queued_bytes += session->queued_bytes();
      }
      promise->set_value(hub_.stats);
    });
    return future.get();
  }

 private:
  void run() {
    // A fault in one session must not end the others: log it and go on.
    for (;;) {
      try {
        io_->run();
        return;
      } catch (const std::exception& e) {
        log::error(kPart, std::string("a session failed: ") + e.what());
      }
    }
  }

  Status ask_info() {
    auto promise = std::make_shared<std::promise<Result<api::RobotInfo>>>();
    auto future = promise->get_future();
    robot_->get_info([promise](Result<api::RobotInfo> info) { promise->set_value(std::move(info)); });
    if (future.wait_for(kInfoTimeout) != std::future_status::ready) {
      return fail(Errc::kTimeout, "the robot does not report its identity");
    }
    Result<api::RobotInfo> info = future.get();
    if (!info) {
      return tl::unexpected<Error>(info.error());
    }
    hub_.robot = std::move(*info);
    return {};
  }

  /// One subscription for all clients. Updates come on the robot's thread.
  Status follow_robot() {
    auto sink = [this](const api::UpdatePtr& update) {
      if (mailbox_->push(update)) {
        asio::post(*io_, [this] { publish(); });
      }
    };
    auto subscription = robot_->subscribe(all_topics(), sink);
    if (!subscription) {
      return tl::unexpected<Error>(subscription.error());
    }
    subscription_ = std::move(*subscription);
    return {};
  }

  void admit(net::Transport transport) {
    ++hub_.stats.accepted;
    const auto said_hello =
        std::count_if(sessions_.begin(), sessions_.end(), [](const auto& session) { return session->open(); });
    const bool full = static_cast<std::size_t>(said_hello) >= params_.max_sessions;
    // Some more are let in then, to receive the reason why they are refused.
    constexpr std::size_t kRefusing = 32;
    const std::size_t most = params_.max_sessions + (full ? kRefusing : 0);
    while (sessions_.size() >= most) {
      drop_longest_silent();
    }
    const auto session = std::make_shared<Session>(hub_, std::move(transport), full);
    sessions_.insert(session);
    session->start();
  }

  /// Ends the sessions of those who are not believed any more.
  void check_certificates() {
    for (const auto& session : snapshot()) {
      if (const Status believed = listener_.check(session->certificate()); !believed) {
        session->end({::seeker::v1::Close::REASON_CERTIFICATE, believed.error().message, false, true});
      }
    }
    report_link_faults();
  }

  void report_link_faults() {
    std::vector<api::Fault> faults = link_faults(listener_.health(), std::chrono::system_clock::now());
    if (params_.on_link_faults && faults != link_faults_) {
      params_.on_link_faults(faults);
    }
    link_faults_ = std::move(faults);
  }

  /// Who has not said hello makes room, or silent connections would lock everybody out. There must be one.
  void drop_longest_silent() {
    const auto waits_longer = [](const auto& a, const auto& b) {
      return a->open() != b->open() ? !a->open() : a->since() < b->since();
    };
    const std::shared_ptr<Session> longest = *std::min_element(sessions_.begin(), sessions_.end(), waits_longer);
    SEEKER_ASSERT(!longest->open());
    longest->end({::seeker::v1::Close::REASON_SILENT, "it made room for another connection", false, false});
  }

  void on_opened(const std::shared_ptr<Session>& opened) {
    ++names_[opened->caller().client_name];
    log::info(kPart, "client '" + opened->caller().client_name + "' connected");
    for (const auto& session : snapshot()) {
      const bool same = session != opened && session->open() && session->instance() == opened->instance() &&
                        session->caller().client_name == opened->caller().client_name;
      if (same) {
        session->end({::seeker::v1::Close::REASON_REPLACED, "the same client has connected again", false, true});
      }
    }
  }

  void on_ended(const std::shared_ptr<Session>& session, const wire::Ending& ending) {
    sessions_.erase(session);
    if (!session->open()) {
      on_refused(ending);
      return;
    }
    const api::Caller& caller = session->caller();
    log::info(kPart, "client '" + caller.client_name + "' left: " + ending.text);
    hub_.stats.lost += ending.goodbye ? 0 : 1;
    // Two sessions of one name are one client to the robot: it is gone when the last one is.
    if (--names_[caller.client_name] > 0) {
      return;
    }
    names_.erase(caller.client_name);
    silences_.forget(caller.client_name);
    if (ending.goodbye) {
      hub_.host.closed(caller);
    } else {
      hub_.host.lost(caller, ending.text);
    }
  }

  /// Anybody can make any number of connections that end before hello. Those that only come and go are no offence.
  void on_refused(const wire::Ending& ending) {
    using Close = ::seeker::v1::Close;
    if (ending.reason == Close::REASON_PROTOCOL_ERROR || ending.reason == Close::REASON_FRAME_TOO_LARGE) {
      net::write_refusals(kPart, refusals_.note(ending.text, net::wall_now()));
    } else {
      log::debug(kPart, "a connection ended before hello: " + ending.text);
    }
  }

  [[nodiscard]] std::vector<std::shared_ptr<Session>> snapshot() const { return {sessions_.begin(), sessions_.end()}; }

  void tick() {
    const Duration period = std::max(kMinTick, params_.heartbeat / kTicksPerHeartbeat);
    tick_.expires_after(period);
    tick_.async_wait([this](error_code error) {
      if (error || stopping_) {
        return;
      }
      const wire::WallTime now = net::wall_now();
      hub_.loop_stuck = loop_.stuck(hub_.loop_pass(), now);
      report_silence(now);
      net::write_refusals(kPart, refusals_.take(now));
      for (const auto& session : snapshot()) {
        session->tick(now);
      }
      tick();
    });
  }

  /// Before a silent session ends as lost, and again when its client speaks: link policies count from the silence.
  void report_silence(wire::WallTime now) {
    silences_.begin();
    for (const auto& session : sessions_) {
      if (session->open()) {
        silences_.add(session->caller(), session->silence(now), session->stale(now));
      }
    }
    for (const ClientSilences::Change& change : silences_.changes()) {
      if (change.silent) {
        hub_.host.silent(change.caller, change.silence);
      } else {
        hub_.host.returned(change.caller);
      }
    }
  }

  /// Encodes each update once and hands the bytes to all sessions.
  void publish() {
    if (stopping_) {
      return;
    }
    for (const api::UpdatePtr& update : mailbox_->drain()) {
      newest_ = std::max(newest_, update->stamp);
      if (api::stream_class(update->topic) == api::StreamClass::kReliable) {
        publish_reliable(*update);
        continue;
      }
      if (update->topic != api::Topic::kTiles) {
        hub_.newest.at(static_cast<std::size_t>(update->topic)) = update;
      }
      if (wanted()) {
        publish_latest(*update);
      }
    }
    for (const auto& session : snapshot()) {
      session->wake();
    }
  }

  [[nodiscard]] bool wanted() const {
    return std::any_of(sessions_.begin(), sessions_.end(),
                       [](const auto& session) { return session->streams().subscriptions() > 0; });
  }

  void publish_reliable(const api::Update& update) {
    wire::Backlog& backlog = backlogs_[static_cast<std::size_t>(update.topic)];
    if (update.sequence <= backlog.last()) {
      log::error(kPart, "the robot repeated sequence " + std::to_string(update.sequence) + " of the topic " +
                            std::string(api::to_string(update.topic)));
      return;
    }
    ++hub_.stats.encoded;
    backlog.push(update.sequence, wire::encode_body(update));
  }

  void publish_latest(const api::Update& update) {
    ++hub_.stats.encoded;
    if (update.topic == api::Topic::kTiles) {
      const auto& tiles = std::get<api::TileUpdate>(update.payload);
      wire::EncodedTiles encoded{{update.sequence, update.stamp, tiles.revision, tiles.map_epoch}, {}};
      for (const OccupancyTile& tile : tiles.tiles) {
        encoded.tiles.emplace_back(tile.index, wire::encode_tile(tile));
      }
      for (const auto& session : sessions_) {
        session->offer_tiles(encoded);
      }
      return;
    }
    const wire::SharedBody body = wire::encode_body(update);
    if (body->size() + wire::kMaxTextBytes > wire::kMaxFrameBytes) {
      log::warning(kPart, "an update of the topic " + std::string(api::to_string(update.topic)) +
                              " does not fit into a frame of 16 MiB; lower its resolution");
      return;
    }
    for (const auto& session : sessions_) {
      session->offer(update.topic, update.sequence, body);
    }
  }

  void close_all() {
    stopping_ = true;
    listener_.close();
    tick_.cancel();
    for (const auto& session : snapshot()) {
      session->end({::seeker::v1::Close::REASON_SHUTTING_DOWN, "the robot's server is shutting down", false, true});
    }
    work_.reset();
  }

  ServerParams params_;
  std::shared_ptr<asio::io_context> io_;
  asio::executor_work_guard<asio::io_context::executor_type> work_;
  net::Listener listener_;
  asio::steady_timer tick_;
  std::shared_ptr<Mailbox> mailbox_;
  wire::Backlogs backlogs_;
  SessionHub hub_;
  std::set<std::shared_ptr<Session>> sessions_;
  std::map<std::string, int> names_;
  LoopWatch loop_;
  std::uint64_t own_passes_ = 0;  ///< where the robot counts none
  ClientSilences silences_;
  net::RefusalLog refusals_{kRefusalLogPeriod};
  std::vector<api::Fault> link_faults_;  ///< as they were reported last
  RobotTime newest_{};
  bool stopping_ = false;
  std::shared_ptr<api::RobotApi> robot_;
  std::unique_ptr<api::Subscription> subscription_;
  std::thread thread_;
};

Server::Server(api::RobotHost& host, ServerParams params) : impl_(std::make_unique<Impl>(host, std::move(params))) {}
Server::~Server() { stop(); }
Result<std::uint16_t> Server::start() { return impl_->start(); }
void Server::stop() { impl_->stop(); }
ServerStats Server::stats() const { return impl_->stats(); }

}  // namespace seeker::server_net
