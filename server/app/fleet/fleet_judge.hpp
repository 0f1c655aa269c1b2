/// \file
/// How the main robot of a fleet decides which maps are joined.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/app/fleet/fleet_memory.hpp"
#include "server/app/fleet/map_pairs.hpp"
#include "server/app/fleet/member_book.hpp"
#include "server/app/fleet/own_map.hpp"
#include "server/app/fleet/own_robot.hpp"
#include "server/fleet/joint_map.hpp"

namespace seeker::app {

/// Compares the map of a robot with those of the others, joins all that are merged, and enters the outcome in the book.
/// It is for one thread, that of the worker, and has no lock: the book and the main robot lock themselves. It waits for
/// the loop of the main robot, which hands its map over, for as long as 20 s of wall time.
class FleetJudge {
 public:
  using GiveMap = std::function<void(const api::Reply<OwnMap>&)>;

  /// `book` and `main` must outlive this. `give_map` as in FleetHost.
  FleetJudge(const fleet::MergeParams& params, Duration retry_period, MemberBook& book, OwnRobot& main,
             GiveMap give_map);

  /// Takes up what was found before a restart, without asking the main robot, whose map is perhaps not there yet.
  void recall(RememberedFleet remembered);
  /// Judges the newest map of a robot. One that has announced more meanwhile is judged when that has arrived; until
  /// then what was found of it holds.
  void judge(const std::string& robot_id);

  /// Null: no map is merged with that of the main robot.
  [[nodiscard]] const fleet::JointMap* joint_map() const { return joint_ ? &*joint_ : nullptr; }
  /// For the memory on the disk; holds until the next call of this.
  [[nodiscard]] JudgedFleet judged() const;

 private:
  [[nodiscard]] Result<OwnMap> ask_own_map() const;
  [[nodiscard]] Status take_own_map(Result<OwnMap> own);
  [[nodiscard]] Status take(const MemberMap& member);
  [[nodiscard]] Status compare(const MemberMap& member);
  void compare_with_others(std::uint8_t slot);
  void join_all();
  [[nodiscard]] Result<fleet::JointMap> join(const JoinOutcome& outcome);

  MemberBook& book_;
  OwnRobot& main_;
  GiveMap give_map_;
  MapPairs pairs_;
  std::map<std::uint8_t, std::vector<api::FleetNode>> judged_nodes_;  ///< by slot: of the map that was judged last
  std::optional<fleet::JointMap> joint_;
  std::uint32_t joint_epoch_ = 0;
};

}  // namespace seeker::app
