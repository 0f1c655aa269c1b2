#include "server/fleet/bellman_ford.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/assert.hpp"

namespace seeker::fleet {
namespace {

bool relax(ShortestWays& ways, std::size_t from, std::size_t to, double length_m) {
  const double by_here_m = ways.distance_m[from] + length_m;
  if (by_here_m >= ways.distance_m[to]) {
    return false;
  }
  ways.distance_m[to] = by_here_m;
  ways.came_from[to] = from;
  return true;
}

}  // namespace

bool ShortestWays::reaches(std::size_t place) const { return std::isfinite(distance_m[place]); }

std::vector<std::size_t> ShortestWays::way_to(std::size_t place) const {
  std::vector<std::size_t> way;
  if (!reaches(place)) {
    return way;
  }
  for (std::optional<std::size_t> at = place; at; at = came_from[*at]) {
    way.push_back(*at);
  }
  std::reverse(way.begin(), way.end());
  return way;
}

ShortestWays bellman_ford(const PlaceGraph& graph, std::size_t source) {
  SEEKER_ASSERT(source < graph.places.size());
  ShortestWays ways;
  ways.distance_m.assign(graph.places.size(), std::numeric_limits<double>::infinity());
  ways.came_from.assign(graph.places.size(), std::nullopt);
  ways.distance_m[source] = 0.0;
  const int most = static_cast<int>(graph.places.size()) - 1;
  for (bool changed = true; changed && ways.rounds < most; ways.rounds += changed ? 1 : 0) {
    changed = false;
    for (const PlaceGraph::Edge& edge : graph.edges) {
      const double length_m = (graph.places[edge.a] - graph.places[edge.b]).norm();
      const bool there = relax(ways, edge.a, edge.b, length_m);
      const bool back = relax(ways, edge.b, edge.a, length_m);
      changed = changed || there || back;
    }
  }
  return ways;
}

}  // namespace seeker::fleet
