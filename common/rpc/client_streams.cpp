#include "common/rpc/client_streams.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "common/wire/convert.hpp"

namespace seeker::rpc {

namespace pb = ::seeker::v1;

Status validate_topics(const std::vector<api::TopicRequest>& topics) {
  if (topics.empty()) {
    return fail(Errc::kInvalidArgument, "a subscription needs at least one topic");
  }
  std::set<api::Topic> seen;
  for (const api::TopicRequest& request : topics) {
    const std::string name(api::to_string(request.topic));
    if (!seen.insert(request.topic).second) {
      return fail(Errc::kInvalidArgument, "the topic '" + name + "' is named twice");
    }
    if (!(request.max_rate_hz >= 0.0 && request.max_rate_hz <= wire::kMaxStreamRate_hz)) {
      return fail(Errc::kInvalidArgument, "the rate of the topic '" + name + "' must be from 0 to 1000 Hz");
    }
  }
  return {};
}

ClientStream::ClientStream(std::uint64_t id, const std::vector<api::TopicRequest>& topics, api::UpdateSink sink)
    : id_(id), sink_(std::move(sink)) {
  for (const api::TopicRequest& request : topics) {
    topics_.push_back({request, request.resume_after, 0});
  }
}

bool ClientStream::wants(api::Topic topic) const {
  return std::any_of(topics_.begin(), topics_.end(), [&](const Topic& t) { return t.request.topic == topic; });
}

pb::SubscribeRequest ClientStream::request() const {
  pb::SubscribeRequest out;
  out.set_subscription_id(id_);
  for (const Topic& topic : topics_) {
    pb::TopicRequest* one = out.add_topics();
    wire::write(topic.request, one);
    if (api::stream_class(topic.request.topic) == api::StreamClass::kReliable) {
      one->set_resume_after(topic.position);
      one->set_resume_stream_id(topic.run);
    }
  }
  return out;
}

void ClientStream::on_subscribed(const pb::SubscribeResponse& response, std::uint64_t stream_id) {
  for (Topic& topic : topics_) {
    for (const pb::TopicReply& reply : response.topics()) {
      if (reply.topic() != static_cast<pb::Topic>(wire::wire_enum(topic.request.topic))) {
        continue;
      }
      topic.run = stream_id;
      if (reply.start() == pb::TopicReply::START_NOW || reply.start() == pb::TopicReply::START_OTHER_RUN) {
        topic.position = reply.position();
      }
    }
  }
}

void ClientStream::deliver(const api::UpdatePtr& update) {
  const auto topic =
      std::find_if(topics_.begin(), topics_.end(), [&](const Topic& t) { return t.request.topic == update->topic; });
  if (topic == topics_.end()) {
    return;
  }
  // What was asked for beside the stream has no number.
  if (api::stream_class(update->topic) == api::StreamClass::kReliable && update->sequence != 0) {
    if (update->sequence <= topic->position) {
      return;
    }
    topic->position = update->sequence;
  }
  if (const auto* segments = std::get_if<api::SegmentUpdate>(&update->payload)) {
    // An answer to get_segments and the stream may overtake each other: the older one is contained in the newer.
    if (segments->revision < segments_revision_) {
      return;
    }
    segments_revision_ = segments->revision;
  }
  if (const auto* tiles = std::get_if<api::TileUpdate>(&update->payload)) {
    tiles_revision_ = tiles->revision;
  }
  const std::lock_guard lock(delivery_);
  if (!cancelled_) {
    sink_(update);
  }
}

void ClientStream::cancel() {
  const std::lock_guard lock(delivery_);
  cancelled_ = true;
}

}  // namespace seeker::rpc
