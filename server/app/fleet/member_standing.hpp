/// \file
/// How the map of one robot stands to that of the main robot.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/api/fleet.hpp"
#include "server/app/fleet/join_outcome.hpp"

namespace seeker::app {

inline constexpr const char* kSplitReason = "taken out by the operator; 'seeker fleet merge' takes it in again";

/// State and reason of one robot, the hypotheses for its map join, and the operator's decisions on it. It has no lock:
/// MemberBook guards it with its mutex.
class MemberStanding {
 public:
  MemberStanding() = default;
  /// As the operator has decided before the main robot was restarted.
  MemberStanding(bool split, const std::optional<Pose2>& accepted);

  /// The robot has begun a new map: what was found of the old one does not hold for it.
  void begin_new_map();
  /// The judge looks at the newest map from now on.
  void begin_judgement() { unseen_map_ = false; }
  /// Why the map cannot be judged; empty: it can.
  void set_trouble(std::string trouble) { trouble_ = std::move(trouble); }
  /// The operator's decision. kRefused: there is no such hypothesis.
  [[nodiscard]] Status decide(const api::FleetDecision& decision);
  /// Applies the hypothesis that the operator has accepted to what was found for the pair of the main robot and this
  /// one. The acceptance lapses where the maps do not fit with that transform any more.
  void apply_acceptance(fleet::MergeAnswer& answer);
  /// State, reason and pose of the map from the newest map join; `names` are the robots' ids by slot. The answer is
  /// whether the state has changed.
  [[nodiscard]] bool settle(std::uint8_t slot, const JoinOutcome& outcome,
                            const std::map<std::uint8_t, std::string>& names);

  /// Its map is compared with those of others.
  [[nodiscard]] bool comparable() const { return !split_ && trouble_.empty(); }
  /// What was found of its pairs is of the map that it has now, and counts in a map join.
  [[nodiscard]] bool takes_part() const { return comparable() && !unseen_map_; }
  [[nodiscard]] api::FleetState state() const { return state_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] bool split() const { return split_; }
  /// main_T_map that the operator has accepted.
  [[nodiscard]] const std::optional<Pose2>& accepted() const { return accepted_; }
  /// The pose of its map in that of the main robot; absent where it is not merged.
  [[nodiscard]] std::optional<Pose2> main_T_map() const;
  /// Writes state, reason, hypotheses and pose.
  void describe(api::FleetMember& out) const;

 private:
  bool set_state(api::FleetState state, std::string reason);
  bool set_merged(std::uint8_t through, const std::vector<fleet::PairAnswer>& pairs, std::uint8_t slot,
                  const std::map<std::uint8_t, std::string>& names);

  api::FleetState state_ = api::FleetState::kWaiting;
  std::string reason_ = "its map has not been looked at yet";
  double confidence_ = 0.0;
  std::vector<fleet::MergeHypothesis> hypotheses_;  ///< for the map join with the main robot
  std::optional<api::FleetMergedWith> merged_with_;
  std::optional<Pose2> main_T_map_;  ///< of the last map join that it took part in
  std::optional<Pose2> accepted_;
  std::string trouble_;
  bool split_ = false;
  bool unseen_map_ = false;  ///< the judge has not looked at its new map yet
};

}  // namespace seeker::app
