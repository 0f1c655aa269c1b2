/// \file
/// Why an exploration chose a goal: the candidates of one decision, each with the terms of its score.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker {

/// One candidate: a control held for one observation period, or a place to drive to. The terms are those of the
/// active-SLAM objective (spec S1.11, eqs (18)-(22)) before their weights; a rule that does not use a term leaves it 0.
struct DecisionCandidate {
  Pose2 map_T_base;     ///< pose of the robot after the control, or at the place
  Twist2 control;       ///< of rules that choose a control; zero for places
  double lg_j1 = 0.0;   ///< certainty of robot and map afterwards: lg of eq (18)
  double lg_j21 = 0.0;  ///< growth of the lengths of segments: lg of eq (20)
  double lg_j22 = 0.0;  ///< number of ends that become real: lg of eq (21)
  double path_m = 0.0;  ///< length of the path to the place
  double score = 0.0;   ///< by which the rule compares candidates; higher is better
  std::string refused;  ///< why the candidate cannot be chosen; empty: it can

  friend bool operator==(const DecisionCandidate&, const DecisionCandidate&) = default;
};

struct ExploreDecision {
  std::uint64_t number = 0;  ///< of the decision within its mission, from 1
  RobotTime stamp;
  std::string rule;  ///< "one-step", "wall", "horizon", "tour", "frontier", "gain", "roam", "topological"
  std::vector<DecisionCandidate> candidates;  ///< at most kMaxDecisionCandidates, the best where there were more
  std::optional<std::uint32_t> chosen;        ///< index into candidates; empty: none could be chosen
  std::string why;                            ///< reason of the choice in one sentence, for people

  friend bool operator==(const ExploreDecision&, const ExploreDecision&) = default;
};
inline constexpr std::size_t kMaxDecisionCandidates = 64;

}  // namespace seeker
