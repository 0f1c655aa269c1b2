#include "server/store/state_file.hpp"

#include <system_error>
#include <utility>

#include "common/files/files.hpp"

namespace seeker::store {
namespace {

namespace fs = std::filesystem;

/// Moves a damaged file aside, under the first free name; its log belongs to it.
Result<fs::path> set_aside(const fs::path& file) {
  for (int n = 1;; ++n) {
    const fs::path kept = file.string() + ".damaged-" + std::to_string(n);
    std::error_code error;
    if (fs::exists(kept, error)) {
      continue;
    }
    for (const char* part : {"-wal", "-shm", ""}) {
      const fs::path from = file.string() + part;
      if (fs::exists(from, error)) {
        fs::rename(from, kept.string() + part, error);
      }
      if (error) {
        return fail(Errc::kIo, "and cannot be moved to '" + kept.string() + "': " + error.message());
      }
    }
    return kept;
  }
}

tl::unexpected<Error> open_failure(const fs::path& file, const Error& cause) {
  if (cause.code != Errc::kCorrupt) {
    return fail_with_context("state file '" + file.string() + "'", cause);
  }
  const Result<fs::path> kept = set_aside(file);
  return fail(Errc::kCorrupt,
              cause.message + ": '" + file.string() + "' " +
                  (kept ? "was moved to '" + kept->string() + "'; start again to begin with an empty one"
                        : kept.error().message));
}

}  // namespace

Result<Database> open_state_file(const fs::path& folder, const std::string& name, const Schema& schema) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error)) {
    return fail(Errc::kIo, "the state folder '" + folder.string() + "' cannot be made (" +
                               (error ? error.message() : "a file of that name exists already") +
                               "); choose another one with --state");
  }
  const fs::path file = folder / name;
  Result<Database> database = Database::open(file);
  if (!database) {
    return open_failure(file, database.error());
  }
  if (const Status ok = prepare_schema(*database, schema); !ok) {
    { const Database closed = std::move(*database); }
    return open_failure(file, ok.error());
  }
  if (const Status ok = files::sync_folder(folder); !ok) {
    return tl::unexpected(ok.error());
  }
  return database;
}

}  // namespace seeker::store
