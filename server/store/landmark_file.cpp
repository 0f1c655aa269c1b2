#include "server/store/landmark_file.hpp"

#include <system_error>
#include <utility>

#include "common/files/files.hpp"
#include "common/files/temporary_file.hpp"
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

/// Fills a new file.
Status write_new(const fs::path& file, const LandmarkOrigin& origin, const LandmarkContent& content) {
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

/// Changes the file in one transaction; `work` gets the version that is present before.
template <class Work>
Status change_file(const fs::path& file, Work work) {
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
  Status ok = work(*database, *present);
  return ok ? transaction->commit() : ok;
}

Result<LandmarkHeader> read_header(Database& database, const fs::path& file) {
  const Result<VersionRow> version = present_version(database);
  if (!version) {
    return tl::unexpected(version.error());
  }
  const Result<std::optional<VersionRow>> before = read_version(database, kBefore);
  LandmarkHeader header = version->header;
  header.can_revert = before && before->has_value();
  std::error_code error;
  header.file_bytes = fs::file_size(file, error);
  return header;
}

}  // namespace

Status write_landmark_file(const fs::path& file, const LandmarkOrigin& origin, const LandmarkContent& content) {
  Result<files::TemporaryFile> temporary = files::TemporaryFile::beside(file);
  if (!temporary) {
    return tl::unexpected<Error>(temporary.error());
  }
  if (Status ok = write_new(temporary->path(), origin, content); !ok) {
    return ok;
  }
  if (Status ok = temporary->move_to(file); !ok) {
    return ok;
  }
  return files::sync_folder(file.parent_path());
}

Status update_landmark_file(const fs::path& file, std::int64_t saved_unix_s, const LandmarkContent& content) {
  return change_file(file, [&](Database& database, const VersionRow& old) -> Status {
    if (Status ok = move_generation(database, kPresent, kBefore); !ok) {
      return ok;
    }
    LandmarkOrigin origin = old.header.origin;
    origin.saved_unix_s = saved_unix_s;
    return insert_version(database, old.header.revision + 1, origin, content);
  });
}

Status revert_landmark_file(const fs::path& file, std::int64_t saved_unix_s) {
  return change_file(file, [&](Database& database, const VersionRow& present) -> Status {
    const Result<std::optional<VersionRow>> before = read_version(database, kBefore);
    if (!before) {
      return tl::unexpected(before.error());
    }
    if (!*before) {
      return fail(Errc::kNotReady, "no version before the present one is kept");
    }
    if (Status ok = move_generation(database, kBefore, kPresent); !ok) {
      return ok;
    }
    return renumber_present(database, present.header.revision + 1, saved_unix_s);
  });
}

Result<LandmarkHeader> read_landmark_header(const fs::path& file) {
  Result<Database> database = open_file(file, Access::kRead);
  return database ? read_header(*database, file) : tl::unexpected(database.error());
}

Result<LandmarkFile> read_landmark_file(const fs::path& file) {
  Result<Database> database = open_file(file, Access::kRead);
  if (!database) {
    return tl::unexpected(database.error());
  }
  Result<LandmarkHeader> header = read_header(*database, file);
  if (!header) {
    return tl::unexpected(header.error());
  }
  Result<LandmarkContent> content = read_content(*database);
  if (!content) {
    return tl::unexpected(content.error());
  }
  return LandmarkFile{std::move(*header), std::move(*content)};
}

}  // namespace seeker::store
