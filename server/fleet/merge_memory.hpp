/// \file
/// What was certain once stays so while nothing speaks against it.
#pragma once

#include "server/fleet/map_merger.hpp"

namespace seeker::fleet {

/// Two ways to lay a map are one when they are no farther apart.
struct SamePlaceParams {
  double max_m = 1.0;
  double max_rad = 0.2;
};
[[nodiscard]] bool same_place(const Pose2& a_T_b, const Pose2& a_T_b_too, const SamePlaceParams& params = {});

/// Whether an answer still speaks of local maps that are there.
[[nodiscard]] bool holds(const MergeAnswer& answer, const PreparedMap& a, const PreparedMap& b);

/// Two robots whose maps were merged before and still fit best in the same way stay merged although the figures are not
/// those of a first merge any more (things have been moved, a robot stood in the way): less than `sure_...` is enough
/// then. A rival, a contradiction or too little overlap ends it. Everybody else is judged as before.
void judge_again(MergeAnswer& answer, const MergeAnswer& before, const MergeParams& params);

}  // namespace seeker::fleet
