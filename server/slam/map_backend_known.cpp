// Ground that the map shows already: what a robot that stays in its building no longer adds to it.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "common/core/angle.hpp"
#include "server/slam/map_backend.hpp"

namespace seeker::slam {

std::size_t MapBackend::keyframe_count() const {
  return std::accumulate(maps_.begin(), maps_.end(), std::size_t{0},
                         [](std::size_t sum, const LocalMap& map) { return sum + map.keyframes.size(); });
}

void MapBackend::forget_known(std::uint32_t id) {
  if (is_apart(id) || keyframe_count() <= known_ground_.max_keyframes) {
    return;
  }
  LocalMap& map = maps_[id];
  std::map<std::uint32_t, std::vector<SeenPoints>> seen_by_older;
  for (const MapKeyframe& keyframe : map.keyframes) {
    const std::optional<std::uint32_t> older = shown_by(id, keyframe);
    if (!older) {
      return;
    }
    seen_by_older[*older].push_back(transform(keyframe.node_T_base, view_of(keyframe, params_.view_range_m)));
  }
  const bool unchanged = std::all_of(seen_by_older.begin(), seen_by_older.end(),
                                     [&](const auto& entry) { return agrees(entry.first, id, entry.second); });
  if (unchanged) {
    map.keyframes = {};
    map.segments_node = {};
    std::erase_if(places_, [id](const auto& place) { return place.first == id; });
    std::erase(planned_, id);
    thin_out_loops(id);
  }
}

void MapBackend::thin_out_loops(std::uint32_t id) {
  std::vector<std::size_t> loops;
  for (std::size_t k = 0; k < graph_.edge_count(); ++k) {
    const PoseEdge& edge = graph_.edge(k);
    if (std::max(edge.i, edge.j) == id && edge.kernel != EdgeKernel::kNone && graph_.enabled(k)) {
      loops.push_back(k);
    }
  }
  std::sort(loops.begin(), loops.end(), [this](std::size_t a, std::size_t b) {
    const auto certainty = [this](std::size_t k) {
      return graph_.edge_weight(k) * graph_.edge(k).information.determinant();
    };
    return certainty(a) > certainty(b);
  });
  for (std::size_t k = std::max<std::size_t>(known_ground_.loops, 1); k < loops.size(); ++k) {
    graph_.remove_edge(loops[k]);
  }
  graph_.drop_nodes(0, 0);  // numbers the edges without the removed ones
  loop_of_pair_.clear();    // the newest local map, which gets loops, has none yet
}

std::optional<std::uint32_t> MapBackend::shown_by(std::uint32_t id, const MapKeyframe& keyframe) const {
  const Pose2 map_T_base = pose(id) * keyframe.node_T_base;
  std::optional<std::uint32_t> nearest;
  double nearest_m = known_ground_.within_m;
  for (std::uint32_t older = 0; older < id; ++older) {
    const Pose2 older_T_base = inverse(pose(older)) * map_T_base;
    for (const MapKeyframe& other : maps_[older].keyframes) {
      const double away_m = distance_m(other.node_T_base, older_T_base);
      const double away_rad = std::abs(wrap_angle(other.node_T_base.theta_rad - older_T_base.theta_rad));
      if (away_m <= nearest_m && away_rad <= known_ground_.within_rad) {
        nearest = older;
        nearest_m = away_m;
      }
    }
  }
  return nearest;
}

bool MapBackend::agrees(std::uint32_t older, std::uint32_t id, const std::vector<SeenPoints>& seen_node) {
  const std::shared_ptr<const PlaceMap> place = place_of(older);
  return place && agreement_of(place->pyramid(), place->free_space(), seen_node, inverse(pose(older)) * pose(id),
                               params_.detector.agreement)
                          .disagreement() < known_ground_.disagreement;
}

}  // namespace seeker::slam
