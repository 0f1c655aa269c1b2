#include "server/store/database.hpp"

#include <utility>

#include <sqlite3.h>

namespace seeker::store {
namespace {

/// What the caller may branch on, and what a person can do about it.
tl::unexpected<Error> failure(int code, const std::string& detail) {
  switch (code & 0xff) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB: return fail(Errc::kCorrupt, "the file is damaged (" + detail + ")");
    case SQLITE_BUSY:
    case SQLITE_LOCKED: return fail(Errc::kBusy, "another program has the file open; stop it or use another folder");
    case SQLITE_FULL: return fail(Errc::kIo, "no space is left for the file; free some on its disk");
    case SQLITE_TOOBIG: return fail(Errc::kTooLarge, "the value is too large for the file (" + detail + ")");
    case SQLITE_CONSTRAINT: return fail(Errc::kInvalidArgument, "the file refuses the value (" + detail + ")");
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
      return fail(Errc::kIo, "the file cannot be opened for writing (" + detail +
                                 "); check that the folder exists and belongs to this user");
    default:
      return fail(Errc::kIo, "the file cannot be read or written (" + detail + "); check its disk and free space");
  }
}

tl::unexpected<Error> failure(sqlite3* database, int code) {
  return failure(code, database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(code));
}

}  // namespace

Statement::Statement(Statement&& other) noexcept
    : database_(other.database_),
      statement_(std::exchange(other.statement_, nullptr)),
      bound_(other.bound_),
      failure_(other.failure_) {}

Statement::~Statement() {
  if (statement_ != nullptr) {
    sqlite3_reset(statement_);
    sqlite3_clear_bindings(statement_);
  }
}

Statement& Statement::bind(std::int64_t value) {
  const int code = sqlite3_bind_int64(statement_, ++bound_, value);
  failure_ = failure_ != SQLITE_OK ? failure_ : code;
  return *this;
}

Statement& Statement::bind(double value) {
  const int code = sqlite3_bind_double(statement_, ++bound_, value);
  failure_ = failure_ != SQLITE_OK ? failure_ : code;
  return *this;
}

Statement& Statement::bind(std::string_view text) {
  // SQLite copies: the text may be gone before step(). A null pointer would bind NULL instead of an empty text.
  const char* data = text.data() != nullptr ? text.data() : "";
  const int code = sqlite3_bind_text64(statement_, ++bound_, data, text.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  failure_ = failure_ != SQLITE_OK ? failure_ : code;
  return *this;
}

Statement& Statement::bind(std::span<const std::uint8_t> blob) {
  const int code = blob.empty() ? sqlite3_bind_zeroblob(statement_, ++bound_, 0)
                                : sqlite3_bind_blob64(statement_, ++bound_, blob.data(), blob.size(), SQLITE_TRANSIENT);
  failure_ = failure_ != SQLITE_OK ? failure_ : code;
  return *this;
}

Statement& Statement::bind_null() {
  const int code = sqlite3_bind_null(statement_, ++bound_);
  failure_ = failure_ != SQLITE_OK ? failure_ : code;
  return *this;
}

Result<bool> Statement::step() {
  const int code = failure_ != SQLITE_OK ? failure_ : sqlite3_step(statement_);
  if (code == SQLITE_ROW || code == SQLITE_DONE) {
    return code == SQLITE_ROW;
  }
  return failure(database_, code);
}

Status Statement::run() {
  if (const Result<bool> done = step(); !done) {
    return tl::unexpected(done.error());
  }
  return {};
}

bool Statement::is_null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_, column); }

double Statement::real(int column) const { return sqlite3_column_double(statement_, column); }

std::string Statement::text(int column) const {
  const unsigned char* data = sqlite3_column_text(statement_, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
  return data != nullptr ? std::string(reinterpret_cast<const char*>(data), size) : std::string();
}

std::vector<std::uint8_t> Statement::blob(int column) const {
  const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_, column));
  const auto size = static_cast<std::ptrdiff_t>(sqlite3_column_bytes(statement_, column));
  return data != nullptr ? std::vector<std::uint8_t>(data, data + size) : std::vector<std::uint8_t>();
}

