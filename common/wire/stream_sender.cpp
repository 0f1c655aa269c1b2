#include "common/wire/stream_sender.hpp"

#include <algorithm>
#include <utility>

#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

bool reliable(api::Topic topic) { return api::stream_class(topic) == api::StreamClass::kReliable; }

}  // namespace

pb::TopicReply StreamSender::place(TopicState& state, std::uint64_t resume_stream_id) const {
  pb::TopicReply reply;
  reply.set_topic(static_cast<pb::Topic>(wire_enum(state.request.topic)));
  reply.set_start(pb::TopicReply::START_NOW);
  if (!reliable(state.request.topic)) {
    return reply;
  }
  const Backlog& kept = backlog(state.request.topic);
  state.position = kept.last();
  const bool resumes = state.request.resume_after > 0 || resume_stream_id != 0;
  if (resumes) {
    // A position that this run has not reached yet cannot be its own.
    const bool other_run =
        (resume_stream_id != 0 && resume_stream_id != stream_id_) || state.request.resume_after > kept.last();
    state.position = other_run ? 0 : state.request.resume_after;
    state.known_missing = kept.missing_after(state.position);
    reply.set_start(other_run                  ? pb::TopicReply::START_OTHER_RUN
                    : state.known_missing != 0 ? pb::TopicReply::START_GAP
                                               : pb::TopicReply::START_RESUMED);
    state.dropped = state.known_missing;
    state.position += state.known_missing;
  }
  reply.set_position(state.position);
  return reply;
}

std::vector<pb::TopicReply> StreamSender::subscribe(std::uint64_t id, const std::vector<TopicWish>& wishes) {
  Subscription subscription;
  std::vector<pb::TopicReply> replies;
  for (const TopicWish& wish : wishes) {
    TopicState state;
    state.request = wish.request;
    replies.push_back(place(state, wish.resume_stream_id));
    subscription.topics.push_back(std::move(state));
  }
  subscriptions_[id] = std::move(subscription);
  return replies;
}

void StreamSender::offer(api::Topic topic, std::uint64_t sequence, const SharedBody& body) {
  for (auto& [id, subscription] : subscriptions_) {
    for (TopicState& state : subscription.topics) {
      if (state.request.topic == topic && sequence > state.sent_sequence) {
        state.dropped += state.sent_sequence == 0 && state.slot ? 1 : 0;
        state.slot = body;
        state.slot_sequence = sequence;
      }
    }
  }
}

void StreamSender::offer_tiles(const EncodedTiles& update) {
  for (auto& [id, subscription] : subscriptions_) {
    for (TopicState& state : subscription.topics) {
      if (state.request.topic != api::Topic::kTiles) {
        continue;
      }
      if (state.tiles_head.map_epoch != update.head.map_epoch) {
        // The map moved: older tiles would be wrong.
        state.dropped += state.tiles.size();
        state.tiles.clear();
      }
      state.tiles_head = update.head;
      for (const auto& [index, body] : update.tiles) {
        SharedBody& slot = state.tiles[index];
        state.dropped += slot ? 1 : 0;
        slot = body;
      }
    }
  }
}

std::optional<OutFrame> StreamSender::next_of(std::uint64_t id, TopicState& state, WallTime now) const {
  SharedBody body;
  if (reliable(state.request.topic)) {
    const Backlog::Item* item = backlog(state.request.topic).after(state.position);
    if (item == nullptr) {
      return std::nullopt;
    }
    state.position = item->sequence;
    body = item->body;
  } else {
    if (now < state.not_before) {
      return std::nullopt;
    }
    if (state.request.topic == api::Topic::kTiles && !state.tiles.empty()) {
      std::vector<SharedBody> entries;
      while (!state.tiles.empty() && entries.size() < kMaxTilesPerUpdate) {
        entries.push_back(std::move(state.tiles.begin()->second));
        state.tiles.erase(state.tiles.begin());
      }
      body = join_tiles(state.tiles_head, entries);
    } else {
      body = std::move(state.slot);
      state.slot.reset();
      if (body) {
        state.dropped += state.sent_sequence == 0 ? 0 : state.slot_sequence - state.sent_sequence - 1;
        state.sent_sequence = state.slot_sequence;
      }
    }
    // The rest of a large tile update follows at once; the rate counts whole updates.
    if (body && state.request.max_rate_hz > 0.0 && state.tiles.empty()) {
      state.not_before = now + seconds(1.0 / state.request.max_rate_hz);
    }
  }
  if (!body) {
    return std::nullopt;
  }
  if (counts_ != nullptr) {
    (*counts_)[static_cast<std::size_t>(state.request.topic)] += state.dropped;
  }
  return stream_frame(std::move(body), id, std::exchange(state.dropped, 0));
}

std::optional<OutFrame> StreamSender::next_status(WallTime now) {
  for (auto& [id, subscription] : subscriptions_) {
    for (TopicState& state : subscription.topics) {
      if (state.request.topic == api::Topic::kStatus) {
        if (auto frame = next_of(id, state, now)) {
          return frame;
        }
      }
    }
  }
  return std::nullopt;
}

std::optional<OutFrame> StreamSender::next_other(WallTime now) {
  std::vector<std::pair<std::uint64_t, TopicState*>> all;
  for (auto& [id, subscription] : subscriptions_) {
    for (TopicState& state : subscription.topics) {
      if (state.request.topic != api::Topic::kStatus) {
        all.emplace_back(id, &state);
      }
    }
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& [id, state] = all[(next_topic_ + k) % all.size()];
    if (auto frame = next_of(id, *state, now)) {
      next_topic_ = (next_topic_ + k + 1) % all.size();
      return frame;
    }
  }
  return std::nullopt;
}

std::optional<OutFrame> StreamSender::next(WallTime now) {
  const bool others_first = std::exchange(status_went_, false);
  if (!others_first) {
    if (auto status = next_status(now)) {
      status_went_ = true;
      return status;
    }
  }
  if (auto other = next_other(now)) {
    return other;
  }
  return others_first ? next_status(now) : std::nullopt;
}

std::optional<WallTime> StreamSender::next_due() const {
  std::optional<WallTime> due;
  for (const auto& [id, subscription] : subscriptions_) {
    for (const TopicState& state : subscription.topics) {
      if ((state.slot || !state.tiles.empty()) && (!due || state.not_before < *due)) {
        due = state.not_before;
      }
    }
  }
  return due;
}

std::optional<api::Topic> StreamSender::overrun() const {
  for (const auto& [id, subscription] : subscriptions_) {
    for (const TopicState& state : subscription.topics) {
      if (reliable(state.request.topic) && backlog(state.request.topic).missing_after(state.position) > 0) {
        return state.request.topic;
      }
    }
  }
  return std::nullopt;
}

}  // namespace seeker::wire
