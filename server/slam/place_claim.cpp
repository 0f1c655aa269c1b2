#include "server/slam/place_claim.hpp"

namespace seeker::slam {

bool PlaceClaim::take(const PlaceAnswer& answer, const Pose2& node_T_base) {
  if (answer.verdict == PlaceVerdict::kNone || answer.candidates.empty()) {
    clear();
    return false;
  }
  const Pose2 map_T_node = answer.candidates.front().match.map_T_base * inverse(node_T_base);
  const bool agrees = claim_ && !moved(claim_->map_T_node, map_T_node, params_.agree_m, params_.agree_rad);
  if (answer.weight <= 0.0) {
    if (!answer.says_nothing && !agrees) {
      clear();
    }
    return false;
  }
  double weight = answer.weight;
  if (claim_ && agrees) {
    const bool new_view = moved(claim_->node_T_view, node_T_base, params_.moved_m, params_.moved_rad);
    if (answer.verdict != PlaceVerdict::kUnique && !new_view) {
      return false;
    }
    weight += claim_->weight;
  }
  claim_ = Claim{map_T_node, node_T_base, weight};
  return answer.expected || weight >= params_.witnesses;
}

void PlaceClaim::change_node(const Pose2& old_T_new) {
  if (claim_) {
    claim_->map_T_node = claim_->map_T_node * old_T_new;
    claim_->node_T_view = inverse(old_T_new) * claim_->node_T_view;
  }
}

}  // namespace seeker::slam
