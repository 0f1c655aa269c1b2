#include "server/slam/place_claim.hpp"

namespace seeker::slam {

bool PlaceClaim::is_new_view(const Pose2& node_T_base) const {
  return !node_T_view_ || moved(*node_T_view_, node_T_base, params_.moved_m, params_.moved_rad);
}

bool PlaceClaim::names_claim(const Pose2& map_T_node) const {
  return map_T_node_ && !moved(*map_T_node_, map_T_node, params_.agree_m, params_.agree_rad);
}

bool PlaceClaim::take(const PlaceAnswer& answer, const Pose2& node_T_base) {
  if (answer.verdict == PlaceVerdict::kNone || answer.candidates.empty()) {
    clear();
    return false;
  }
  const Pose2 map_T_node = answer.candidates.front().match.map_T_base * inverse(node_T_base);
  const bool agrees = names_claim(map_T_node);
  if (answer.weight <= 0.0) {
    if (!answer.says_nothing && !agrees) {
      clear();
    }
    return false;
  }
  if (agrees && answer.verdict != PlaceVerdict::kUnique && !is_new_view(node_T_base)) {
    return false;
  }
  witnesses_ = agrees ? witnesses_ + answer.weight : answer.weight;
  map_T_node_ = map_T_node;
  node_T_view_ = node_T_base;
  return answer.expected || witnesses_ >= params_.witnesses;
}

void PlaceClaim::change_node(const Pose2& old_T_new) {
  if (map_T_node_) {
    map_T_node_ = *map_T_node_ * old_T_new;
    node_T_view_ = inverse(old_T_new) * *node_T_view_;
  }
}

void PlaceClaim::clear() {
  map_T_node_.reset();
  node_T_view_.reset();
  witnesses_ = 0.0;
}

}  // namespace seeker::slam
