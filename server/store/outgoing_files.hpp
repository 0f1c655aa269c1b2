/// \file
/// Files that are sent in pieces: each piece with the hash of the whole, which is calculated once per content.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "common/core/result.hpp"
#include "common/digest/sha256.hpp"
#include "common/files/file_pieces.hpp"

namespace seeker::store {

struct OutgoingPiece {
  digest::Sha256Sum hash{};  ///< of the whole file
  std::uint64_t size_bytes = 0;
  std::vector<std::uint8_t> bytes;
};

/// Which bytes of a file are wanted.
struct OutgoingRange {
  std::uint64_t offset = 0;
  std::size_t max_bytes = 0;
  std::optional<digest::Sha256Sum> hash;  ///< of the file that they must be of
};

/// Calls come from one thread at a time.
class OutgoingFiles {
 public:
  /// `check` is called once for each content of a file, before anything of it is given out; its error is the answer.
  /// kRefused: the file has another hash than the range names, or changes just now; kInvalidArgument: the offset lies
  /// behind its end; errors of files::FileReader.
  [[nodiscard]] Result<OutgoingPiece> read(const std::filesystem::path& path, const OutgoingRange& range,
                                           const std::function<Status()>& check);

 private:
  struct Known {
    std::filesystem::path path;
    files::FileIdentity identity;
    digest::Sha256Sum hash{};
  };
  [[nodiscard]] Result<digest::Sha256Sum> hash_of(const std::filesystem::path& path,
                                                  const files::FileIdentity& identity,
                                                  const std::function<Status()>& check);

  std::deque<Known> known_;  ///< newest first
};

}  // namespace seeker::store
