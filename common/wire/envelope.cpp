#include "common/wire/envelope.hpp"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::io::CodedInputStream;
using WireFormat = google::protobuf::internal::WireFormatLite;

/// As deep as protobuf itself goes.
constexpr int kMaxDepth = 100;

/// Counts the messages in encoded bytes without building any. False: damaged, or more than `budget`.
bool count_messages(CodedInputStream& in, const Descriptor& type, int depth, std::size_t& budget) {
  while (const std::uint32_t tag = in.ReadTag()) {
    const FieldDescriptor* field = type.FindFieldByNumber(WireFormat::GetTagFieldNumber(tag));
    const bool nested = field != nullptr && field->type() == FieldDescriptor::TYPE_MESSAGE &&
                        WireFormat::GetTagWireType(tag) == WireFormat::WIRETYPE_LENGTH_DELIMITED;
    if (!nested) {
      if (!WireFormat::SkipField(&in, tag)) {
        return false;
      }
      continue;
    }
    std::uint32_t length = 0;
    if (budget == 0 || depth >= kMaxDepth || !in.ReadVarint32(&length)) {
      return false;
    }
    --budget;
    const auto limit = in.PushLimit(static_cast<int>(length));
    const bool good = count_messages(in, *field->message_type(), depth + 1, budget) && in.BytesUntilLimit() == 0;
    in.PopLimit(limit);
    if (!good) {
      return false;
    }
  }
  return true;
}

void put_varint(std::string& out, std::uint64_t value) {
  constexpr std::uint64_t kMore = 0x80;
  for (; value >= kMore; value >>= 7U) {
    out += static_cast<char>((value & (kMore - 1)) | kMore);
  }
  out += static_cast<char>(value);
}

void put_tag(std::string& out, int field, WireFormat::WireType type) {
  put_varint(out, WireFormat::MakeTag(field, type));
}

}  // namespace

Status parse_within_limits(std::string_view payload, google::protobuf::Message& message) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(payload.data());
  CodedInputStream in(bytes, static_cast<int>(payload.size()));
  std::size_t budget = kMaxMessagesPerFrame;
  if (!count_messages(in, *message.GetDescriptor(), 0, budget)) {
    return budget == 0 ? fail(Errc::kTooLarge, "the frame holds too many messages")
                       : fail(Errc::kParse, "the frame holds no message of this protocol");
  }
  if (!message.ParseFromArray(payload.data(), static_cast<int>(payload.size()))) {
    return fail(Errc::kParse, "the frame holds no message of this protocol");
  }
  return {};
}

Result<pb::Envelope> parse_envelope(std::string_view payload) {
  pb::Envelope envelope;
  if (const Status parsed = parse_within_limits(payload, envelope); !parsed) {
    return tl::unexpected<Error>(parsed.error());
  }
  if (envelope.body_case() == pb::Envelope::BODY_NOT_SET) {
    return fail(Errc::kParse, "the frame holds an empty message, or one of a kind that is not known here");
  }
  return envelope;
}

Result<OutFrame> frame_of(const pb::Envelope& envelope) {
  if (envelope.ByteSizeLong() > kMaxFrameBytes) {
    return fail(Errc::kTooLarge, "the message has " + std::to_string(envelope.ByteSizeLong()) +
                                     " bytes, more than the 16 MiB of one frame");
  }
  return make_frame(envelope.SerializeAsString());
}

SharedBody encode_body(const api::Update& update) {
  pb::StreamUpdate message;
  write(update, &message);
  return std::make_shared<const std::string>(message.SerializeAsString());
}

SharedBody encode_tile(const OccupancyTile& tile) {
  pb::TileUpdate one;
  write(tile, one.add_tiles());
  return std::make_shared<const std::string>(one.SerializeAsString());
}

SharedBody join_tiles(const TilesHead& head, const std::vector<SharedBody>& entries) {
  pb::StreamUpdate outer;
  outer.set_topic(pb::TOPIC_TILES);
  outer.set_sequence(head.sequence);
  outer.set_stamp_ns(head.stamp.time_since_epoch().count());
  pb::TileUpdate inner;
  inner.set_revision(head.revision);
  inner.set_map_epoch(head.map_epoch);
  std::string fields = inner.SerializeAsString();
  for (const SharedBody& entry : entries) {
    fields += *entry;
  }
  std::string out = outer.SerializeAsString();
  put_tag(out, pb::StreamUpdate::kTilesFieldNumber, WireFormat::WIRETYPE_LENGTH_DELIMITED);
  put_varint(out, fields.size());
  out += fields;
  return std::make_shared<const std::string>(std::move(out));
}

OutFrame stream_frame(SharedBody body, std::uint64_t subscription_id, std::uint64_t dropped) {
  OutFrame frame;
  put_tag(frame.tail, pb::StreamUpdate::kSubscriptionIdFieldNumber, WireFormat::WIRETYPE_VARINT);
  put_varint(frame.tail, subscription_id);
  if (dropped != 0) {
    put_tag(frame.tail, pb::StreamUpdate::kDroppedFieldNumber, WireFormat::WIRETYPE_VARINT);
    put_varint(frame.tail, dropped);
  }
  std::string tag;
  put_tag(tag, pb::Envelope::kStreamUpdateFieldNumber, WireFormat::WIRETYPE_LENGTH_DELIMITED);
  put_varint(tag, body->size() + frame.tail.size());
  const auto header = frame_header(tag.size() + body->size() + frame.tail.size());
  frame.head.assign(header.data(), header.size());
  frame.head += tag;
  frame.body = std::move(body);
  return frame;
}

}  // namespace seeker::wire
