/// \file
/// Files that arrive in pieces, each known by its SHA-256, in a folder of their own. What has arrived outlives the
/// program, so that an upload goes on where it was cut off.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "common/core/result.hpp"
#include "common/digest/sha256.hpp"
#include "server/store/incoming_book.hpp"

namespace seeker::store {

/// The folder is made with the first file. No more than one piece is held in memory. Calls come from one thread at a
/// time. A file that is whole stays until room is needed, so that repeating an upload sends nothing.
class IncomingFiles {
 public:
  explicit IncomingFiles(std::filesystem::path folder, const IncomingLimits& limits = {});

  /// The bytes of the file that are here: all of them when it is whole. What was not used for longest is deleted to
  /// make room. kTooLarge: it does not fit at all; kInvalidArgument: it is here with another size; kIo: full disk.
  [[nodiscard]] Result<std::uint64_t> begin(const digest::Sha256Sum& hash, std::uint64_t size_bytes);
  /// Adds bytes of a file that was begun and answers as begin() does; those that are here already are left out. With
  /// the last ones the hash is checked. kNotFound: it was not begun, or was deleted to make room; kRefused: bytes
  /// before `offset` are missing; kInvalidArgument: beyond the size; kCorrupt: another hash, the file was deleted; kIo:
  /// full disk, what was here stays.
  [[nodiscard]] Result<std::uint64_t> append(const digest::Sha256Sum& hash, std::uint64_t offset,
                                             std::span<const std::uint8_t> bytes);
  /// Where a file is that is whole, after its hash was checked. kNotFound: it is not; kCorrupt: it was damaged on the
  /// disk, and deleted.
  [[nodiscard]] Result<std::filesystem::path> whole(const digest::Sha256Sum& hash) const;

 private:
  /// Of the files that are there; an absent folder has none.
  [[nodiscard]] std::vector<IncomingName> names() const;
  [[nodiscard]] std::vector<IncomingEntry> entries() const;
  [[nodiscard]] std::optional<IncomingName> part_of(const std::string& hash) const;
  [[nodiscard]] std::filesystem::path path_of(const IncomingName& name) const { return folder_ / to_string(name); }
  [[nodiscard]] std::filesystem::path whole_path_of(const std::string& hash) const { return path_of({hash, 0, true}); }
  [[nodiscard]] Status make_room(std::uint64_t size_bytes) const;
  [[nodiscard]] Result<std::uint64_t> take_whole(const IncomingName& part, const digest::Sha256Sum& hash) const;

  std::filesystem::path folder_;
  IncomingLimits limits_;
};

}  // namespace seeker::store
