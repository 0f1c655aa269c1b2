#include "server/store/write_ahead_log.hpp"

#include <algorithm>
#include <array>

namespace seeker::store {
namespace {

// https://sqlite.org/fileformat2.html#the_write_ahead_log
constexpr std::size_t kHeader_bytes = 32;
constexpr std::size_t kFrameHeader_bytes = 24;
constexpr std::size_t kPageSizeAt = 8;
constexpr std::size_t kSaltsAt = 16;     ///< in the header
constexpr std::size_t kChecksumAt = 24;  ///< of the header's bytes before
constexpr std::size_t kFrameSizeAt = 4;  ///< pages of the database after a transaction; 0 before its end
constexpr std::size_t kFrameSaltsAt = 8;
constexpr std::size_t kFrameChecksumAt = 16;
constexpr std::size_t kSummedOfFrame = 8;  ///< bytes of a frame's header in its checksum
constexpr std::uint32_t kMagic = 0x377f0682;
constexpr std::uint32_t kMinPage_bytes = 512;
constexpr std::uint32_t kMaxPage_bytes = 65536;

using Bytes = std::span<const std::uint8_t>;
using Pair = std::array<std::uint32_t, 2>;

std::uint32_t big_endian(Bytes bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < sizeof(value); ++k) {
    value = value << 8U | bytes[at + k];
  }
  return value;
}

std::uint32_t little_endian(Bytes bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = sizeof(value); k > 0; --k) {
    value = value << 8U | bytes[at + k - 1];
  }
  return value;
}

Pair pair(Bytes bytes, std::size_t at) { return {big_endian(bytes, at), big_endian(bytes, at + 4)}; }

/// The order of the bytes in the sums is in the last bit of the magic number.
void add(Bytes bytes, bool big, Pair& sums) {
  const auto word = big ? &big_endian : &little_endian;
  for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
    sums[0] += word(bytes, at) + sums[1];
    sums[1] += word(bytes, at + 4) + sums[0];
  }
}

}  // namespace

std::size_t forgotten_transactions(Bytes log) {
  if (log.size() < kHeader_bytes + kFrameHeader_bytes) {
    return 0;
  }
  const std::uint32_t page_bytes = big_endian(log, kPageSizeAt);
  const bool sane =
      page_bytes >= kMinPage_bytes && page_bytes <= kMaxPage_bytes && (page_bytes & (page_bytes - 1)) == 0;
  if (!sane) {
    return 0;
  }
  const std::uint32_t magic = big_endian(log, 0);
  const bool big = (magic & 1U) != 0;
  Pair sums{};
  add(log.first(kChecksumAt), big, sums);
  bool whole = (magic | 1U) == (kMagic | 1U) && sums == pair(log, kChecksumAt);
  // Frames of other salts are left from before the log was begun anew.
  const Pair salts = whole ? pair(log, kSaltsAt) : pair(log, kHeader_bytes + kFrameSaltsAt);
  std::size_t forgotten = 0;
  const std::size_t frame_bytes = kFrameHeader_bytes + page_bytes;
  for (Bytes rest = log.subspan(kHeader_bytes); rest.size() >= frame_bytes; rest = rest.subspan(frame_bytes)) {
    const Bytes frame = rest.first(frame_bytes);
    const bool ours = pair(frame, kFrameSaltsAt) == salts;
    if (whole) {
      add(frame.first(kSummedOfFrame), big, sums);
      add(frame.subspan(kFrameHeader_bytes), big, sums);
      whole = ours && sums == pair(frame, kFrameChecksumAt);
    }
    forgotten += !whole && ours && big_endian(frame, kFrameSizeAt) != 0 ? 1 : 0;
  }
  return forgotten;
}

}  // namespace seeker::store
