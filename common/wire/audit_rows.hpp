/// \file
/// Rows of equal commands of one client, each of which becomes two records: nobody floods the trail of who commanded
/// what. Wall time is an argument.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "common/api/audit.hpp"
#include "common/wire/liveness.hpp"

namespace seeker::wire {

/// Commands of one kind that come within this time of each other are a row: driving, a key that is held, a client that
/// asks again and again for what it may not do.
inline constexpr Duration kAuditRowGap = std::chrono::seconds(2);

/// Of a row the first command is recorded at once and the last one, with the number of them, when the row is over.
class AuditRows {
 public:
  using Sink = std::function<void(const api::AuditRecord&)>;

  explicit AuditRows(Sink sink) : sink_(std::move(sink)) {}

  /// A command with its outcome. `kind` distinguishes it from commands that are not of its row; so does the outcome.
  void add(api::AuditRecord record, const std::string& kind, WallTime now);
  /// Ends rows in which nothing came for kAuditRowGap; to be called about once per second.
  void tick(WallTime now);
  /// The client is gone: ends all rows.
  void end();

 private:
  struct Row {
    std::uint64_t count = 0;
    api::AuditRecord last;
    WallTime began;
    WallTime continued;
  };

  void close(const Row& row) const;

  Sink sink_;
  std::map<std::string, Row> rows_;  ///< by kind and outcome
};

}  // namespace seeker::wire
