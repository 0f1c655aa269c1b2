/// \file
/// Envelopes as bytes: parsing within limits, framing, and stream updates that are encoded once for all receivers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "common/api/robot_api.hpp"
#include "common/wire/frame.hpp"
#include "seeker/v1/session.pb.h"

namespace seeker::wire {

/// Parses a message. kParse: the bytes are no such message. kTooLarge: it holds more messages than
/// kMaxMessagesPerFrame; they are counted before any of them is built.
[[nodiscard]] Status parse_within_limits(std::string_view payload, google::protobuf::Message& message);

/// Parses an Envelope. kParse: it is none, or an empty one. kTooLarge: as parse_within_limits().
[[nodiscard]] Result<seeker::v1::Envelope> parse_envelope(std::string_view payload);

/// Makes the frame of an Envelope. kTooLarge: it does not fit into one frame.
[[nodiscard]] Result<OutFrame> frame_of(const seeker::v1::Envelope& envelope);

/// The bytes of a StreamUpdate without subscription id and drop count, which all receivers share.
using SharedBody = std::shared_ptr<const std::string>;
[[nodiscard]] SharedBody encode_body(const api::Update& update);

/// One entry of TileUpdate.tiles with its tag, ready to be joined with others.
[[nodiscard]] SharedBody encode_tile(const OccupancyTile& tile);
struct TilesHead {
  std::uint64_t sequence = 0;
  RobotTime stamp;
  std::uint64_t revision = 0;
  std::uint32_t map_epoch = 0;
};
/// A StreamUpdate of the topic tiles from entries that were encoded before.
[[nodiscard]] SharedBody join_tiles(const TilesHead& head, const std::vector<SharedBody>& entries);

/// The frame for one receiver: the shared body between a small head and tail of its own.
[[nodiscard]] OutFrame stream_frame(SharedBody body, std::uint64_t subscription_id, std::uint64_t dropped);

}  // namespace seeker::wire
