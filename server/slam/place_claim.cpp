#include "server/slam/place_claim.hpp"

namespace seeker::slam {

bool PlaceClaim::take(const PlaceAnswer& answer, const Pose2& node_T_base) {
  if (answer.verdict != PlaceVerdict::kUnique) {
    if (!answer.says_nothing) {
      clear();
    }
    return false;
  }
  const Pose2 map_T_node = answer.candidates.front().match.map_T_base * inverse(node_T_base);
  const bool agrees = map_T_node_ && !moved(*map_T_node_, map_T_node, params_.agree_m, params_.agree_rad);
  witnesses_ = agrees ? witnesses_ + 1 : 1;
  map_T_node_ = map_T_node;
  return answer.expected || witnesses_ >= params_.witnesses;
}

void PlaceClaim::change_node(const Pose2& old_T_new) {
  if (map_T_node_) {
    map_T_node_ = *map_T_node_ * old_T_new;
  }
}

void PlaceClaim::clear() {
  map_T_node_.reset();
  witnesses_ = 0;
}

}  // namespace seeker::slam
