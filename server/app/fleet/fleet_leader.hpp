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
#include <utility>
#include <vector>

#include "common/api/fleet.hpp"
#include "server/app/fleet/fleet_news.hpp"
#include "server/app/fleet/fleet_pieces.hpp"
#include "server/app/fleet/own_map.hpp"
#include "server/app/runtime/disk_worker.hpp"
#include "server/fleet/fleet_links.hpp"
#include "server/fleet/joint_map.hpp"
#include "server/fleet/map_merger.hpp"
#include "server/nav/shared_floor.hpp"

namespace google::protobuf {
template <class T>
class RepeatedPtrField;
}  // namespace google::protobuf
namespace seeker::v1 {
class Detection;
class KeptFleet;
}  // namespace seeker::v1

namespace seeker::app {

struct FleetLeaderParams {
  std::filesystem::path folder;  ///< what robots sent is kept here, so that a restart loses nothing
  std::string robot_id;          ///< of the main one
  std::string software_version;
  Duration silence_limit = std::chrono::seconds(5);  ///< see FleetSettings
  Duration retry_period = std::chrono::seconds(10);  ///< wall time until the same map is looked at again
  Duration floor_period = std::chrono::seconds(5);  ///< wall time between what its own robot hears of the others' floor
  Duration search_age = std::chrono::hours(1);      ///< see FleetSettings
  fleet::MergeParams merge;
};

inline constexpr const char* kSplitReason = "taken out by the operator; 'seeker fleet merge' takes it in again";

/// Whether two manifests of a robot have a local map in common, at the same place: else it has begun a new map.
[[nodiscard]] bool same_frame(const std::vector<api::FleetNode>& a, const std::vector<api::FleetNode>& b);

/// What was found, in another frame; without what lies out of reach there: whoever is told would refuse all of it.
[[nodiscard]] std::vector<api::Detection> carried(std::vector<api::Detection> found, const Pose2& new_T_old);

/// Thread-safe; called by the network. Nothing that a robot sends changes what another one sent.
class FleetLeader {
 public:
  FleetLeader(FleetLeaderParams params, FleetHost host);

  /// Tells what a robot has. kRefused: another robot has this id; kTooLarge.
  [[nodiscard]] Result<api::FleetAnswer> announce(const api::FleetManifest& manifest);
  /// Bytes of the piece that are there afterwards. kCorrupt: its hash does not match, all of it is thrown away;
  /// kNotFound: nobody has announced it; kTooLarge.
  [[nodiscard]] Result<std::uint64_t> receive(const api::FleetChunk& chunk);
  /// Where a robot goes, and the answer: where the others go. kNotFound: it has to announce itself first.
  [[nodiscard]] Result<api::FleetShared> share(const api::FleetShare& share);
  /// What a robot has seen, and the answer: what the others have. kNotFound: as above.
  [[nodiscard]] Result<api::FleetSightings> seen(const api::FleetSeen& seen);
  /// Asks the main robot itself where it goes, and tells it of the others; to be called every now and then.
  void refresh();
  [[nodiscard]] api::FleetStatus status() const;
  /// The operator's word: a hypothesis accepted, a robot taken out or in again. kNotFound, kRefused.
  [[nodiscard]] Result<api::FleetStatus> decide(const api::FleetDecision& decision);
  /// The joint map as the bytes of a map file; answers on the worker. kNotReady: nothing is merged yet; kTooLarge.
  void map(const api::Reply<std::vector<std::uint8_t>>& reply);

 private:
  using WallTime = std::chrono::steady_clock::time_point;

