#include "server/fleet/merge_memory.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::fleet {
namespace {

bool has_node(const PreparedMap& map, std::uint32_t id) {
  return std::any_of(map.nodes().begin(), map.nodes().end(), [id](const PreparedNode& node) { return node.id == id; });
}

}  // namespace

bool same_place(const Pose2& a_T_b, const Pose2& a_T_b_too, const SamePlaceParams& params) {
  return distance_m(a_T_b, a_T_b_too) < params.max_m &&
         std::abs(wrap_angle(a_T_b.theta_rad - a_T_b_too.theta_rad)) < params.max_rad;
}

bool holds(const MergeAnswer& answer, const PreparedMap& a, const PreparedMap& b) {
  return std::all_of(answer.hypotheses.begin(), answer.hypotheses.end(), [&](const MergeHypothesis& one) {
    return std::all_of(one.pairs.begin(), one.pairs.end(),
                       [&](const NodeRelation& pair) { return has_node(a, pair.node_a) && has_node(b, pair.node_b); });
  });
}

void judge_again(MergeAnswer& answer, const MergeAnswer& before, const MergeParams& params) {
  const bool still = !answer.merged() && before.merged() && !answer.hypotheses.empty() &&
                     same_place(answer.hypotheses.front().a_T_b.a_T_b, before.hypotheses.front().a_T_b.a_T_b);
  if (!still) {
    return;
  }
  MergeParams enough = params;
  enough.min_pairs = 1;
  enough.sure_shared_wall_m = params.min_shared_wall_m;
  enough.sure_weak_wall_m = params.min_weak_wall_m;
  enough.sure_weak_share = 0.0;
  enough.sure_denied_piece_m = params.kept_denied_piece_m;
  enough.sure_contradiction = params.max_contradiction;
  judge(answer, enough);
}

}  // namespace seeker::fleet
