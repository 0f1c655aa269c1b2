#include "server/store/audit_file.hpp"

#include <algorithm>
#include <utility>

#include "server/store/state_file.hpp"
#include "server/store/store_body.hpp"

namespace seeker::store {
namespace {

constexpr const char* kAuditFileName = "audit.db";
constexpr std::int64_t kAuditVersion = 1;

// AUTOINCREMENT: a number is not used again when all rows have been removed.
constexpr const char* kAuditTables = R"sql(
CREATE TABLE commands (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  client TEXT NOT NULL,
  record BLOB NOT NULL
) STRICT;
)sql";

const Schema& audit_schema() {
  constexpr std::int64_t kApplicationId = 0x53454155;  // "SEAU"
  static const Schema kSchema{kAuditTables, kApplicationId, kAuditVersion, "PRAGMA quick_check(1)"};
  return kSchema;
}

}  // namespace

Result<AuditFile> AuditFile::open(const std::filesystem::path& folder, std::size_t max_rows) {
  Result<StateFile> file = open_state_file(folder, kAuditFileName, "the record of commands", audit_schema());
  if (!file) {
    return tl::unexpected(file.error());
  }
  return AuditFile(std::move(*file), max_rows);
}

Status AuditFile::append(std::span<const AuditRow> rows) {
  Result<Transaction> transaction = Transaction::begin(database_);
  if (!transaction) {
    return tl::unexpected(transaction.error());
  }
  for (const AuditRow& row : rows) {
    Status ok = check_texts({row.client});
    ok = ok ? check_blob("a record", row.record) : ok;
    if (!ok) {
      return ok;
    }
    Result<Statement> insert = database_.prepare("INSERT INTO commands (client, record) VALUES (?, ?)");
    if (!insert) {
      return tl::unexpected(insert.error());
    }
    ok = insert->bind(row.client).bind(row.record).run();
    if (!ok) {
      return ok;
    }
  }
  Result<Statement> remove =
      database_.prepare("DELETE FROM commands WHERE number <= (SELECT max(number) FROM commands) - ?");
  if (!remove) {
    return tl::unexpected(remove.error());
  }
  if (Status ok = remove->bind(static_cast<std::int64_t>(max_rows_)).run(); !ok) {
    return ok;
  }
  return transaction->commit();
}

Result<std::vector<AuditRow>> AuditFile::newest(std::size_t limit, const std::string& client) {
  Result<Statement> select = database_.prepare(
      "SELECT number, client, record FROM commands "
      "WHERE ?1 = '' OR client = ?1 OR substr(client, 1, length(?1) + 1) = ?1 || '/' ORDER BY number DESC LIMIT ?2");
  if (!select) {
    return tl::unexpected(select.error());
  }
  select->bind(client).bind(static_cast<std::int64_t>(limit));
  auto rows = collect(select, [](const Statement& row) {
    return AuditRow{static_cast<std::uint64_t>(row.integer(0)), row.text(1), row.blob(2)};
  });
  if (rows) {
    std::reverse(rows->begin(), rows->end());
  }
  return rows;
}

}  // namespace seeker::store
