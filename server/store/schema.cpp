#include "server/store/schema.hpp"

#include <string>

#include "server/store/store.hpp"

namespace seeker::store {
namespace {

constexpr const char* kTables = R"sql(
CREATE TABLE missions (
  id TEXT PRIMARY KEY,
  begun INTEGER NOT NULL,           -- rises with every mission begun: the order of missions over restarts
  kind TEXT NOT NULL,
  request BLOB NOT NULL,
  started_ns INTEGER NOT NULL,
  ended_ns INTEGER,                 -- NULL while the mission runs
  outcome TEXT, cause TEXT, remedy TEXT
) STRICT;
CREATE UNIQUE INDEX missions_by_begun ON missions (begun);

-- Without a reference to missions: an event outside a mission has the empty id.
CREATE TABLE mission_events (
  mission TEXT NOT NULL,
  sequence INTEGER NOT NULL,
  robot_time_ns INTEGER NOT NULL,
  mission_time_ns INTEGER,
  severity TEXT NOT NULL, kind TEXT NOT NULL, text TEXT NOT NULL,
  PRIMARY KEY (mission, sequence)
) STRICT, WITHOUT ROWID;

CREATE TABLE detections (
  id INTEGER PRIMARY KEY,
  mission TEXT NOT NULL,
  target TEXT NOT NULL,
  stamp_ns INTEGER NOT NULL,
  data BLOB NOT NULL
) STRICT;
CREATE INDEX detections_by_mission ON detections (mission, id);

CREATE TABLE settings (key TEXT PRIMARY KEY, value BLOB NOT NULL) STRICT, WITHOUT ROWID;
)sql";

Status check_structure(Database& database, const Schema& schema) {
  const Result<std::string> verdict = database.query_text(schema.check);
  if (!verdict) {
    return tl::unexpected(verdict.error());
  }
  if (*verdict != "ok") {
    return fail(Errc::kCorrupt, "the file is damaged (" + *verdict + ")");
  }
  return {};
}

/// A file from elsewhere may hold what runs when it is read, and never ends: no file of this program does.
Status check_plain(Database& database) {
  const Result<std::int64_t> others = database.query_integer(
      "SELECT count(*) FROM sqlite_master WHERE type NOT IN ('table', 'index') OR sql LIKE 'CREATE VIRTUAL%'");
  if (!others) {
    return tl::unexpected(others.error());
  }
  return *others == 0 ? Status()
                      : fail(Errc::kInvalidArgument,
                             "the file holds views, triggers or virtual tables, which no file of this program does");
}

Status create_tables(Database& database, const Schema& schema) {
  Result<Transaction> transaction = Transaction::begin(database);
  if (!transaction) {
    return tl::unexpected(transaction.error());
  }
  const std::string marks = "PRAGMA application_id = " + std::to_string(schema.application_id) +
                            "; PRAGMA user_version = " + std::to_string(schema.version) + ";";
  if (Status ok = database.execute(schema.tables + marks); !ok) {
    return ok;
  }
  return transaction->commit();
}

}  // namespace

const Schema& state_schema() {
  constexpr std::int64_t kApplicationId = 0x5345454B;  // "SEEK"
  static const Schema kSchema{kTables, kApplicationId, kSchemaVersion, "PRAGMA integrity_check(1)"};
  return kSchema;
}

Status prepare_schema(Database& database, const Schema& schema) {
  if (Status ok = check_structure(database, schema); !ok) {
    return ok;
  }
  const Result<std::int64_t> tables = database.query_integer("SELECT count(*) FROM sqlite_master");
  const Result<std::int64_t> version = database.query_integer("PRAGMA user_version");
  const Result<std::int64_t> application = database.query_integer("PRAGMA application_id");
  for (const auto* value : {&tables, &version, &application}) {
    if (!*value) {
      return tl::unexpected(value->error());
    }
  }
  if (*tables == 0 && *version == 0) {
    return create_tables(database, schema);
  }
  if (*application != schema.application_id) {
    return fail(Errc::kInvalidArgument, "the file is a database of another kind; choose another folder");
  }
  if (Status plain = check_plain(database); !plain) {
    return plain;
  }
  if (*version > schema.version) {
    return fail(Errc::kUnsupportedVersion, "the file has version " + std::to_string(*version) +
                                               ", this program knows versions up to " + std::to_string(schema.version) +
                                               "; update the program or choose another folder");
  }
  return {};
}

}  // namespace seeker::store
