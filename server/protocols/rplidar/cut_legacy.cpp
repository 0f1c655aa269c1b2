#include "server/protocols/rplidar/stream_cut.hpp"

#include <algorithm>

namespace seeker::rplidar {
namespace {

/// From sample to sample an angle goes back by its correction for short distances at most, and ahead by what the
/// fastest rotor turns in a sample besides.
constexpr int kMaxBackQ6 = 10 * 64;
constexpr int kMaxAheadQ6 = 20 * 64;
/// How far behind a damaged sample the stream is searched for samples in a row.
constexpr std::size_t kSearch = 8 * kLegacyBytes;
/// So many samples in a row count as the stream, and so many where it should go on: these may stand between damaged
/// ones. Where both kinds are found the longer row decides, of up to kLongest.
constexpr std::size_t kRow = 3;
constexpr std::size_t kAlignedRow = 2;
constexpr std::size_t kLongest = 6;
constexpr std::size_t kLook = kSearch + kLongest * kLegacyBytes;
static_assert(kLook <= kMaxStreamLook);

bool follows(const LegacySample& before, const LegacySample& after) {
  const int ahead_q6 = (after.angle_q6 - before.angle_q6 + 2 * kRevolutionQ6) % kRevolutionQ6;
  return ahead_q6 <= kMaxAheadQ6 || ahead_q6 >= kRevolutionQ6 - kMaxBackQ6;
}

/// How many samples stand in a row from `at`, each a continuation of the one before; at most `most` are counted.
std::size_t row_at(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t most) {
  std::optional<LegacySample> before;
  for (std::size_t k = 0; k < most; ++k) {
    const std::size_t next = at + k * kLegacyBytes;
    const auto sample = next < bytes.size() ? decode_legacy(bytes.subspan(next)) : std::nullopt;
    if (!sample || (before && !follows(*before, *sample))) {
      return k;
    }
    before = sample;
  }
  return most;
}

/// The first place behind the front from which at least `enough` samples stand in a row, of the places that are a whole
/// number of samples behind it or of the others.
std::optional<std::size_t> find_row(std::span<const std::uint8_t> bytes, bool aligned, std::size_t enough) {
  for (std::size_t at = 1; at <= kSearch; ++at) {
    if ((at % kLegacyBytes == 0) == aligned && row_at(bytes, at, enough) == enough) {
      return at;
    }
  }
  return std::nullopt;
}

/// The place behind the front at which the stream goes on.
std::optional<std::size_t> find_stream(std::span<const std::uint8_t> bytes) {
  const std::optional<std::size_t> aligned = find_row(bytes, true, kAlignedRow);
  const std::optional<std::size_t> shifted = find_row(bytes, false, kRow);
  if (!aligned || !shifted) {
    return aligned ? aligned : shifted;
  }
  return row_at(bytes, *shifted, kLongest) > row_at(bytes, *aligned, kLongest) ? shifted : aligned;
}

}  // namespace

std::optional<StreamCut> cut_legacy(std::span<const std::uint8_t> bytes, const std::optional<LegacySample>& last) {
  if (bytes.size() < kRow * kLegacyBytes) {
    return std::nullopt;
  }
  const std::optional<LegacySample> sample = decode_legacy(bytes);
  const bool continues = sample && (!last || follows(*last, *sample));
  const bool row = row_at(bytes, 0, kRow) == kRow;
  if (continues && row) {
    return StreamCut{0, true};
  }
  if (bytes.size() < kLook) {
    return std::nullopt;
  }
  if (row) {
    return StreamCut{0, true};  // the angle has jumped, and the samples behind it agree
  }
  const std::optional<std::size_t> stream = find_stream(bytes);
  // Damage of the next sample, or a loss of bytes behind this one, leaves this one whole.
  if (continues && last && stream.value_or(kLegacyBytes) >= kLegacyBytes) {
    return StreamCut{0, true};
  }
  return StreamCut{stream ? std::min(*stream, kLegacyBytes) : 1, false};
}

}  // namespace seeker::rplidar
