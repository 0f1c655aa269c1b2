/// \file
/// The bookkeeping of files that arrive in pieces: names on the disk, and who makes room for whom. No files here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seeker::store {

/// What arriving files may take, whole ones that are still kept included.
struct IncomingLimits {
  std::uint64_t total_bytes = 1UL << 30U;  ///< by the sizes that were announced
  std::size_t files = 256;
};

/// The name of a file that arrives: its SHA-256 in hexadecimal digits while it is whole, and "SHA256-SIZE.part" before,
/// so that a restarted program knows how much is to come.
struct IncomingName {
  std::string hash;              ///< 64 lower-case hexadecimal digits
  std::uint64_t size_bytes = 0;  ///< that was announced; 0 for a whole file
  bool whole = false;

  friend bool operator==(const IncomingName&, const IncomingName&) = default;
};
[[nodiscard]] std::string to_string(const IncomingName& name);
/// std::nullopt: no name of this kind.
[[nodiscard]] std::optional<IncomingName> parse_incoming_name(std::string_view text);

/// One file that is there.
struct IncomingEntry {
  std::string file;              ///< its name on the disk
  std::uint64_t size_bytes = 0;  ///< that it takes or will take
  std::int64_t used_ns = 0;      ///< when it was used last, by any clock
};
/// Names of the files to delete so that one more of `size_bytes` fits: those that were not used for longest, and no
/// more of them than needed.
[[nodiscard]] std::vector<std::string> to_drop(std::vector<IncomingEntry> entries, std::uint64_t size_bytes,
                                               const IncomingLimits& limits);

}  // namespace seeker::store
