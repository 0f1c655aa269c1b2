#include "server/store/store_body.hpp"

namespace seeker::store {

Status check_blob(const char* what, const Blob& blob) {
  if (blob.size() > kMaxBlob_bytes) {
    return fail(Errc::kTooLarge, std::string(what) + " of " + std::to_string(blob.size()) +
                                     " bytes is over the limit of " + std::to_string(kMaxBlob_bytes));
  }
  return {};
}

Status check_texts(std::initializer_list<std::string_view> texts) {
  for (const std::string_view text : texts) {
    if (text.size() > kMaxText_bytes) {
      return fail(Errc::kTooLarge, "a text of " + std::to_string(text.size()) + " bytes is over the limit of " +
                                       std::to_string(kMaxText_bytes));
    }
  }
  return {};
}

Status check_id(const char* what, const std::string& id) {
  if (id.empty()) {
    return fail(Errc::kInvalidArgument, std::string(what) + " must not be empty");
  }
  return check_texts({id});
}

namespace {

Status write_event(Database& database, const EventRecord& event) {
  if (Status ok = check_texts({event.mission, event.severity, event.kind, event.text}); !ok) {
    return ok;
  }
  Result<Statement> insert = database.prepare("INSERT OR REPLACE INTO mission_events VALUES (?, ?, ?, ?, ?, ?, ?)");
  if (!insert) {
    return tl::unexpected(insert.error());
  }
  insert->bind(event.mission).bind(static_cast<std::int64_t>(event.sequence)).bind(event.robot_time_ns);
  event.mission_time_ns ? insert->bind(*event.mission_time_ns) : insert->bind_null();
  return insert->bind(event.severity).bind(event.kind).bind(event.text).run();
}

}  // namespace

Status Store::record_event(const EventRecord& event) { return write_event(body_->database, event); }

Status Store::record_events(std::span<const EventRecord> events) {
  Result<Transaction> transaction = Transaction::begin(body_->database);
  if (!transaction) {
    return tl::unexpected(transaction.error());
  }
  for (const EventRecord& event : events) {
    if (Status ok = write_event(body_->database, event); !ok) {
      return ok;
    }
  }
  return transaction->commit();
}

Result<std::vector<EventRecord>> Store::events(const std::string& mission) const {
  Result<Statement> select = body_->database.prepare(
      "SELECT mission, sequence, robot_time_ns, mission_time_ns, severity, kind, text FROM mission_events "
      "WHERE mission = ? ORDER BY sequence");
  if (!select) {
    return tl::unexpected(select.error());
  }
  select->bind(mission);
  return collect(select, [](const Statement& row) {
    return EventRecord{row.text(0),    static_cast<std::uint64_t>(row.integer(1)),
                       row.integer(2), row.is_null(3) ? std::nullopt : std::optional(row.integer(3)),
                       row.text(4),    row.text(5),
                       row.text(6)};
  });
}

Result<std::uint64_t> Store::highest_event(const std::string& mission) const {
  Result<Statement> select =
      body_->database.prepare("SELECT coalesce(max(sequence), 0) FROM mission_events WHERE mission = ?");
  if (!select) {
    return tl::unexpected(select.error());
  }
  select->bind(mission);
  const auto highest = collect(select, [](const Statement& row) { return static_cast<std::uint64_t>(row.integer(0)); });
  return highest ? Result<std::uint64_t>(highest->front()) : tl::unexpected(highest.error());
}

Status Store::save_detection(const DetectionRecord& detection) {
  if (Status ok = check_blob("a detection", detection.data); !ok) {
    return ok;
  }
  if (Status ok = check_texts({detection.mission, detection.target}); !ok) {
    return ok;
  }
  Result<Statement> insert = body_->database.prepare("INSERT OR REPLACE INTO detections VALUES (?, ?, ?, ?, ?)");
  if (!insert) {
    return tl::unexpected(insert.error());
  }
  return insert->bind(static_cast<std::int64_t>(detection.id))
      .bind(detection.mission)
      .bind(detection.target)
      .bind(detection.stamp_ns)
      .bind(detection.data)
      .run();
}

Result<std::vector<DetectionRecord>> Store::detections(const std::string& mission) const {
  Result<Statement> select = body_->database.prepare(
      "SELECT id, mission, target, stamp_ns, data FROM detections WHERE mission = ? ORDER BY id");
  if (!select) {
    return tl::unexpected(select.error());
  }
  select->bind(mission);
  return collect(select, [](const Statement& row) {
    return DetectionRecord{static_cast<std::uint64_t>(row.integer(0)), row.text(1), row.text(2), row.integer(3),
                           row.blob(4)};
  });
}

Result<std::uint64_t> Store::highest_detection_id() const {
  const Result<std::int64_t> id = body_->database.query_integer("SELECT coalesce(max(id), 0) FROM detections");
  if (!id) {
    return tl::unexpected(id.error());
  }
  return static_cast<std::uint64_t>(*id);
}

Status Store::put(const std::string& key, const Blob& value) {
  if (Status ok = check_id("the key", key); !ok) {
    return ok;
  }
  if (Status ok = check_blob("a value", value); !ok) {
    return ok;
  }
  Result<Statement> insert = body_->database.prepare("INSERT OR REPLACE INTO settings VALUES (?, ?)");
  if (!insert) {
    return tl::unexpected(insert.error());
  }
  return insert->bind(key).bind(value).run();
}

Result<std::optional<Blob>> Store::get(const std::string& key) const {
  Result<Statement> select = body_->database.prepare("SELECT value FROM settings WHERE key = ?");
  if (!select) {
    return tl::unexpected(select.error());
  }
  const Result<bool> row = select->bind(key).step();
  if (!row) {
    return tl::unexpected(row.error());
  }
  return *row ? std::optional(select->blob(0)) : std::nullopt;
}

}  // namespace seeker::store
