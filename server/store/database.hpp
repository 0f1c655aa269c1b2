/// \file
/// SQLite behind Result and RAII. Only this folder includes it; sqlite3.h stays in the source file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace seeker::store {

/// A prepared statement, borrowed from its Database, which keeps it for the next time. Values are bound in the order
/// of the question marks. A failed bind is told by step().
class Statement {
 public:
  Statement(sqlite3* database, sqlite3_stmt* statement) : database_(database), statement_(statement) {}
  Statement(Statement&& other) noexcept;
  Statement& operator=(Statement&&) = delete;
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement();

  Statement& bind(std::int64_t value);
  Statement& bind(double value);
  Statement& bind(std::string_view text);
  Statement& bind(std::span<const std::uint8_t> blob);
  Statement& bind_null();

  /// True: a row is there to be read. False: done.
  [[nodiscard]] Result<bool> step();
  /// For statements without rows.
  [[nodiscard]] Status run();

  [[nodiscard]] bool is_null(int column) const;
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double real(int column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::vector<std::uint8_t> blob(int column) const;

 private:
  sqlite3* database_;
  sqlite3_stmt* statement_;
  int bound_ = 0;
  int failure_ = 0;  ///< first result code of bind other than "ok"
};

/// How a database file is opened.
enum class Access : std::uint8_t {
  kExclusive,  ///< by this program alone, for long, with a write-ahead log beside it; made where it is absent
  kChange,     ///< for one change: no other file is left beside it
  kMake,       ///< the same; made where it is absent
  kRead,       ///< nothing is written, except that a change which a crash cut short is undone
};

/// One open database file. Every commit is synced. Not for two threads at once.
class Database {
 public:
  [[nodiscard]] static Result<Database> open(const std::filesystem::path& file, Access access = Access::kExclusive);

  Database(Database&& other) noexcept;
  Database& operator=(Database&& other) noexcept;
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database();

  [[nodiscard]] Result<Statement> prepare(const std::string& sql);
  /// One or more statements without rows and without values.
  [[nodiscard]] Status execute(const std::string& sql);
  /// The first column of the first row.
  [[nodiscard]] Result<std::int64_t> query_integer(const std::string& sql);
  [[nodiscard]] Result<std::string> query_text(const std::string& sql);
  /// Rows changed by the last statement.
  [[nodiscard]] int changes() const;

 private:
  explicit Database(sqlite3* database) : database_(database) {}
  void close() noexcept;

  sqlite3* database_ = nullptr;
  std::map<std::string, sqlite3_stmt*> statements_;
};

/// Undone unless committed.
class Transaction {
 public:
  [[nodiscard]] static Result<Transaction> begin(Database& database);
  Transaction(Transaction&& other) noexcept;
  Transaction& operator=(Transaction&&) = delete;
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();

  [[nodiscard]] Status commit();

 private:
  explicit Transaction(Database& database) : database_(&database) {}
  Database* database_;  ///< null once committed or moved from
};

}  // namespace seeker::store
