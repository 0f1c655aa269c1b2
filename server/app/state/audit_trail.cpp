#include "server/app/state/audit_trail.hpp"

#include <utility>

#include "common/log/log.hpp"
#include "common/wire/convert.hpp"

namespace seeker::app {
namespace {

constexpr std::string_view kPart = "audit";
/// Records that wait for the disk: hundreds of clients that all command something within a second.
constexpr std::size_t kMaxUnwritten = 10'000;
/// Writes and enquiries that wait; one write takes all records that wait.
constexpr std::size_t kMaxWork = 64;

store::AuditRow row_of(const api::AuditRecord& record) {
  const auto message = wire::to_message<wire::pb::AuditRecord>(record);
  store::AuditRow row{0, record.client, store::Blob(message.ByteSizeLong())};
  message.SerializeWithCachedSizesToArray(row.record.data());
  return row;
}

Result<api::AuditRecord> record_of(const store::AuditRow& row) {
  wire::pb::AuditRecord message;
  if (!message.ParseFromArray(row.record.data(), static_cast<int>(row.record.size()))) {
    return fail(Errc::kCorrupt, "record " + std::to_string(row.number) +
                                    " of who commanded what is damaged; move audit.db of the state folder away");
  }
  Result<api::AuditRecord> record = wire::from_message<api::AuditRecord>(message);
  if (record) {
    record->number = row.number;
  }
  return record;
}

/// Says in the file that something is missing there.
api::AuditRecord gap_before(const api::AuditRecord& next, std::uint64_t lost) {
  api::AuditRecord gap;
  gap.unix_ns = next.unix_ns;
  gap.stamp = next.stamp;
  gap.call = "audit";
  gap.essentials = std::to_string(lost) + " records were lost before this one, since the disk did not take them";
  gap.outcome = "lost";
  return gap;
}

void tell_log(const api::AuditRecord& record) {
  std::string text = "'" + record.client + "'" + (record.role.empty() ? "" : " (" + record.role + ")") + " at " +
                     record.address + ": " + record.call + (record.essentials.empty() ? "" : " ") + record.essentials +
                     ": " + record.outcome + (record.message.empty() ? "" : ", " + record.message);
  log::info(kPart, text);
}

}  // namespace

Result<std::unique_ptr<AuditTrail>> AuditTrail::open(const std::filesystem::path& folder) {
  Result<store::AuditFile> file = store::AuditFile::open(folder);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  if (!file->lost().empty()) {
    log::warning(kPart, file->lost());
  }
  return std::unique_ptr<AuditTrail>(new AuditTrail(std::move(*file)));
}

AuditTrail::AuditTrail(store::AuditFile file)
    : file_(std::move(file)), worker_(kMaxWork, "records of who commanded what") {}

AuditTrail::~AuditTrail() {
  worker_.finish();
  write_waiting();  // what came when the worker had too much to do
}

void AuditTrail::note(const api::AuditRecord& record) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kMaxUnwritten) {
      ++lost_;
      ++lost_untold_;
      return;
    }
    waiting_.push_back(record);
    if (waiting_.size() > 1) {
      return;  // a write is on its way already
    }
  }
  // Where enquiries fill the queue, each of them writes first what waits.
  static_cast<void>(worker_.post([this] { write_waiting(); }));
}

void AuditTrail::newest(const api::AuditQuery& query, const api::Reply<std::vector<api::AuditRecord>>& reply) {
  const Status posted = worker_.post([this, query, reply] {
    write_waiting();
    const Result<std::vector<store::AuditRow>> rows = file_.newest(query.last, query.client);
    if (!rows) {
      reply(tl::unexpected<Error>(rows.error()));
      return;
    }
    std::vector<api::AuditRecord> records;
    for (const store::AuditRow& row : *rows) {
      Result<api::AuditRecord> record = record_of(row);
      if (!record) {
        reply(tl::unexpected<Error>(record.error()));
        return;
      }
      records.push_back(std::move(*record));
    }
    reply(std::move(records));
  });
  if (!posted) {
    reply(tl::unexpected<Error>(posted.error()));
  }
}

void AuditTrail::set_watch(std::function<void(const Status&)> watch) {
  const std::lock_guard lock(mutex_);
  watch_ = std::move(watch);
}

std::uint64_t AuditTrail::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

void AuditTrail::write_waiting() {
  std::vector<api::AuditRecord> records;
  std::uint64_t untold = 0;
  {
    const std::lock_guard lock(mutex_);
    records.swap(waiting_);
    untold = lost_untold_;
  }
  if (!records.empty()) {
    write(records, untold);
  }
}

void AuditTrail::write(const std::vector<api::AuditRecord>& records, std::uint64_t untold) {
  std::vector<store::AuditRow> rows;
  rows.reserve(records.size() + 1);
  if (untold > 0) {
    rows.push_back(row_of(gap_before(records.front(), untold)));
  }
  for (const api::AuditRecord& record : records) {
    tell_log(record);
    rows.push_back(row_of(record));
  }
  note_outcome(file_.append(rows), records.size(), untold);
}

void AuditTrail::note_outcome(const Status& written, std::size_t records, std::uint64_t untold) {
  std::unique_lock lock(mutex_);
  if (written) {
    lost_untold_ -= untold;
  } else {
    lost_untold_ += records;
    lost_ += records;
  }
  const bool changed = std::exchange(failing_, !written) != failing_;
  const std::function<void(const Status&)> watch = changed ? watch_ : nullptr;
  lock.unlock();
  if (watch) {
    watch(written);
  }
}

}  // namespace seeker::app
