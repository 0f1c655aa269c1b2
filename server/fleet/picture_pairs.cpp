#include "server/fleet/picture_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/core/angle.hpp"

namespace seeker::fleet {

std::vector<PlacedPicture> placed_pictures(const PreparedMap& map) {
  const std::map<std::uint32_t, std::size_t> nodes = node_indices(map);
  std::vector<PlacedPicture> placed;
  placed.reserve(map.pictures().size());
  for (const auto& picture : map.pictures()) {
    const auto node = nodes.find(picture->node);
    if (node != nodes.end()) {
      const Pose2 map_T_base = map.nodes()[node->second].map_T_node * picture->node_T_base;
      placed.push_back({keyed(*picture), node->second, map_T_base});
    }
  }
  return placed;
}

std::size_t region_of(const PreparedMap& map, const PlacedPicture& picture) {
  return map.region_at(picture.map_T_base.translation()).value_or(map.nodes()[picture.node].region);
}

Pose2 PicturePair::map_a_T_base_b() const {
  return {a.map_T_base.x_m, a.map_T_base.y_m, wrap_angle(a.map_T_base.theta_rad + match.rotation_rad)};
}

PicturePairs::PicturePairs(PreparedMap& a, PreparedMap& b, const PictureParams& params)
    : params_(params), pictures_a_(placed_pictures(a)), pictures_b_(placed_pictures(b)) {
  for (const PlacedPicture& of_b : pictures_b_) {
    const auto first = static_cast<std::ptrdiff_t>(pairs_.size());
    for (const PlacedPicture& of_a : pictures_a_) {
      if (const auto match = a.picture_comparisons().match(of_a, of_b, params.views)) {
        pairs_.push_back({of_a, of_b, *match});
      }
    }
    std::stable_sort(pairs_.begin() + first, pairs_.end(),
                     [](const PicturePair& p, const PicturePair& q) { return p.match.agreeing > q.match.agreeing; });
  }
}

std::vector<PicturePair> PicturePairs::proposals() const {
  std::vector<PicturePair> proposals;
  const NodePicture* of_b = nullptr;
  std::size_t tries = 0;
  for (const PicturePair& pair : pairs_) {
    tries = pair.b.picture == of_b ? tries + 1 : 1;
    of_b = pair.b.picture;
    if (tries <= params_.tries) {
      proposals.push_back(pair);
    }
  }
  return proposals;
}

bool PicturePairs::agrees(const PicturePair& pair, const std::function<Pose2(std::size_t)>& map_a_T_node) const {
  const Pose2 expected = map_a_T_node(pair.b.node) * pair.b.picture->node_T_base;
  const Pose2 said = pair.map_a_T_base_b();
  return distance_m(expected, said) <= params_.alike_m &&
         std::abs(wrap_angle(expected.theta_rad - said.theta_rad)) <= params_.alike_rad;
}

bool PicturePairs::comparable(const PlacedPicture& of_a, const PlacedPicture& of_b, const Pose2& expected) const {
  const vision::ViewFeatures& a = of_a.picture->features;
  const vision::ViewFeatures& b = of_b.picture->features;
  if (distance_m(expected, of_a.map_T_base) > params_.near_m || std::min(a.size(), b.size()) < params_.min_features) {
    return false;
  }
  const double a_T_b_rad = expected.theta_rad - of_a.map_T_base.theta_rad;
  const auto shown_in = [&](const vision::ViewFeatures& other, double bearing_rad) {
    return std::any_of(other.bearings_rad.begin(), other.bearings_rad.end(), [&](float one) {
      return std::abs(wrap_angle(static_cast<double>(one) - bearing_rad)) <= params_.alike_rad;
    });
  };
  const auto shown = std::count_if(b.bearings_rad.begin(), b.bearings_rad.end(), [&](float bearing_rad) {
    return shown_in(a, static_cast<double>(bearing_rad) + a_T_b_rad);
  });
  return static_cast<double>(shown) >= params_.min_directions * static_cast<double>(b.size());
}

PictureEvidence PicturePairs::evidence(const std::function<Pose2(std::size_t)>& map_a_T_node) const {
  std::set<const NodePicture*> alike_a;
  std::set<const NodePicture*> alike_b;
  for (const PicturePair& pair : pairs_) {
    if (agrees(pair, map_a_T_node)) {
      alike_a.insert(pair.a.picture);
      alike_b.insert(pair.b.picture);
    }
  }
  std::set<const NodePicture*> unlike_a;
  std::set<const NodePicture*> unlike_b;
  for (const PlacedPicture& of_b : pictures_b_) {
    const Pose2 expected = map_a_T_node(of_b.node) * of_b.picture->node_T_base;
    for (const PlacedPicture& of_a : pictures_a_) {
      if (!alike_a.contains(of_a.picture) && !alike_b.contains(of_b.picture) && comparable(of_a, of_b, expected)) {
        unlike_a.insert(of_a.picture);
        unlike_b.insert(of_b.picture);
      }
    }
  }
  return {std::min(alike_a.size(), alike_b.size()), std::min(unlike_a.size(), unlike_b.size())};
}

}  // namespace seeker::fleet
