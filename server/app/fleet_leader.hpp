/// \file
/// The main robot of a fleet: keeps what the others announce and send, merges their maps with its own on a worker, asks
/// the operator where that is not certain, and lets go of a robot whose map is contradicted (spec S4.7).
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/api/fleet.hpp"
#include "server/app/disk_worker.hpp"
#include "server/app/fleet_pieces.hpp"
#include "server/app/own_map.hpp"
#include "server/fleet/joint_map.hpp"
#include "server/fleet/map_merger.hpp"

namespace seeker::app {

struct FleetLeaderParams {
  std::filesystem::path folder;  ///< what robots sent is kept here, so that a restart loses nothing
  std::string robot_id;          ///< of the main one
  std::string software_version;
  Duration namesake_limit = std::chrono::seconds(5);  ///< wall time of silence after which an id may be taken over
  Duration retry_period = std::chrono::seconds(10);   ///< wall time until the same map is looked at again
  fleet::MergeParams merge;
};

/// Thread-safe; called by the network. Nothing that a robot sends changes what another one sent.
class FleetLeader {
 public:
  FleetLeader(FleetLeaderParams params, OwnMapSource own_map);

  /// Tells what a robot has. kRefused: another robot has this id; kTooLarge.
  [[nodiscard]] Result<api::FleetAnswer> announce(const api::FleetManifest& manifest);
  /// Bytes of the piece that are there afterwards. kCorrupt: its hash does not match, all of it is thrown away;
  /// kNotFound: nobody has announced it; kTooLarge.
  [[nodiscard]] Result<std::uint64_t> receive(const api::FleetChunk& chunk);
  [[nodiscard]] api::FleetStatus status() const;
  /// The operator's word: a hypothesis accepted, a robot taken out or in again. kNotFound, kRefused.
  [[nodiscard]] Result<api::FleetStatus> decide(const api::FleetDecision& decision);
  /// The joint map as the bytes of a map file; answers on the worker. kNotReady: nothing is merged yet; kTooLarge.
  void map(const api::Reply<std::vector<std::uint8_t>>& reply);

 private:
  using WallTime = std::chrono::steady_clock::time_point;

  struct Member {
    api::FleetManifest manifest;
    Pieces pieces;  ///< complete ones of the manifest
    std::map<api::PieceHash, std::vector<std::uint8_t>> partial;
    std::uint8_t slot = 1;  ///< in the joint map
    std::optional<WallTime> seen;
    std::optional<WallTime> judged;
    bool waits = false;  ///< to be judged by the worker
    bool split = false;
    std::optional<Pose2> accepted;  ///< main_T_map that the operator has accepted
    api::FleetState state = api::FleetState::kWaiting;
    std::string reason = "its map has not been looked at yet";
    std::vector<fleet::MergeHypothesis> hypotheses;
    std::optional<Pose2> main_T_map;
  };

  // With the lock held.
  [[nodiscard]] Status check_namesake(const api::FleetManifest& manifest, WallTime now) const;
  void take(Member& member, const api::FleetManifest& manifest);
  [[nodiscard]] static std::vector<api::FleetMissing> missing_of(const Member& member);
  void ask_for_judgement(const std::string& robot_id, Member& member);
  [[nodiscard]] api::FleetStatus status_now() const;
  [[nodiscard]] api::FleetMember describe(const Member& member, WallTime now) const;

  // On the worker.
  void load();
  void load_member(const std::filesystem::path& folder);
  void keep_piece(const std::string& robot_id, const api::PieceHash& hash, const PieceBytes& bytes) const;
  void keep_record(const std::string& robot_id);
  void judge(const std::string& robot_id);
  [[nodiscard]] Result<OwnMap> ask_own_map();
  [[nodiscard]] Result<fleet::MergeAnswer> compare(const std::string& robot_id, const LineMap& map);
  void settle(const std::string& robot_id, const Result<fleet::MergeAnswer>& answer);
  void join_all();

  FleetLeaderParams params_;
  OwnMapSource own_map_;
  fleet::MapMerger merger_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::map<std::string, Member> members_;
  std::vector<Point2> own_places_;
  std::optional<Pose2> own_map_T_base_;
  std::uint32_t revision_ = 0;
  // For the worker only.
  fleet::PreparedMap own_;
  std::map<std::string, fleet::PreparedMap> prepared_;
  std::optional<fleet::JointMap> joint_;
  std::uint32_t joint_epoch_ = 0;
  DiskWorker worker_;
};

}  // namespace seeker::app