  /// What a robot has found, in its own frame `map`.
  struct Finds {
    std::vector<api::Detection> now;     ///< told by the program that runs
    std::vector<api::Detection> before;  ///< told by programs that have ended
    /// Within the limits of a fleet, each id once.
    [[nodiscard]] std::vector<api::Detection> all() const;
  };
  /// What a robot has searched, in its own frame `map`.
  struct DatedSearch {
    std::optional<SearchedFloor> floor;
    WallTime changed;  ///< when it last told something else
    /// Nothing told changes nothing: a robot that was started anew has forgotten what it searched, the floor has not.
    void hear(std::optional<SearchedFloor> told, WallTime now);
  };
  /// What a robot has told last, in its own frame `map`.
  struct Told {
    std::optional<RobotTopology> topology;
    nav::SharedFloor floor;  ///< null: nothing yet
    Finds finds;
    DatedSearch search;
  };
  struct Member {
    api::FleetManifest manifest;
    Pieces pieces;  ///< complete ones of the manifest
    std::map<api::PieceHash, std::vector<std::uint8_t>> partial;
    std::uint8_t slot = 1;  ///< in the joint map
    std::optional<WallTime> seen;
    Told told;
    std::optional<WallTime> shared;  ///< when its topology was told
    std::optional<WallTime> judged;
    bool waits = false;         ///< to be judged by the worker
    bool record_waits = false;  ///< to be written by the worker
    bool begun_anew = false;    ///< in a map that has not been looked at yet: what is known of its pairs is of another
    std::string trouble;        ///< why its map cannot be judged; empty: it can
    bool split = false;
    std::optional<Pose2> accepted;  ///< main_T_map that the operator has accepted
    api::FleetState state = api::FleetState::kWaiting;
    std::string reason = "its map has not been looked at yet";
    double confidence = 0.0;
    std::vector<fleet::MergeHypothesis> hypotheses;  ///< with the main robot's map
    std::optional<Pose2> main_T_map;
  };
  /// What a loop tells when it comes to it; this may be gone by then.
  template <class T>
  class Inbox {
   public:
    [[nodiscard]] api::Reply<T> reply() const {
      return [kept = kept_](Result<T> told) {
        if (told) {
          const std::lock_guard lock(kept->mutex);
          kept->told = std::move(*told);
        }
      };
    }
    [[nodiscard]] std::optional<T> take() {
      const std::lock_guard lock(kept_->mutex);
      return std::exchange(kept_->told, std::nullopt);
    }

   private:
    struct Kept {
      std::mutex mutex;
      std::optional<T> told;
    };
    std::shared_ptr<Kept> kept_ = std::make_shared<Kept>();
  };
  /// Of two robots, by slot, the lower first: what the merger last said, and when.
  struct Compared {
    fleet::MergeAnswer answer;
    WallTime at;
    std::pair<std::uint64_t, std::uint64_t> versions;  ///< of their maps
    bool stale = false;  ///< it speaks of local maps that are no more: a memory of how the maps lay, and no more
  };
  /// What was found when all were looked at together.
  struct Round {
    std::vector<fleet::PairAnswer> pairs;
    std::map<std::uint8_t, fleet::FleetLink> links;
    std::map<std::uint8_t, std::string> names;
    std::string trouble;  ///< why the maps could not be joined
  };

  void refresh_seen();
  [[nodiscard]] Result<api::FleetStatus> take_decision(const api::FleetDecision& decision);

  // With the lock held.
  [[nodiscard]] Status check_namesake(const api::FleetManifest& manifest, WallTime now) const;
  void take(Member& member, const api::FleetManifest& manifest);
  [[nodiscard]] static std::vector<api::FleetMissing> missing_of(const Member& member);
  void ask_for_judgement(const std::string& robot_id, Member& member);
  [[nodiscard]] api::FleetStatus status_now() const;
  [[nodiscard]] api::FleetMember describe(const Member& member, WallTime now) const;
  // Of all other robots that are merged, in the frame `map` of the robot that asks, which lies at main_T_map.
  struct Other {
    const std::string& robot_id;
    const Told& told;
    Pose2 map_T_theirs;
    const Member* member;  ///< null: it is the main one
  };
  [[nodiscard]] std::vector<Other> others_than(const std::string& robot_id, const Pose2& main_T_map) const;
  [[nodiscard]] std::vector<RobotTopology> others_of(const std::string& robot_id, const Pose2& main_T_map,
                                                     WallTime now) const;
  [[nodiscard]] std::vector<std::pair<Pose2, nav::SharedFloor>> floors_of_others(const std::string& robot_id,
                                                                                 const Pose2& main_T_map) const;
  [[nodiscard]] std::vector<api::FleetFinding> findings_of_others(const std::string& robot_id,
                                                                  const Pose2& main_T_map) const;
  [[nodiscard]] std::vector<SearchedFloor> searched_by_others(const std::string& robot_id, const Pose2& main_T_map,
                                                              WallTime now) const;
  void begin_anew(Member& member, const api::FleetManifest& manifest);
  void ask_for_record(const std::string& robot_id, Member& member);
  void hear_seen(Member& member, const api::FleetSeen& seen, WallTime now);
  [[nodiscard]] bool take_own_seen(const OwnSeen& own);
  void recall_own(const api::FleetManifest& own, const v1::KeptFleet& kept);
  void forget_own();
  [[nodiscard]] bool silent(const std::optional<WallTime>& heard, WallTime now) const;
  void set_state(Member& member, api::FleetState state, std::string reason);
  void settle(Member& member, const Round& round);

