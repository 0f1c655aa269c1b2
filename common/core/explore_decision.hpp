/// \file
/// Why a robot went where it went: the alternatives of one decision with what spoke for each of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker {

/// One alternative: a control held for one observation period, or a place to drive to. The terms are those of the
/// active-SLAM objective (spec S1.11, eqs (18)-(22)) before their weights; a rule that does not use a term leaves it 0.
struct DecisionCandidate {
  Pose2 map_T_base;     ///< where it would take the robot
  Twist2 control;       ///< of one-step rules; zero for places
  double lg_j1 = 0.0;   ///< how certain robot and map would be: lg of eq (18)
  double lg_j21 = 0.0;  ///< how much longer segments would grow: lg of eq (20)
  double lg_j22 = 0.0;  ///< how many of their ends would become real: lg of eq (21)
  double path_m = 0.0;  ///< way to get there
  double score = 0.0;   ///< what the rule compares; higher is better
  std::string refused;  ///< why it is not available; empty: it is

  friend bool operator==(const DecisionCandidate&, const DecisionCandidate&) = default;
};

struct ExploreDecision {
  std::uint64_t number = 0;  ///< counts the decisions of a mission from 1
  RobotTime stamp;
  std::string rule;  ///< "one-step", "wall", "horizon", "frontier", "gain", "roam", "topological"
  std::vector<DecisionCandidate> candidates;  ///< at most kMaxDecisionCandidates, the best where there were more
  std::optional<std::uint32_t> chosen;        ///< index into candidates; nothing: none was available
  std::string why;                            ///< one sentence for people

  friend bool operator==(const ExploreDecision&, const ExploreDecision&) = default;
};
inline constexpr std::size_t kMaxDecisionCandidates = 64;

}  // namespace seeker
