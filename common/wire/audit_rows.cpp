#include "common/wire/audit_rows.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "common/wire/convert.hpp"

namespace seeker::wire {

void AuditRows::add(api::AuditRecord record, const std::string& kind, WallTime now) {
  Row& row = rows_[kind + " " + record.outcome];
  if (row.count > 0 && now - row.continued >= kAuditRowGap) {
    close(row);
    row = {};
  }
  if (row.count == 0) {
    sink_(record);
    row.began = now;
  }
  ++row.count;
  row.continued = now;
  row.last = std::move(record);
}

void AuditRows::close(const Row& row) const {
  if (row.count < 2) {
    return;
  }
  std::array<char, 64> head{};
  std::snprintf(head.data(), head.size(), "the last of %llu in %.1f s", static_cast<unsigned long long>(row.count),
                to_seconds(row.continued - row.began));
  api::AuditRecord record = row.last;
  record.essentials = one_line(head.data() + (record.essentials.empty() ? std::string() : ": " + record.essentials),
                               api::kMaxAuditEssentials_bytes);
  sink_(record);
}

void AuditRows::tick(WallTime now) {
  std::erase_if(rows_, [&](const auto& entry) {
    const bool over = now - entry.second.continued >= kAuditRowGap;
    if (over) {
      close(entry.second);
    }
    return over;
  });
}

void AuditRows::end() {
  for (const auto& [kind, row] : std::exchange(rows_, {})) {
    close(row);
  }
}

}  // namespace seeker::wire
