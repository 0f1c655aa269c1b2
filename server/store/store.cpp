#include "server/store/store.hpp"

#include <utility>

#include "server/store/pack.hpp"
#include "server/store/schema.hpp"
#include "server/store/state_file.hpp"
#include "server/store/store_body.hpp"

namespace seeker::store {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFileName = "seeker.db";
constexpr const char* kMissionColumns =
    "SELECT id, kind, request, started_ns, ended_ns, outcome, cause, remedy FROM missions ";

MissionRecord read_mission(const Statement& row) {
  MissionRecord mission{row.text(0), row.text(1), row.blob(2), row.integer(3), std::nullopt};
  if (!row.is_null(4)) {
    mission.end = MissionEndRecord{row.integer(4), row.text(5), row.text(6), row.text(7)};
  }
  return mission;
}

/// Of a mission that has ended, or of none: those of one without an end are its own.
Status remove_events_of_ended(Database& database, const std::string& mission) {
  Result<Statement> remove = database.prepare(
      "DELETE FROM mission_events WHERE mission = ?1 "
      "AND NOT EXISTS (SELECT 1 FROM missions WHERE id = ?1 AND ended_ns IS NULL)");
  if (!remove) {
    return tl::unexpected(remove.error());
  }
  return remove->bind(mission).run();
}

}  // namespace

Store::Store(std::unique_ptr<Body> body) : body_(std::move(body)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Result<Store> Store::open(const fs::path& folder) {
  Result<StateFile> file = open_state_file(folder, kFileName, "the journal", state_schema());
  if (!file) {
    return tl::unexpected(file.error());
  }
  return Store(std::make_unique<Body>(Body{std::move(file->database), std::move(file->lost)}));
}

const std::string& Store::lost() const { return body_->lost; }

Status Store::together(const std::function<Status()>& work) {
  Result<Transaction> transaction = Transaction::begin(body_->database);
  if (!transaction) {
    return tl::unexpected(transaction.error());
  }
  Status ok = work();
  return ok ? transaction->commit() : ok;
}

Status Store::begin_mission(const MissionRecord& mission) {
  if (Status ok = check_id("the mission's id", mission.id); !ok) {
    return ok;
  }
  if (Status ok = check_blob("a mission's request", mission.request); !ok) {
    return ok;
  }
  Result<Transaction> transaction = Transaction::begin(body_->database);
  if (!transaction) {
    return tl::unexpected(transaction.error());
  }
  if (Status ok = remove_events_of_ended(body_->database, mission.id); !ok) {
    return ok;
  }
  Result<Statement> insert = body_->database.prepare(
      "INSERT OR REPLACE INTO missions (id, begun, kind, request, started_ns, ended_ns, outcome, cause, remedy) "
      "VALUES (?, (SELECT coalesce(max(begun), 0) + 1 FROM missions), ?, ?, ?, ?, ?, ?, ?)");
  if (!insert) {
    return tl::unexpected(insert.error());
  }
  insert->bind(mission.id).bind(mission.kind).bind(mission.request).bind(mission.started_ns);
  if (mission.end) {
    insert->bind(mission.end->ended_ns).bind(mission.end->outcome).bind(mission.end->cause).bind(mission.end->remedy);
  } else {
    insert->bind_null().bind_null().bind_null().bind_null();
  }
  if (Status ok = insert->run(); !ok) {
    return ok;
  }
  return transaction->commit();
}

Status Store::end_mission(const std::string& id, const MissionEndRecord& end) {
  if (Status ok = check_texts({end.outcome, end.cause, end.remedy}); !ok) {
    return ok;
  }
  Result<Statement> update =
      body_->database.prepare("UPDATE missions SET ended_ns = ?, outcome = ?, cause = ?, remedy = ? WHERE id = ?");
  if (!update) {
    return tl::unexpected(update.error());
  }
  if (Status ok = update->bind(end.ended_ns).bind(end.outcome).bind(end.cause).bind(end.remedy).bind(id).run(); !ok) {
    return ok;
  }
  if (body_->database.changes() == 0) {
    return fail(Errc::kNotFound, "there is no mission '" + id + "' to end");
  }
  return {};
}

Result<std::optional<MissionRecord>> Store::unfinished_mission() const {
  Result<Statement> select =
      body_->database.prepare(std::string(kMissionColumns) + "WHERE ended_ns IS NULL ORDER BY begun DESC LIMIT 1");
  if (!select) {
    return tl::unexpected(select.error());
  }
  const Result<bool> row = select->step();
  if (!row) {
    return tl::unexpected(row.error());
  }
  return *row ? std::optional(read_mission(*select)) : std::nullopt;
}

Result<std::optional<MissionRecord>> Store::mission(const std::string& id) const {
  Result<Statement> select = body_->database.prepare(std::string(kMissionColumns) + "WHERE id = ?");
  if (!select) {
    return tl::unexpected(select.error());
  }
  const Result<bool> row = select->bind(id).step();
  if (!row) {
    return tl::unexpected(row.error());
  }
  return *row ? std::optional(read_mission(*select)) : std::nullopt;
}

Result<std::vector<MissionRecord>> Store::missions(std::size_t limit) const {
  Result<Statement> select = body_->database.prepare(std::string(kMissionColumns) + "ORDER BY begun DESC LIMIT ?");
  if (!select) {
    return tl::unexpected(select.error());
  }
  select->bind(static_cast<std::int64_t>(limit));
  return collect(select, &read_mission);
}

}  // namespace seeker::store
