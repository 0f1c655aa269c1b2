#include "server/protocols/lms200/scan_telegram.hpp"

#include <string>

#include "common/core/assert.hpp"
#include "server/protocols/lms200/little_endian.hpp"
#include "server/protocols/lms200/responses.hpp"

namespace seeker::lms200 {
namespace {

/// Fields of the word in front of the values (protocols 2.7).
constexpr unsigned kCountMask = 0x03FF;
constexpr unsigned kPartialShift = 11;
constexpr unsigned kPartialMask = 0x03;
constexpr unsigned kPartialFlag = 0x2000;
constexpr unsigned kUnitShift = 14;

constexpr std::size_t kSubRangeBytes = 4;
constexpr std::size_t kMaxIndexBytes = 2;

std::uint16_t count_word(const ScanTelegram& scan) {
  unsigned word = static_cast<unsigned>(scan.words.size()) | (static_cast<unsigned>(scan.unit) << kUnitShift);
  if (scan.partial) {
    word |= kPartialFlag | (unsigned{*scan.partial} << kPartialShift);
  }
  return static_cast<std::uint16_t>(word);
}

Status read_count_word(unsigned word, ScanTelegram& scan) {
  const std::optional<Unit> unit = unit_of(static_cast<std::uint8_t>(word >> kUnitShift));
  if (!unit) {
    return fail(Errc::kParse, "a scan states a unit that does not exist");
  }
  if ((word & kCountMask) > ScanTelegram::kMaxValues) {
    return fail(Errc::kParse, "a scan states more values than the scanner has");
  }
  scan.unit = *unit;
  if ((word & kPartialFlag) != 0) {
    scan.partial = static_cast<std::uint8_t>((word >> kPartialShift) & kPartialMask);
  }
  return {};
}

void read_indices(std::span<const std::uint8_t> bytes, bool real_time_index, ScanTelegram& scan) {
  if (bytes.size() == kMaxIndexBytes || (bytes.size() == 1 && real_time_index)) {
    scan.real_time_index = bytes.front();
  }
  if (bytes.size() == kMaxIndexBytes || (bytes.size() == 1 && !real_time_index)) {
    scan.telegram_index = bytes.back();
  }
}

Status check_sub_range(const ScanTelegram& scan) {
  const bool fits = !scan.sub_range || (scan.sub_range->first >= 1 && scan.sub_range->last >= scan.sub_range->first &&
                                        scan.sub_range->last <= ScanTelegram::kMaxValues &&
                                        scan.words.size() + scan.sub_range->first == scan.sub_range->last + 1U);
  return fits ? Status() : fail(Errc::kParse, "the number of values in a scan is not that of its sub-range");
}

}  // namespace

std::vector<std::uint8_t> encode(const ScanTelegram& scan, std::uint8_t status) {
  SEEKER_ASSERT(scan.words.size() <= ScanTelegram::kMaxValues);
  SEEKER_ASSERT(scan.partial.value_or(0) <= ScanTelegram::kMaxPartial);
  std::vector<std::uint8_t> bytes{scan.sub_range ? response_code::kSubRange : response_code::kValues};
  bytes.reserve(1 + kSubRangeBytes + 2 + 2 * scan.words.size() + kMaxIndexBytes + 1);
  if (scan.sub_range) {
    append_u16(bytes, scan.sub_range->first);
    append_u16(bytes, scan.sub_range->last);
  }
  append_u16(bytes, count_word(scan));
  for (const std::uint16_t word : scan.words) {
    append_u16(bytes, word);
  }
  for (const std::optional<std::uint8_t>& index : {scan.real_time_index, scan.telegram_index}) {
    if (index) {
      bytes.push_back(*index);
    }
  }
  bytes.push_back(status);
  return bytes;
}

Result<ScanTelegram> decode_scan(std::span<const std::uint8_t> payload, bool real_time_index) {
  SEEKER_ASSERT(!payload.empty());
  const bool ranged = payload[0] == response_code::kSubRange;
  const std::size_t count_at = 1 + (ranged ? kSubRangeBytes : 0);
  const std::size_t words_at = count_at + 2;
  if (payload.size() < words_at + 1) {
    return fail(Errc::kParse, "a scan ends before its number of values");
  }
  ScanTelegram scan;
  const unsigned count = u16_at(payload, count_at);
  if (Status read = read_count_word(count, scan); !read) {
    return tl::unexpected<Error>(read.error());
  }
  const std::size_t indices_at = words_at + 2 * (count & kCountMask);
  if (payload.size() < indices_at + 1 || payload.size() > indices_at + kMaxIndexBytes + 1) {
    return fail(Errc::kParse, "a scan of " + std::to_string(count & kCountMask) + " values has " +
                                  std::to_string(payload.size()) + " bytes");
  }
  scan.words.reserve(count & kCountMask);
  for (std::size_t at = words_at; at < indices_at; at += 2) {
    scan.words.push_back(u16_at(payload, at));
  }
  read_indices(payload.subspan(indices_at, payload.size() - 1 - indices_at), real_time_index, scan);
  if (ranged) {
    scan.sub_range = SubRange{u16_at(payload, 1), u16_at(payload, 3)};
  }
  if (Status fits = check_sub_range(scan); !fits) {
    return tl::unexpected<Error>(fits.error());
  }
  return scan;
}

}  // namespace seeker::lms200
