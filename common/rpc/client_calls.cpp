// Calls, clock comparison and subscriptions of the remote client; the connection itself is in client_impl.cpp.

#include <algorithm>
#include <utility>

#include <boost/asio/post.hpp>

#include "common/log/log.hpp"
#include "common/rpc/answers.hpp"
#include "common/rpc/client_impl.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/outcome.hpp"

namespace seeker::rpc {
namespace {

namespace asio = boost::asio;
namespace pb = ::seeker::v1;

constexpr std::string_view kPart = "rpc";
/// A comparison of clocks holds so long: clocks drift apart by less than a millisecond in it.
constexpr Duration kSyncAge = std::chrono::minutes(1);

/// Ends the subscription of a client that may be gone already.
class RemoteSubscription final : public api::Subscription {
 public:
  RemoteSubscription(std::shared_ptr<ClientStream> stream, std::function<void()> end)
      : stream_(std::move(stream)), end_(std::move(end)) {}
  RemoteSubscription(const RemoteSubscription&) = delete;
  RemoteSubscription& operator=(const RemoteSubscription&) = delete;
  ~RemoteSubscription() override {
    stream_->cancel();
    end_();
  }

 private:
  std::shared_ptr<ClientStream> stream_;
  std::function<void()> end_;
};

}  // namespace

void RobotClient::Impl::on_thread(std::function<void()> work, const std::function<void()>& closed) {
  {
    const std::lock_guard lock(mutex_);
    if (!stopped_) {
      asio::post(io_, std::move(work));
      return;
    }
  }
  closed();
}

void RobotClient::Impl::call(pb::Request request, const wire::ClientSession::Answer& answer, Duration at_least) {
  const auto shared = std::make_shared<pb::Request>(std::move(request));
  on_thread(
      [self = shared_from_this(), shared, answer, at_least] { self->call_now(std::move(*shared), answer, at_least); },
      [answer] { answer(fail(Errc::kCancelled, "the client was closed")); });
}

void RobotClient::Impl::call_now(pb::Request request, wire::ClientSession::Answer answer, Duration at_least) {
  main_->call(std::move(request), std::max(params_.call_timeout, at_least), std::move(answer));
}

void RobotClient::Impl::call_urgently(pb::Request request, pb::Request copy,
                                      const wire::ClientSession::Answer& answer) {
  UrgentCalls::Call call{std::move(request), std::move(copy), params_.call_timeout};
  on_thread([self = shared_from_this(), call = std::move(call),
             answer] { self->urgent_.call(call, answer, *self->main_, self->stop_links_); },
            [answer] { answer(fail(Errc::kCancelled, "the client was closed")); });
}

void RobotClient::Impl::sync_time(const api::Reply<TimeSync>& reply) {
  on_thread([self = shared_from_this(), reply] { self->sync_now(reply); },
            [reply] { reply(fail(Errc::kCancelled, "the client was closed")); });
}

void RobotClient::Impl::sync_now(api::Reply<TimeSync> reply) {
  pb::Request request;
  request.mutable_time_sync();
  call_now(std::move(request), [self = shared_from_this(),
                                reply = std::move(reply)](Result<std::vector<pb::Response>> responses) {
    const Status ok = responses ? wire::outcome(responses->front()) : Status(tl::unexpected<Error>(responses.error()));
    if (!ok) {
      reply(tl::unexpected<Error>(ok.error()));
      return;
    }
    const pb::ResponseHeader& header = responses->front().header();
    // t1..t4 of the exchange: the round trip is the exchange without the time that the robot took.
    const Duration t1(header.client_time_ns());
    const Duration t2(header.robot_received_time_ns());
    const Duration t3(header.robot_sent_time_ns());
    const Duration t4 = net::wall_now().time_since_epoch();
    const pb::TimeSyncResponse& answer = responses->front().time_sync();
    TimeSync now{((t2 - t1) + (t3 - t4)) / 2, (t4 - t1) - (t3 - t2), answer.realtime()};
    if (answer.has_unix_ns()) {
      const Duration here = std::chrono::system_clock::now().time_since_epoch();
      now.robot_wall_minus_local = Duration(answer.unix_ns()) + now.round_trip / 2 - here;
    }
    const bool old = t4 - self->synced_at_ > kSyncAge;
    if (!self->best_sync_ || old || now.round_trip < self->best_sync_->round_trip || !now.realtime) {
      self->best_sync_ = now;
      self->synced_at_ = t4;
    }
    reply(*self->best_sync_);
  });
}

void RobotClient::Impl::drive(const api::DriveCommand& command, const api::Reply<void>& reply) {
  const Duration given = net::wall_now().time_since_epoch();
  on_thread([self = shared_from_this(), command, given, reply] { self->drive_now(command, given, reply); },
            [reply] { reply(fail(Errc::kCancelled, "the client was closed")); });
}

void RobotClient::Impl::drive_now(const api::DriveCommand& command, Duration given, const api::Reply<void>& reply) {
  const bool due = !best_sync_ || given - synced_at_ > kSyncAge;
  if (!command.sent && due) {
    const auto self = shared_from_this();
    sync_now([self, command, given, reply](const Result<TimeSync>& sync) {
      if (sync) {
        self->drive_now(command, given, reply);
      } else {
        reply(tl::unexpected<Error>(sync.error()));
      }
    });
    return;
  }
  api::DriveCommand stamped = command;
  if (!stamped.sent) {
    stamped.sent = RobotTime(given + best_sync_->robot_minus_local);
  }
  pb::Request request;
  wire::write(stamped, request.mutable_drive()->mutable_command());
  call_now(std::move(request), empty_answer(reply));
}

Result<std::unique_ptr<api::Subscription>> RobotClient::Impl::subscribe(const std::vector<api::TopicRequest>& topics,
                                                                        api::UpdateSink sink) {
  if (const Status valid = validate_topics(topics); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  std::shared_ptr<ClientStream> stream;
  {
    const std::lock_guard lock(mutex_);
    if (stopped_) {
      return fail(Errc::kCancelled, "the client was closed");
    }
    stream = std::make_shared<ClientStream>(next_stream_++, topics, std::move(sink));
  }
  asio::post(io_, [self = shared_from_this(), stream] {
    self->streams_[stream->id()] = stream;
    if (self->main_->open()) {
      self->send_subscription(stream);
    }
  });
  const auto end = [weak = weak_from_this(), id = stream->id()] {
    if (const auto self = weak.lock()) {
      asio::post(self->io_, [self, id] {
        if (self->streams_.erase(id) == 0 || !self->main_->open()) {
          return;
        }
        pb::Request request;
        request.mutable_unsubscribe()->set_subscription_id(id);
        self->call_now(std::move(request), [](const Result<std::vector<pb::Response>>&) {});
      });
    }
  };
  return std::make_unique<RemoteSubscription>(stream, end);
}

void RobotClient::Impl::send_subscription(const std::shared_ptr<ClientStream>& stream) {
  pb::Request request;
  *request.mutable_subscribe() = stream->request();
  call_now(std::move(request), [self = shared_from_this(), stream](Result<std::vector<pb::Response>> responses) {
    const Status ok = responses ? wire::outcome(responses->front()) : Status(tl::unexpected<Error>(responses.error()));
    if (!ok) {
      // After a broken link the next connection asks again; a refusal is a fault of this program.
      if (ok.error().code != Errc::kLinkLost && ok.error().code != Errc::kCancelled) {
        log::warning(kPart, "a subscription was refused: " + ok.error().message);
      }
      return;
    }
    stream->on_subscribed(responses->front().subscribe(), self->stream_id_);
    self->catch_up_segments(stream, responses->front().subscribe());
  });
}

/// A stream of changes says nothing without what was before them: asked for at the beginning and after a gap.
void RobotClient::Impl::catch_up_segments(const std::shared_ptr<ClientStream>& stream,
                                          const pb::SubscribeResponse& response) {
  const auto topic = static_cast<pb::Topic>(wire::wire_enum(api::Topic::kSegments));
  const auto reply = std::find_if(response.topics().begin(), response.topics().end(),
                                  [&](const pb::TopicReply& r) { return r.topic() == topic; });
  if (reply == response.topics().end() || reply->start() == pb::TopicReply::START_RESUMED) {
    return;
  }
  if (reply->start() == pb::TopicReply::START_OTHER_RUN) {
    stream->forget_segments();
  }
  pb::Request request;
  request.mutable_get_segments()->set_since_revision(stream->segments_revision());
  call_now(std::move(request), [stream](Result<std::vector<pb::Response>> responses) {
    if (!responses) {
      return;
    }
    for (const pb::Response& part : *responses) {
      Result<api::SegmentUpdate> segments = wire::from_message<api::SegmentUpdate>(part.get_segments().update());
      if (wire::outcome(part) && segments) {
        auto update = std::make_shared<api::Update>();
        update->topic = api::Topic::kSegments;
        update->payload = std::move(*segments);
        stream->deliver(update);
      }
    }
  });
}

/// LATEST topics need nothing after a gap but tiles: those that changed meanwhile would stay old until they change
/// again.
void RobotClient::Impl::catch_up_tiles(const std::shared_ptr<ClientStream>& stream, bool restarted) {
  if (!stream->wants(api::Topic::kTiles)) {
    return;
  }
  pb::Request request;
  request.mutable_get_tiles()->set_since_revision(restarted ? 0 : stream->tiles_revision());
  call_now(std::move(request), [stream](Result<std::vector<pb::Response>> responses) {
    if (!responses) {
      return;
    }
    for (const pb::Response& response : *responses) {
      auto update = std::make_shared<api::Update>();
      update->topic = api::Topic::kTiles;
      Result<api::TileUpdate> tiles = wire::from_message<api::TileUpdate>(response.get_tiles().update());
      if (wire::outcome(response) && tiles && !tiles->tiles.empty()) {
        update->payload = std::move(*tiles);
        stream->deliver(update);
      }
    }
  });
}

}  // namespace seeker::rpc