  // What is on disk (fleet_keep.cpp, fleet_memory.cpp). The first three before anybody else asks.
  void load();
  void load_slots(const v1::KeptFleet& kept);
  void load_member(const std::filesystem::path& folder);
  using DetectionField = google::protobuf::RepeatedPtrField<v1::Detection>;
  /// Nothing where it is damaged, which is told.
  [[nodiscard]] std::vector<api::Detection> load_found(const DetectionField& kept, const std::string& robot_id);
  [[nodiscard]] Pieces load_pieces(const std::filesystem::path& folder, const api::FleetManifest& manifest) const;
  [[nodiscard]] std::uint8_t free_slot(const std::string& robot_id) const;
  void tell_damage(const std::string& what);
  void keep_piece(const std::string& robot_id, const api::PieceHash& hash, const PieceBytes& bytes) const;
  void drop_pieces(const std::string& robot_id, const Pieces& needed) const;
  void keep_record(const std::string& robot_id);

  // On the worker.
  void recall(const v1::KeptFleet& kept);
  [[nodiscard]] bool recall_maps(const v1::KeptFleet& kept);
  void recall_pairs(const v1::KeptFleet& kept);
  void keep_own_pieces();
  void keep_memory();
  void judge(const std::string& robot_id);
  [[nodiscard]] Result<OwnMap> ask_own_map();
  [[nodiscard]] Status take_own_map(Result<OwnMap> own);
  [[nodiscard]] Status compare(std::uint8_t slot, LineMap map);
  [[nodiscard]] Status prepare(std::uint8_t slot, LineMap map);
  void compare(std::uint8_t a, std::uint8_t b);
  void compare_with_others(std::uint8_t slot);
  [[nodiscard]] std::vector<fleet::PairAnswer> pairs_now();
  static void obey_operator(Member& member, fleet::MergeAnswer& answer);
  void join_all();
  [[nodiscard]] Result<fleet::JointMap> join(const Round& round);

  FleetLeaderParams params_;
  FleetHost host_;
  Inbox<OwnTopology> topology_inbox_;
  Inbox<OwnSeen> seen_inbox_;
  fleet::MapMerger merger_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::map<std::string, Member> members_;
  std::vector<Point2> own_places_;
  std::optional<Pose2> own_map_T_base_;
  Told own_told_;
  /// The main robot has not taken up its map again since it was started: what it was holds, not where its loop is now.
  bool remembers_own_ = false;
  std::map<std::string, std::uint8_t> kept_slots_;
  std::uint32_t revision_ = 0;
  std::mutex record_mutex_;  ///< held while a robot's record is written; taken before mutex_
  // For refresh() only.
  WallTime floor_at_;
  nav::SharedFloor others_floor_;  ///< what the main robot was told last
  SharedSearch others_searched_;   ///< so, too
  FleetNews news_;
  // For the worker only.
  std::map<std::uint8_t, fleet::PreparedMap> prepared_;  ///< by slot, the main robot's own at 0
  std::map<std::uint8_t, std::uint64_t> versions_;       ///< of those: rise when a map has changed
  std::map<std::pair<std::uint8_t, std::uint8_t>, Compared> pairs_;
  std::map<std::uint8_t, std::vector<api::FleetNode>> judged_;  ///< by slot: what was last looked at
  std::optional<fleet::JointMap> joint_;
  std::uint32_t joint_epoch_ = 0;
  PackedMap own_packed_;             ///< the main robot's own map as it is kept on disk
  std::uint64_t own_packed_of_ = 0;  ///< its version
  std::string memory_;               ///< what was written last
  DiskWorker worker_;
};

}  // namespace seeker::app
