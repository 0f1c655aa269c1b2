/// \file
/// The streams of one client: its subscriptions, and the choice of the next frame. It has no sockets; the writer asks
/// for each frame.
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

/// One backlog per topic; those of LATEST topics stay empty.
using Backlogs = std::array<Backlog, api::kTopicCount>;

/// By topic: items that slow clients did not get.
using DropCounts = std::array<std::uint64_t, api::kTopicCount>;

/// A requested topic, with the run of the robot that its position belongs to (0: not known).
struct TopicWish {
  api::TopicRequest request;
  std::uint64_t resume_stream_id = 0;
};

/// The tiles of one update, each encoded once.
struct EncodedTiles {
  TilesHead head;
  std::vector<std::pair<CellIndex, SharedBody>> tiles;
};

/// Memory of one client is bounded by construction: one slot per LATEST topic, the newest of each tile (shared bytes),
/// and a position in the shared backlog per RELIABLE topic.
class StreamSender {
 public:
  /// Each item that the client learns to have missed is added to `counts`, where it is given.
  StreamSender(const Backlogs& backlogs, std::uint64_t stream_id, DropCounts* counts = nullptr)
      : backlogs_(backlogs), stream_id_(stream_id), counts_(counts) {}

  /// Adds a subscription, or replaces that of the same id.
  std::vector<seeker::v1::TopicReply> subscribe(std::uint64_t id, const std::vector<TopicWish>& wishes);
  [[nodiscard]] bool unsubscribe(std::uint64_t id) { return subscriptions_.erase(id) > 0; }
  [[nodiscard]] std::size_t subscriptions() const { return subscriptions_.size(); }
  [[nodiscard]] bool has(std::uint64_t id) const { return subscriptions_.count(id) > 0; }

  /// Offers a new item of a LATEST topic other than tiles. Items that are missing in the sequence were replaced by
  /// newer ones before; they count as dropped, too.
  void offer(api::Topic topic, std::uint64_t sequence, const SharedBody& body);
  void offer_tiles(const EncodedTiles& tiles);

  /// The next frame that may be sent now. A status goes first: it is small, and what people act on; but never a second
  /// one before another topic that waits. All others are served in rotation.
  [[nodiscard]] std::optional<OutFrame> next(WallTime now);
  /// The time at which the next frame that a rate limit holds back may be sent; std::nullopt when there is none.
  [[nodiscard]] std::optional<WallTime> next_due() const;
  /// A RELIABLE topic whose next items have left the backlog since the client was too slow.
  [[nodiscard]] std::optional<api::Topic> overrun() const;

 private:
  struct TopicState {
    api::TopicRequest request;
    std::uint64_t position = 0;       ///< RELIABLE: sequence of the item sent last
    std::uint64_t known_missing = 0;  ///< RELIABLE: number of items that were not kept when the subscription began
    SharedBody slot;                  ///< LATEST: the newest item
    std::uint64_t slot_sequence = 0;
    std::uint64_t sent_sequence = 0;  ///< LATEST: of the item sent last; 0: none yet
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
  [[nodiscard]] std::optional<OutFrame> next_status(WallTime now);
  [[nodiscard]] std::optional<OutFrame> next_other(WallTime now);
  [[nodiscard]] const Backlog& backlog(api::Topic topic) const { return backlogs_[static_cast<std::size_t>(topic)]; }

  const Backlogs& backlogs_;
  std::uint64_t stream_id_;
  DropCounts* counts_;
  std::map<std::uint64_t, Subscription> subscriptions_;
  std::size_t next_topic_ = 0;
  bool status_went_ = false;  ///< the last frame was a status that went first
};

}  // namespace seeker::wire
