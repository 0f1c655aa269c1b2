/// \file
/// The main robot of a fleet: keeps what the others announce and send, merges their maps with its own on a worker, asks
/// the operator where that is not certain, and lets go of a robot whose map is contradicted (spec S4.7).
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/api/fleet.hpp"
#include "server/app/fleet/fleet_judge.hpp"
#include "server/app/fleet/fleet_memory.hpp"
#include "server/app/fleet/fleet_sharing.hpp"
#include "server/app/fleet/member_book.hpp"
#include "server/app/fleet/member_records.hpp"
#include "server/app/fleet/own_map.hpp"
#include "server/app/fleet/own_robot.hpp"
#include "server/app/fleet/piece_files.hpp"
#include "server/app/runtime/disk_worker.hpp"
#include "server/fleet/map_merger.hpp"

namespace seeker::app {

struct FleetLeaderParams {
  std::filesystem::path folder;  ///< what robots sent is kept here, so that a restart loses nothing
  std::string robot_id;          ///< of the main one
  std::string software_version;
  Duration silence_limit = std::chrono::seconds(5);  ///< see FleetSettings
  Duration retry_period = std::chrono::seconds(10);  ///< wall time until the same map is judged again
  Duration floor_period = std::chrono::seconds(5);   ///< see FleetSharingParams
  Duration search_age = std::chrono::hours(1);       ///< see FleetSettings
  fleet::MergeParams merge;
};

/// The book of members, the judge, what is shared and the memory on the disk, with the worker that judges and writes.
/// Any thread may call all of it but refresh(), which is for one thread at a time. The judge and the memory are used on
/// the worker's thread only; book, main robot and records lock themselves. Locks are taken in this order: records,
/// book, main robot.
class FleetLeader {
 public:
  FleetLeader(FleetLeaderParams params, FleetHost host);

  /// Takes what a robot has. kRefused: another robot has this id; kTooLarge.
  [[nodiscard]] Result<api::FleetAnswer> announce(const api::FleetManifest& manifest);
  /// Bytes of the piece that are there afterwards. kCorrupt: its hash does not match, all of it is thrown away;
  /// kNotFound: nobody has announced it; kTooLarge.
  [[nodiscard]] Result<std::uint64_t> receive(const api::FleetChunk& chunk);
  /// Where a robot goes, and the answer: where the others go. kNotFound: it has to announce itself first.
  [[nodiscard]] Result<api::FleetShared> share(const api::FleetShare& share);
  /// What a robot has seen, and the answer: what the others have. kNotFound: as above.
  [[nodiscard]] Result<api::FleetSightings> seen(const api::FleetSeen& seen);
  /// What all of them have reported, to be looked at. kNotReady: nothing yet.
  [[nodiscard]] Result<api::FleetScene> scene() const;
  /// Exchanges the same with the main robot itself; to be called every now and then.
  void refresh();
  [[nodiscard]] api::FleetStatus status() const;
  /// The operator's decision: a hypothesis accepted, a robot taken out or in again. It is on the disk before this
  /// returns. kNotFound, kRefused.
  [[nodiscard]] Result<api::FleetStatus> decide(const api::FleetDecision& decision);
  /// The joint map as the bytes of a map file; answers on the worker. kNotReady: nothing is merged yet; kTooLarge.
  void map(const api::Reply<std::vector<std::uint8_t>>& reply);

 private:
  [[nodiscard]] FleetErrands errands(const FleetHost& host);
  void load();
  void keep_record(const std::string& robot_id);
  // On the worker.
  void recall(const v1::KeptFleet& kept);
  void keep_memory();

  const FleetLeaderParams params_;
  const PieceFiles pieces_;
  MemberRecords records_;
  FleetMemory memory_;
  OwnRobot main_;
  MemberBook book_;
  FleetJudge judge_;
  FleetSharing sharing_;
  DiskWorker worker_;  ///< the last: it ends before what it uses
};

}  // namespace seeker::app
