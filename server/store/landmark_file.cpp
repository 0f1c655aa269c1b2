#include "server/store/landmark_file.hpp"

#include <bit>
#include <system_error>

#include "server/store/atomic_file.hpp"
#include "server/store/landmark_rows.hpp"

namespace seeker::store {
namespace {

namespace fs = std::filesystem;

Result<Database> open_file(const fs::path& file, Access access) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return fail(Errc::kNotFound, "there is no file '" + file.string() + "'");
  }
  Result<Database> database = Database::open(file, access);
  if (!database) {
    return database;
  }
  if (const Status ok = prepare_schema(*database, landmark_schema()); !ok) {
    return tl::unexpected(ok.error());
  }
  return database;
}

/// Writes a whole new file; what is there is removed.
Status write_new(const fs::path& file, const LandmarkOrigin& origin, const LandmarkContent& content) {
  std::error_code error;
  fs::remove(file, error);
  Result<Database> database = Database::open(file, Access::kMake);
  if (!database) {
    return tl::unexpected(database.error());
  }
  if (Status ok = prepare_schema(*database, landmark_schema()); !ok) {
    return ok;
  }
  Result<Transaction> transaction = Transaction::begin(*database);
  if (!transaction) {
    return tl::unexpected(transaction.error());
  }
  Status ok = insert_version(*database, 1, origin, content);
  return ok ? transaction->commit() : ok;
}

}  // namespace

Status write_landmark_file(const fs::path& file, const LandmarkOrigin& origin, const LandmarkContent& content) {
  const fs::path temporary = file.string() + ".new";
  std::error_code error;
  if (Status ok = write_new(temporary, origin, content); !ok) {
    fs::remove(temporary, error);
    return ok;
  }
  fs::rename(temporary, file, error);
  if (error) {
    return fail(Errc::kIo, "cannot rename '" + temporary.string() + "': " + error.message());
  }
  return sync_folder(file.parent_path());
}

Status update_landmark_file(const fs::path& file, std::int64_t saved_unix_s, const LandmarkContent& content) {
  Result<Database> database = open_file(file, Access::kChange);
  if (!database) {
    return tl::unexpected(database.error());
  }
  Result<Transaction> transaction = Transaction::begin(*database);
  if (!transaction) {
    return tl::unexpected(transaction.error());
  }
  const Result<VersionRow> old = present_version(*database);
  if (!old) {
    return tl::unexpected(old.error());
  }
  if (Status ok = move_generation(*database, kPresent, kBefore); !ok) {
    return ok;
  }
  LandmarkOrigin origin = old->header.origin;
  origin.saved_unix_s = saved_unix_s;
  Status ok = insert_version(*database, old->header.revision + 1, origin, content);
  return ok ? transaction->commit() : ok;
}

Status revert_landmark_file(const fs::path& file, std::int64_t saved_unix_s) {
  Result<Database> database = open_file(file, Access::kChange);
  if (!database) {
    return tl::unexpected(database.error());
  }
  Result<Transaction> transaction = Transaction::begin(*database);
  if (!transaction) {
    return tl::unexpected(transaction.error());
  }
  const Result<VersionRow> present = present_version(*database);
  if (!present) {
    return tl::unexpected(present.error());
  }
  const Result<std::optional<VersionRow>> before = read_version(*database, kBefore);
  if (!before) {
    return tl::unexpected(before.error());
  }
  if (!*before) {
    return fail(Errc::kNotReady, "no version before the present one is kept");
  }
  if (Status ok = move_generation(*database, kBefore, kPresent); !ok) {
    return ok;
  }
  Result<Statement> row = database->prepare("UPDATE versions SET revision = ?, saved_unix_s = ? WHERE generation = 0");
  if (!row) {
    return tl::unexpected(row.error());
  }
  row->bind(std::bit_cast<std::int64_t>(present->header.revision + 1)).bind(saved_unix_s);
  Status ok = row->run();
  return ok ? transaction->commit() : ok;
}

Result<LandmarkHeader> read_landmark_header(const fs::path& file) {
  Result<Database> database = open_file(file, Access::kRead);
  if (!database) {
    return tl::unexpected(database.error());
  }
  const Result<VersionRow> version = present_version(*database);
  if (!version) {
    return tl::unexpected(version.error());
  }
  const Result<std::optional<VersionRow>> before = read_version(*database, kBefore);
  LandmarkHeader header = version->header;
  header.can_revert = before && before->has_value();
  std::error_code error;
  header.file_bytes = fs::file_size(file, error);
  return header;
}

Result<LandmarkContent> read_landmark_file(const fs::path& file) {
  Result<Database> database = open_file(file, Access::kRead);
  if (!database) {
    return tl::unexpected(database.error());
  }
  const Result<VersionRow> version = present_version(*database);
  if (!version) {
    return tl::unexpected(version.error());
  }
  return read_content(*database, *version);
}

}  // namespace seeker::store
