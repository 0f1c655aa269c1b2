#include "server/store/state_file.hpp"

#include <system_error>
#include <utility>

#include "common/files/files.hpp"
#include "server/store/write_ahead_log.hpp"

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

/// What SQLite would take for a new or a whole file without a word; empty where nothing is lost.
std::string silent_loss(const fs::path& file, const std::string& what) {
  std::error_code error;
  if (fs::exists(file, error) && fs::file_size(file, error) == 0) {
    return what + " in '" + file.string() + "' was found empty: what was in it is lost";
  }
  const fs::path log = file.string() + "-wal";
  const auto bytes = files::read_file(log);
  const std::size_t forgotten = bytes ? forgotten_transactions(*bytes) : 0;
  if (forgotten > 1) {  // one was being written when the program ended
    return "the log '" + log.string() + "' was damaged: the last " + std::to_string(forgotten) + " writes to " + what +
           " are lost";
  }
  return "";
}

/// kCorrupt: the file is closed again, so that it can be moved.
Result<Database> open_checked(const fs::path& file, const Schema& schema) {
  Result<Database> database = Database::open(file);
  if (!database) {
    return database;
  }
  const Status ok = prepare_schema(*database, schema);
  return ok ? std::move(database) : Result<Database>(tl::unexpected(ok.error()));
}

}  // namespace

Result<StateFile> open_state_file(const fs::path& folder, const std::string& name, const std::string& what,
                                  const Schema& schema) {
  if (const Status made = files::make_folder(folder); !made) {
    return fail(Errc::kIo,
                "the state folder cannot be made: " + made.error().message + "; choose another one with --state");
  }
  const fs::path file = folder / name;
  std::string lost = silent_loss(file, what);
  Result<Database> database = open_checked(file, schema);
  if (!database && database.error().code == Errc::kCorrupt) {
    const Result<fs::path> kept = set_aside(file);
    if (!kept) {
      return fail(Errc::kCorrupt,
                  "state file '" + file.string() + "': " + database.error().message + ", " + kept.error().message);
    }
    lost = what + " was damaged (" + database.error().message + "): it was moved to '" + kept->string() +
           "' and an empty one begun";
    database = open_checked(file, schema);
  }
  if (!database) {
    return fail_with_context("state file '" + file.string() + "'", database.error());
  }
  if (const Status ok = files::sync_folder(folder); !ok) {
    return tl::unexpected(ok.error());
  }
  return StateFile{std::move(*database), std::move(lost)};
}

}  // namespace seeker::store
