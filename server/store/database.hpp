/// \file
/// SQLite behind Result and RAII. Only this folder includes this header, and only its source file sqlite3.h.
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

/// A prepared statement, borrowed from its Database, which keeps it for later use. Values are bound in the order of the
/// question marks. step() returns the error of a failed bind.
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

  /// Executes up to the next row. True: a row can be read; false: there are no more.
  [[nodiscard]] Result<bool> step();
  /// Executes a statement that returns no rows.
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
  kChange,     ///< for one change; no other file is left beside it
  kMake,       ///< as kChange; the file is made where it is absent
  kRead,       ///< for reading; a change that a crash has interrupted is undone
};

/// One open database file, for one thread at a time. Every commit is synced to the disk.
class Database {
 public:
  [[nodiscard]] static Result<Database> open(const std::filesystem::path& file, Access access = Access::kExclusive);

  Database(Database&& other) noexcept;
  Database& operator=(Database&& other) noexcept;
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database();

  [[nodiscard]] Result<Statement> prepare(const std::string& sql);
  /// Executes one or more statements that take no values and return no rows.
  [[nodiscard]] Status execute(const std::string& sql);
  /// Executes a query and returns the first column of its first row.
  [[nodiscard]] Result<std::int64_t> query_integer(const std::string& sql);
  [[nodiscard]] Result<std::string> query_text(const std::string& sql);
  /// Number of rows that the last statement has changed.
  [[nodiscard]] int changes() const;
  [[nodiscard]] bool in_transaction() const;

 private:
  explicit Database(sqlite3* database) : database_(database) {}
  void close() noexcept;

  sqlite3* database_ = nullptr;
  std::map<std::string, sqlite3_stmt*> statements_;
};

/// A transaction, which is undone when it is destroyed without a commit. One inside another is a part of it: undone
/// alone, but on the disk only with the outer one.
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
  Transaction(Database& database, bool part) : database_(&database), part_(part) {}
  Database* database_;  ///< null once committed or moved from
  bool part_;           ///< inside another
};

}  // namespace seeker::store
