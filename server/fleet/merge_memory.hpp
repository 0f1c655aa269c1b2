/// \file
/// Hysteresis of merges: a certain merge is kept until evidence contradicts it.
#pragma once

#include "server/fleet/map_merger.hpp"

namespace seeker::fleet {

/// Limits of the difference between two relative poses that count as one.
struct SamePlaceParams {
  double max_m = 1.0;
  double max_rad = 0.2;
};
[[nodiscard]] bool same_place(const Pose2& a_T_b, const Pose2& a_T_b_too, const SamePlaceParams& params = {});

/// Whether an answer refers to local maps that still exist.
[[nodiscard]] bool holds(const MergeAnswer& answer, const PreparedMap& a, const PreparedMap& b);

/// Two robots whose maps were merged before and still fit best at the same relative pose stay merged although the
/// evidence does not suffice for a first merge any more (objects were moved, a robot stood in between): the limits
/// without `sure_...` apply then. A rival, a contradiction or too little overlap ends the merge. All others are judged
/// as before.
void judge_again(MergeAnswer& answer, const MergeAnswer& before, const MergeParams& params);

}  // namespace seeker::fleet
