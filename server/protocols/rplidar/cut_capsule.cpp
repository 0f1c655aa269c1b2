#include "server/protocols/rplidar/express_capsule.hpp"
#include "server/protocols/rplidar/stream_cut.hpp"

namespace seeker::rplidar {
namespace {

/// How many capsules after the last whole one are looked for where they are without a loss, the damaged ones included:
/// among the bytes of two damaged ones other bytes pass for a capsule once in 400 times.
constexpr std::size_t kGridCapsules = 3;
static_assert(kGridCapsules * kCapsuleBytes <= kMaxStreamLook);

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
    // Damage without a loss is the usual case: then one of the next capsules begins where it should.
    for (std::size_t at = kCapsuleBytes; at < kGridCapsules * kCapsuleBytes; at += kCapsuleBytes) {
      if (bytes.size() < at + kCapsuleBytes) {
        return std::nullopt;
      }
      if (whole_at(bytes, at)) {
        return StreamCut{at, true};
      }
    }
  }
  const std::size_t last = bytes.size() - kCapsuleBytes;
  const std::optional<std::size_t> first = find_whole(bytes, 0, last);
  if (!first) {
    return StreamCut{last + 1, false};
  }
  std::optional<StreamCut> chosen = choose(bytes, *first);
  // What lies before the first one is of no use while the decision waits for more bytes.
  return chosen || *first == 0 ? chosen : StreamCut{*first, false};
}

}  // namespace seeker::rplidar
