#include "server/fleet/bellman_ford.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/assert.hpp"

namespace seeker::fleet {
namespace {

bool relax(ShortestPaths& paths, std::size_t from, std::size_t to, double length_m) {
  const double by_here_m = paths.distance_m[from] + length_m;
  if (by_here_m >= paths.distance_m[to]) {
    return false;
  }
  paths.distance_m[to] = by_here_m;
  paths.came_from[to] = from;
  return true;
}

}  // namespace

bool ShortestPaths::reaches(std::size_t place) const { return std::isfinite(distance_m[place]); }

std::vector<std::size_t> ShortestPaths::path_to(std::size_t place) const {
  std::vector<std::size_t> path;
  if (!reaches(place)) {
    return path;
  }
  for (std::optional<std::size_t> at = place; at; at = came_from[*at]) {
    path.push_back(*at);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

ShortestPaths bellman_ford(const PlaceGraph& graph, std::size_t source) {
  SEEKER_ASSERT(source < graph.places.size());
  ShortestPaths paths;
  paths.distance_m.assign(graph.places.size(), std::numeric_limits<double>::infinity());
  paths.came_from.assign(graph.places.size(), std::nullopt);
  paths.distance_m[source] = 0.0;
  const int most = static_cast<int>(graph.places.size()) - 1;
  for (bool changed = true; changed && paths.rounds < most; paths.rounds += changed ? 1 : 0) {
    changed = false;
    for (const PlaceGraph::Edge& edge : graph.edges) {
      const double length_m = (graph.places[edge.a] - graph.places[edge.b]).norm();
      const bool there = relax(paths, edge.a, edge.b, length_m);
      const bool back = relax(paths, edge.b, edge.a, length_m);
      changed = changed || there || back;
    }
  }
  return paths;
}

}  // namespace seeker::fleet
