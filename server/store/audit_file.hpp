/// \file
/// Records of who commanded what, in a file of bounded size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "server/store/database.hpp"
#include "server/store/state_file.hpp"
#include "server/store/store.hpp"

namespace seeker::store {

/// Newest records that are kept: with the texts of api::AuditRecord at most 80 MB.
inline constexpr std::size_t kMaxAuditRows = 100'000;

struct AuditRow {
  std::uint64_t number = 0;  ///< rises with each record and is never used again; given by the file
  std::string client;        ///< records are looked for by it
  Blob record;               ///< the caller decides how it is written

  friend bool operator==(const AuditRow&, const AuditRow&) = default;
};

/// The file `audit.db` in a folder. One program at a time, one thread at a time. What append() has taken without an
/// error is on the disk.
class AuditFile {
 public:
  /// Opens or creates it. Errors as Store::open(). `max_rows` is above 0.
  [[nodiscard]] static Result<AuditFile> open(const std::filesystem::path& folder,
                                              std::size_t max_rows = kMaxAuditRows);

  /// Adds all rows or none, in one write to the disk, and removes the oldest beyond the limit. The numbers of the rows
  /// do not count. kIo, kTooLarge.
  [[nodiscard]] Status append(std::span<const AuditRow> rows);
  /// The newest `limit` rows by rising number; of a client named so or "CLIENT/..." alone, unless `client` is empty.
  [[nodiscard]] Result<std::vector<AuditRow>> newest(std::size_t limit, const std::string& client = "");
  /// What was in the file and no longer is when it was opened, as a sentence; empty: nothing.
  [[nodiscard]] const std::string& lost() const { return lost_; }

 private:
  AuditFile(StateFile file, std::size_t max_rows)
      : database_(std::move(file.database)), lost_(std::move(file.lost)), max_rows_(max_rows) {}

  Database database_;
  std::string lost_;
  std::size_t max_rows_;
};

}  // namespace seeker::store
