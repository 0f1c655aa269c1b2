/// \file
/// Who commanded what, kept over restarts: written to the disk on a thread of its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "common/api/robot_api.hpp"
#include "server/app/runtime/disk_worker.hpp"
#include "server/store/audit_file.hpp"

namespace seeker::app {

/// Each record becomes a line of the log and a row of the file. What has come since the last write is written in one,
/// so that a disk that is slow is asked less often. When it does not follow, or cannot be written, records are lost and
/// counted, and the next one that is written says how many.
class AuditTrail {
 public:
  /// Errors as store::AuditFile::open().
  [[nodiscard]] static Result<std::unique_ptr<AuditTrail>> open(const std::filesystem::path& folder);
  AuditTrail(const AuditTrail&) = delete;
  AuditTrail& operator=(const AuditTrail&) = delete;
  /// Writes what is waiting, then ends the thread.
  ~AuditTrail();

  /// From any thread; returns at once.
  void note(const api::AuditRecord& record);
  /// The newest records, also those that were noted just now; the reply comes on the trail's thread.
  void newest(const api::AuditQuery& query, const api::Reply<std::vector<api::AuditRecord>>& reply);
  /// Called on the trail's thread with the error of the first write that fails, and without one when the disk takes
  /// records again.
  void set_watch(std::function<void(const Status&)> watch);
  /// Records that were not kept since the start.
  [[nodiscard]] std::uint64_t lost() const;

 private:
  explicit AuditTrail(store::AuditFile file);
  void write_waiting();
  void write(const std::vector<api::AuditRecord>& records, std::uint64_t untold);
  void note_outcome(const Status& written, std::size_t records, std::uint64_t untold);

  store::AuditFile file_;  ///< the worker's thread
  mutable std::mutex mutex_;
  std::vector<api::AuditRecord> waiting_;
  std::uint64_t lost_ = 0;
  std::uint64_t lost_untold_ = 0;  ///< not yet said in the file
  bool failing_ = false;           ///< the last write failed
  std::function<void(const Status&)> watch_;
  DiskWorker worker_;
};

}  // namespace seeker::app
