/// \file
/// What the main robot keeps of each of the others on its disk.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/app/fleet/fleet_records.hpp"
#include "server/app/fleet/member_record.hpp"
#include "server/app/fleet/piece_files.hpp"

namespace seeker::app {

/// A folder per robot with a sealed file and the pieces of its map. load() is for the thread that makes this, before
/// anybody else calls it; any thread may call keep(). A mutex is locked while a record is read from its owner and
/// written, so that the file never goes back to an older record; the owner's own mutex is taken after it.
class MemberRecords {
 public:
  /// `pieces` must outlive this and have the same folder.
  MemberRecords(std::filesystem::path folder, const PieceFiles& pieces, ReportDamage report_damage);

  /// Records of all robots but the main one, in an order that is the same on every disk. A damaged one is left out and
  /// reported.
  [[nodiscard]] std::vector<MemberRecord> load(const std::string& main_robot_id) const;
  /// Writes the newest record of a robot, and drops the pieces that it does not name. A failure is logged.
  void keep(const std::string& robot_id, const std::function<MemberRecord()>& newest);

 private:
  [[nodiscard]] std::optional<MemberRecord> load_one(const std::string& robot_id) const;

  const std::filesystem::path folder_;
  const PieceFiles& pieces_;
  const ReportDamage report_damage_;
  std::mutex mutex_;
};

}  // namespace seeker::app
