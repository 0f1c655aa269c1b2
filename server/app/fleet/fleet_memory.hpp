/// \file
/// What the main robot keeps on its disk of all maps together, and has again after a restart.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/app/fleet/fleet_pieces.hpp"
#include "server/app/fleet/fleet_records.hpp"
#include "server/app/fleet/fleet_slots.hpp"
#include "server/app/fleet/piece_files.hpp"
#include "server/app/fleet/robot_report.hpp"
#include "server/fleet/fleet_merge.hpp"

namespace seeker::app {

/// What the disk holds of all maps together.
struct RememberedFleet {
  std::uint32_t joint_epoch = 0;  ///< of the joint map; the next one has a higher epoch
  /// The main robot's own map; absent where it cannot be read: the rest is empty then.
  std::optional<LineMap> own_map;
  fleet::NodePictures own_pictures;
  std::optional<RobotTopology> own_topology;
  std::vector<api::Detection> own_finds;
  std::vector<fleet::PairAnswer> pairs;
};

/// What the judge knows of all maps together.
struct JudgedFleet {
  const LineMap* own_map = nullptr;                   ///< not null
  const fleet::NodePictures* own_pictures = nullptr;  ///< not null
  std::uint64_t own_version = 0;                      ///< rises when the own map or pictures change
  std::uint32_t joint_epoch = 0;
  std::vector<fleet::PairAnswer> pairs;  ///< of all robots
};

/// The file `memory`, and the main robot's own map and pictures as pieces beside it: of a map that grows most pieces
/// stay the same. read() is for the thread that makes this, before the worker starts; all else is for the worker,
/// without a lock.
class FleetMemory {
 public:
  /// `pieces` must outlive this and have the same folder.
  FleetMemory(std::filesystem::path folder, std::string robot_id, const PieceFiles& pieces, ReportDamage report_damage);

  /// The file as it is; nothing where there is none, or where it is damaged, which is reported.
  [[nodiscard]] std::optional<v1::KeptFleet> read() const;
  /// The numbers of the robots in the joint map; of two robots with one number the first.
  [[nodiscard]] static FleetSlots slots_of(const v1::KeptFleet& kept);
  /// Reads maps and pairs. Damage is reported, and what it concerns left out.
  [[nodiscard]] RememberedFleet recall(const v1::KeptFleet& kept);
  /// The judge has taken the map of recall() as this version.
  void set_own_version(std::uint64_t version) { packed_version_ = version; }

  /// Writes what has changed: pieces of the own map first, then the file. A failure is logged. Nothing is written
  /// before there is an own map.
  void keep(const JudgedFleet& judged, const RobotReport& own, const std::map<std::string, std::uint8_t>& slots);

 private:
  void keep_own_map(const LineMap& map, const fleet::NodePictures& pictures, std::uint64_t version);
  [[nodiscard]] std::vector<fleet::PairAnswer> recall_pairs(const v1::KeptFleet& kept) const;

  const std::filesystem::path folder_;
  const std::string robot_id_;
  const PieceFiles& pieces_;
  const ReportDamage report_damage_;
  PackedMap packed_;                  ///< the own map as it is on the disk
  std::uint64_t packed_version_ = 0;  ///< of it
  std::string written_;               ///< content of the file
};

}  // namespace seeker::app
