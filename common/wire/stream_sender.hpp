/// \file
/// What one client gets of the streams: its subscriptions, and which frame is next. No sockets; pulled by the writer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/api/robot_api.hpp"
#include "common/wire/backlog.hpp"
#include "common/wire/liveness.hpp"
#include "seeker/v1/stream.pb.h"

namespace seeker::wire {

/// One per topic; those of LATEST topics stay empty.
using Backlogs = std::array<Backlog, api::kTopicCount>;

/// A topic asked for, with the run its position belongs to (0: not known).
struct TopicWish {
  api::TopicRequest request;
  std::uint64_t resume_stream_id = 0;
};

/// Tiles of one update, each encoded once.
struct EncodedTiles {
  TilesHead head;
  std::vector<std::pair<CellIndex, SharedBody>> tiles;
};

/// Memory of one client is bounded by construction: one slot per LATEST topic, the newest of each tile (shared bytes),
/// and a position in the shared backlog per RELIABLE topic.
class StreamSender {
 public:
  StreamSender(const Backlogs& backlogs, std::uint64_t stream_id) : backlogs_(backlogs), stream_id_(stream_id) {}

  /// Replaces a subscription of the same id.
  std::vector<seeker::v1::TopicReply> subscribe(std::uint64_t id, const std::vector<TopicWish>& wishes);
  [[nodiscard]] bool unsubscribe(std::uint64_t id) { return subscriptions_.erase(id) > 0; }
  [[nodiscard]] std::size_t subscriptions() const { return subscriptions_.size(); }
  [[nodiscard]] bool has(std::uint64_t id) const { return subscriptions_.count(id) > 0; }

  /// A new item of a LATEST topic other than tiles. Steps in the sequence are items that were overtaken before they
  /// came here; they count as dropped too.
  void offer(api::Topic topic, std::uint64_t sequence, const SharedBody& body);
  void offer_tiles(const EncodedTiles& tiles);

  /// The next frame that may be sent now; RELIABLE and LATEST take turns.
  [[nodiscard]] std::optional<OutFrame> next(WallTime now);
  /// When a frame that is held back by a rate limit may go; nothing when none is.
  [[nodiscard]] std::optional<WallTime> next_due() const;
  /// A RELIABLE topic whose next items are gone from the backlog because the client was too slow.
  [[nodiscard]] std::optional<api::Topic> overrun() const;

 private:
  struct TopicState {
    api::TopicRequest request;
    std::uint64_t position = 0;       ///< RELIABLE: sequence of the item sent last
    std::uint64_t known_missing = 0;  ///< RELIABLE: items gone before the subscription began
    SharedBody slot;                  ///< LATEST
    std::uint64_t slot_sequence = 0;
    std::uint64_t sent_sequence = 0;  ///< LATEST: 0: nothing was sent yet
    std::uint64_t dropped = 0;
    WallTime not_before{};
    TilesHead tiles_head;
    std::map<CellIndex, SharedBody> tiles;
  };
  struct Subscription {
    std::vector<TopicState> topics;
  };

  [[nodiscard]] seeker::v1::TopicReply place(TopicState& state, std::uint64_t resume_stream_id) const;
  [[nodiscard]] std::optional<OutFrame> next_of(std::uint64_t id, TopicState& state, WallTime now) const;
  [[nodiscard]] const Backlog& backlog(api::Topic topic) const { return backlogs_[static_cast<std::size_t>(topic)]; }

  const Backlogs& backlogs_;
  std::uint64_t stream_id_;
  std::map<std::uint64_t, Subscription> subscriptions_;
  std::size_t turn_ = 0;
};

}  // namespace seeker::wire
