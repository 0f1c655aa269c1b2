#include "server/protocols/rplidar/express_capsule.hpp"
#include "server/protocols/rplidar/stream_cut.hpp"

namespace seeker::rplidar {
namespace {

static_assert(3 * kCapsuleBytes <= kMaxStreamLook);

bool whole_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return at <= bytes.size() && decode_capsule(bytes.subspan(at)).has_value();
}

/// The first whole capsule from `from` to `to`, both included.
std::optional<std::size_t> find_whole(std::span<const std::uint8_t> bytes, std::size_t from, std::size_t to) {
  for (std::size_t at = from; at <= to; ++at) {
    if (whole_at(bytes, at)) {
      return at;
    }
  }
  return std::nullopt;
}

/// Other bytes pass for a capsule now and then: what has a successor is one, rather than what overlaps it.
std::optional<StreamCut> choose(std::span<const std::uint8_t> bytes, std::size_t first) {
  const std::size_t behind = first + kCapsuleBytes;
  if (bytes.size() < behind + 2) {
    return std::nullopt;
  }
  if (may_begin_capsule(bytes.subspan(behind))) {
    return StreamCut{first, true};
  }
  if (bytes.size() < behind + kCapsuleBytes + 1) {
    return std::nullopt;
  }
  const std::optional<std::size_t> rival = find_whole(bytes, first + 1, behind - 1);
  const bool better = rival && may_begin_capsule(bytes.subspan(*rival + kCapsuleBytes));
  return StreamCut{better ? *rival : first, true};
}

}  // namespace

std::optional<StreamCut> cut_capsule(std::span<const std::uint8_t> bytes, bool aligned) {
  if (bytes.size() < kCapsuleBytes) {
    return std::nullopt;
  }
  if (aligned && whole_at(bytes, 0)) {
    return choose(bytes, 0);
  }
  if (aligned) {
    // Damage without a loss is the usual case: then the next capsule begins where it should.
    if (bytes.size() < 2 * kCapsuleBytes) {
      return std::nullopt;
    }
    if (whole_at(bytes, kCapsuleBytes)) {
      return StreamCut{kCapsuleBytes, true};
    }
  }
  const std::size_t last = bytes.size() - kCapsuleBytes;
  const std::optional<std::size_t> first = find_whole(bytes, 0, last);
  return first ? choose(bytes, *first) : std::optional(StreamCut{last + 1, false});
}

}  // namespace seeker::rplidar
