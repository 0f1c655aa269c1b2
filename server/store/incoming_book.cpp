#include "server/store/incoming_book.hpp"

#include <algorithm>
#include <charconv>
#include <tuple>

#include "common/digest/sha256.hpp"

namespace seeker::store {
namespace {

constexpr std::size_t kHashDigits = digest::kSha256HexDigits;
constexpr std::string_view kPartEnding = ".part";

}  // namespace

std::string to_string(const IncomingName& name) {
  return name.whole ? name.hash : name.hash + "-" + std::to_string(name.size_bytes) + std::string(kPartEnding);
}

std::optional<IncomingName> parse_incoming_name(std::string_view text) {
  if (digest::is_sha256_hex(text)) {
    return IncomingName{std::string(text), 0, true};
  }
  if (text.size() <= kHashDigits + 1 || !digest::is_sha256_hex(text.substr(0, kHashDigits)) ||
      text[kHashDigits] != '-' || !text.ends_with(kPartEnding)) {
    return std::nullopt;
  }
  IncomingName name{std::string(text.substr(0, kHashDigits)), 0, false};
  const char* const end = text.data() + text.size() - kPartEnding.size();
  const auto [rest, error] = std::from_chars(text.data() + kHashDigits + 1, end, name.size_bytes);
  // What is written back is the same name: one file has one.
  const bool read = error == std::errc() && rest == end && name.size_bytes > 0 && to_string(name) == text;
  return read ? std::optional(std::move(name)) : std::nullopt;
}

std::vector<std::string> to_drop(std::vector<IncomingEntry> entries, std::uint64_t size_bytes,
                                 const IncomingLimits& limits) {
  std::sort(entries.begin(), entries.end(), [](const IncomingEntry& a, const IncomingEntry& b) {
    return std::tie(a.used_ns, a.file) < std::tie(b.used_ns, b.file);
  });
  std::uint64_t total = size_bytes;
  for (const IncomingEntry& entry : entries) {
    total += entry.size_bytes;
  }
  std::size_t count = entries.size() + 1;
  std::vector<std::string> gone;
  for (const IncomingEntry& entry : entries) {
    if (total <= limits.total_bytes && count <= limits.files) {
      break;
    }
    total -= entry.size_bytes;
    --count;
    gone.push_back(entry.file);
  }
  return gone;
}

}  // namespace seeker::store