Result<Database> Database::open(const std::filesystem::path& file, Access access) {
  sqlite3* raw = nullptr;
  const bool may_make = access == Access::kExclusive || access == Access::kMake;
  // Reading needs the right to write as well: a journal that a crash left behind is rolled back before.
  const int flags =
      SQLITE_OPEN_READWRITE | (may_make ? SQLITE_OPEN_CREATE : 0) | SQLITE_OPEN_FULLMUTEX | SQLITE_OPEN_EXRESCODE;
  const int code = sqlite3_open_v2(file.c_str(), &raw, flags, nullptr);
  Database database(raw);  // owns it in case of failure too
  if (code != SQLITE_OK) {
    return failure(raw, code);
  }
  // Exclusive: a second server on the same folder is refused at once instead of mixing two robots' missions.
  std::string pragmas = access == Access::kExclusive ? "PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = WAL;"
                                                     : "PRAGMA busy_timeout = 2000;";
  pragmas += "PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;";
  pragmas += access == Access::kRead ? "PRAGMA query_only = ON;" : "";
  if (Status ok = database.execute(pragmas); !ok) {
    return tl::unexpected(ok.error());
  }
  return database;
}

Database::Database(Database&& other) noexcept
    : database_(std::exchange(other.database_, nullptr)), statements_(std::move(other.statements_)) {
  other.statements_.clear();
}

Database& Database::operator=(Database&& other) noexcept {
  if (this != &other) {
    close();
    database_ = std::exchange(other.database_, nullptr);
    statements_ = std::move(other.statements_);
    other.statements_.clear();
  }
  return *this;
}

Database::~Database() { close(); }

void Database::close() noexcept {
  for (const auto& [sql, statement] : statements_) {
    sqlite3_finalize(statement);
  }
  statements_.clear();
  sqlite3_close_v2(database_);
  database_ = nullptr;
}

Result<Statement> Database::prepare(const std::string& sql) {
  if (const auto found = statements_.find(sql); found != statements_.end()) {
    return Statement(database_, found->second);
  }
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(database_, sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
  if (code != SQLITE_OK) {
    return failure(database_, code);
  }
  statements_.emplace(sql, statement);
  return Statement(database_, statement);
}

Status Database::execute(const std::string& sql) {
  const int code = sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) {
    return failure(database_, code);
  }
  return {};
}

Result<std::int64_t> Database::query_integer(const std::string& sql) {
  Result<Statement> statement = prepare(sql);
  if (!statement) {
    return tl::unexpected(statement.error());
  }
  const Result<bool> row = statement->step();
  if (!row) {
    return tl::unexpected(row.error());
  }
  return *row ? statement->integer(0) : 0;
}

Result<std::string> Database::query_text(const std::string& sql) {
  Result<Statement> statement = prepare(sql);
  if (!statement) {
    return tl::unexpected(statement.error());
  }
  const Result<bool> row = statement->step();
  if (!row) {
    return tl::unexpected(row.error());
  }
  return *row ? statement->text(0) : std::string();
}

int Database::changes() const { return sqlite3_changes(database_); }

bool Database::in_transaction() const { return sqlite3_get_autocommit(database_) == 0; }

Result<Transaction> Transaction::begin(Database& database) {
  const bool part = database.in_transaction();
  if (const Status ok = database.execute(part ? "SAVEPOINT part" : "BEGIN IMMEDIATE"); !ok) {
    return tl::unexpected(ok.error());
  }
  return Transaction(database, part);
}

Transaction::Transaction(Transaction&& other) noexcept
    : database_(std::exchange(other.database_, nullptr)), part_(other.part_) {}

Transaction::~Transaction() {
  if (database_ != nullptr) {
    // After some errors SQLite has rolled back itself, and then this fails: nothing is left to do in either case.
    static_cast<void>(database_->execute(part_ ? "ROLLBACK TO part; RELEASE part" : "ROLLBACK"));
  }
}

Status Transaction::commit() {
  const Status ok = database_->execute(part_ ? "RELEASE part" : "COMMIT");
  if (ok) {
    database_ = nullptr;
  }
  return ok;
}

}  // namespace seeker::store
