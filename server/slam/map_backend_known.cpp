// Ground that the map shows already: what a robot that stays in its building no longer adds to it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "common/core/angle.hpp"
#include "server/slam/covariance.hpp"
#include "server/slam/known_share.hpp"
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
    bypass(id);
  }
}

void MapBackend::bypass(std::uint32_t id) {
  const auto rank = [this](std::size_t k) {
    const PoseEdge& edge = graph_.edge(k);
    const double certainty = graph_.edge_weight(k) * edge.information.determinant();
    return std::pair(edge.kernel != EdgeKernel::kNone && graph_.edge_weight(k) > 0.5, certainty);
  };
  std::optional<std::size_t> back;
  std::optional<std::size_t> onward;
  for (std::size_t k = 0; k < graph_.edge_count(); ++k) {
    if (graph_.enabled(k) && graph_.edge(k).j == id && (!back || rank(k) > rank(*back))) {
      back = k;
    } else if (graph_.enabled(k) && graph_.edge(k).i == id && graph_.edge(k).j == id + 1) {
      onward = k;
    }
  }
  if (!back || !onward) {
    return;  // the first local map of a part that was joined by its second: it hangs on that one, and will
  }
  const PoseEdge older_id = graph_.edge(*back);
  const PoseEdge id_next = graph_.edge(*onward);
  for (std::size_t k = 0; k < graph_.edge_count(); ++k) {
    const PoseEdge& edge = graph_.edge(k);
    const bool at_id = edge.i == id || edge.j == id;
    if (at_id && k != *back && (k == *onward || !hangs_on_one(edge.i == id ? edge.j : edge.i))) {
      graph_.remove_edge(k);
    }
  }
  const UncertainPose older_T_next =
      compose({older_id.i_T_j, older_id.information.inverse()}, {id_next.i_T_j, id_next.information.inverse()});
  const Result<std::size_t> edge = graph_.add_edge({.i = older_id.i,
                                                    .j = id + 1,
                                                    .i_T_j = inverse(graph_.pose(older_id.i)) * pose(id + 1),
                                                    .information = information_of(older_T_next.covariance)});
  SEEKER_ASSERT(edge.has_value());
  std::erase_if(pending_, [id](const Surprise& surprise) { return surprise.loop.b == id; });
  graph_.drop_nodes(0, 0);  // numbers the edges without the removed ones
  loop_of_pair_.clear();    // the newest local map, which gets loops, has none yet
}

bool MapBackend::hangs_on_one(std::size_t node) const {
  std::size_t enabled = 0;
  for (std::size_t k = 0; k < graph_.edge_count(); ++k) {
    enabled += graph_.enabled(k) && (graph_.edge(k).i == node || graph_.edge(k).j == node) ? 1 : 0;
  }
  return enabled <= 1;
}

std::optional<std::uint32_t> MapBackend::shown_by(std::uint32_t id, const MapKeyframe& keyframe) {
  const Pose2 map_T_base = pose(id) * keyframe.node_T_base;
  const std::vector<NearMap> near = nearest_older(id, map_T_base);
  const auto from_there = std::find_if(near.begin(), near.end(), [](const NearMap& map) { return map.looked_so; });
  if (from_there != near.end()) {
    return from_there->id;
  }
  std::vector<PlacedMap> maps;
  for (std::size_t k = 0; k < std::min(near.size(), known_ground_.compared_maps); ++k) {
    if (std::shared_ptr<const PlaceMap> place = place_of(near[k].id)) {
      maps.push_back({inverse(pose(near[k].id)), std::move(place)});
    }
  }
  const double range_m = params_.view_range_m;
  const ScanView view_base{view_of(keyframe, range_m), passed_floor(unpack_scan(keyframe), range_m)};
  const bool known = known_share(transform(map_T_base, view_base), maps) >= known_ground_.known_share;
  return known ? std::optional(near.front().id) : std::nullopt;
}

std::vector<MapBackend::NearMap> MapBackend::nearest_older(std::uint32_t id, const Pose2& map_T_base) const {
  std::vector<NearMap> near;
  for (std::uint32_t older = 0; older < id; ++older) {
    const Pose2 older_T_base = inverse(pose(older)) * map_T_base;
    NearMap map{older, std::numeric_limits<double>::infinity(), false};
    for (const MapKeyframe& other : maps_[older].keyframes) {
      const double away_m = distance_m(other.node_T_base, older_T_base);
      const double away_rad = std::abs(wrap_angle(other.node_T_base.theta_rad - older_T_base.theta_rad));
      map.away_m = std::min(map.away_m, away_m);
      map.looked_so = map.looked_so || (away_m <= known_ground_.within_m && away_rad <= known_ground_.within_rad);
    }
    if (std::isfinite(map.away_m)) {
      near.push_back(map);
    }
  }
  std::stable_sort(near.begin(), near.end(), [](const NearMap& a, const NearMap& b) { return a.away_m < b.away_m; });
  return near;
}

bool MapBackend::agrees(std::uint32_t older, std::uint32_t id, const std::vector<SeenPoints>& seen_node) {
  const std::shared_ptr<const PlaceMap> place = place_of(older);
  return place && agreement_of(place->pyramid(), place->free_space(), seen_node, inverse(pose(older)) * pose(id),
                               params_.detector.agreement)
                          .disagreement() < known_ground_.disagreement;
}

}  // namespace seeker::slam
