/// \file
/// Implementation of RobotClient: one thread, one link with all calls and streams, subscriptions that outlive its
/// connections, and links that carry nothing but copies of what stops the robot.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/rpc/client_streams.hpp"
#include "common/rpc/robot_client.hpp"
#include "common/rpc/robot_link.hpp"
#include "common/rpc/urgent_calls.hpp"

namespace seeker::rpc {

/// Public methods may be called from any thread; private ones run on the client's thread.
class RobotClient::Impl : public std::enable_shared_from_this<RobotClient::Impl> {
 public:
  Impl(Endpoint endpoint, ClientParams params);
  ~Impl();

  /// Starts the thread and waits for the first hello.
  Status open();
  /// Ends the session on purpose and ends the thread. Called on the client's own thread, it does not wait for that.
  void shut_down();

  /// The answer has `at_least` the time, where that is more than ClientParams::call_timeout.
  void call(seeker::v1::Request request, const wire::ClientSession::Answer& answer,
            Duration at_least = Duration::zero());
  /// As call(), with a copy of the request over every stop link.
  void call_urgently(seeker::v1::Request request, seeker::v1::Request copy, const wire::ClientSession::Answer& answer);
  void sync_time(const api::Reply<TimeSync>& reply);
  void drive(const api::DriveCommand& command, const api::Reply<void>& reply);
  Result<std::unique_ptr<api::Subscription>> subscribe(const std::vector<api::TopicRequest>& topics,
                                                       api::UpdateSink sink);

  [[nodiscard]] api::RobotInfo robot() const;
  [[nodiscard]] std::string client_name() const;
  [[nodiscard]] api::Role role() const;
  [[nodiscard]] LinkState link() const;

 private:
  /// Has the name begin with that of the certificate, if there is one.
  Status take_certified_name();
  [[nodiscard]] RobotLinkParams link_params() const;
  void on_open();
  void on_update(const seeker::v1::StreamUpdate& message);
  void on_broken(const Error& error, bool again);
  /// Where the robot knows copies of a request.
  void open_stop_links();
  void tick();
  void note_staleness(wire::WallTime now);
  void close_now();
  void set_link(LinkState state, std::string why, bool restarted = false);
  /// Runs `work` on the client's thread, or `closed` here when there is none any more.
  void on_thread(std::function<void()> work, const std::function<void()>& closed);
  void sync_now(api::Reply<TimeSync> reply);
  void drive_now(const api::DriveCommand& command, Duration given, const api::Reply<void>& reply);
  void call_now(seeker::v1::Request request, wire::ClientSession::Answer answer, Duration at_least = Duration::zero());
  void send_subscription(const std::shared_ptr<ClientStream>& stream);
  void catch_up_segments(const std::shared_ptr<ClientStream>& stream, const seeker::v1::SubscribeResponse& response);
  void catch_up_tiles(const std::shared_ptr<ClientStream>& stream, bool restarted);
  void first_result(Status result);

  Endpoint endpoint_;
  ClientParams params_;
  boost::asio::io_context io_;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_;
  boost::asio::steady_timer tick_;
  std::shared_ptr<RobotLink> main_;
  std::vector<std::shared_ptr<RobotLink>> stop_links_;
  UrgentCalls urgent_;
  std::map<std::uint64_t, std::shared_ptr<ClientStream>> streams_;
  std::uint64_t next_stream_ = 1;
  std::uint64_t stream_id_ = 0;  ///< stream id of the run of the robot that was connected last
  bool was_open_ = false;
  bool closing_ = false;
  std::function<void(Status)> on_first_;
  std::optional<TimeSync> best_sync_;      ///< of this connection
  Duration synced_at_ = Duration::zero();  ///< local time of best_sync_

  mutable std::mutex mutex_;  ///< guards what follows: read from any thread
  api::RobotInfo robot_;
  api::Role role_ = api::Role::kObserver;
  LinkState link_ = LinkState::kLost;
  bool stopped_ = false;
  std::thread thread_;
};

}  // namespace seeker::rpc
