#include "server/explore/wall_graph.hpp"

#include <algorithm>
#include <limits>

namespace seeker::explore {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

}  // namespace

bool is_real(const MapSegment& segment, WallSide side) {
  return side == WallSide::kLeft ? segment.left_real : segment.right_real;
}

Point2 end_of(const MapSegment& segment, WallSide side) {
  return side == WallSide::kLeft ? segment.left() : segment.right();
}

std::optional<std::size_t> adjacent_segment(const std::vector<MapSegment>& segments, std::size_t from, WallSide side,
                                            double adjacency_m) {
  const Point2 end = end_of(segments[from], side);
  std::optional<std::size_t> nearest;
  double nearest_m = adjacency_m;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const double gap_m = (end_of(segments[k], opposite(side)) - end).norm();
    if (k != from && gap_m <= nearest_m) {
      nearest = k;
      nearest_m = gap_m;
    }
  }
  return nearest;
}

// Dijkstra over the ends ahead of all segments, dense: a walk is planned rarely, and n is some hundreds.
std::optional<WallRoute> route_to_open_end(const std::vector<MapSegment>& segments, std::size_t from, double along_m,
                                           WallSide side, double adjacency_m) {
  std::vector<double> cost_m(segments.size(), kInfinity);
  std::vector<std::size_t> parent(segments.size(), kNone);
  std::vector<bool> done(segments.size(), false);
  cost_m[from] = std::max(0.0, 0.5 * segments[from].length_m - sign_of(side) * along_m);
  for (;;) {
    std::size_t next = kNone;
    for (std::size_t k = 0; k < segments.size(); ++k) {
      if (!done[k] && cost_m[k] < kInfinity && (next == kNone || cost_m[k] < cost_m[next])) {
        next = k;
      }
    }
    if (next == kNone) {
      return std::nullopt;
    }
    done[next] = true;
    if (!is_real(segments[next], side)) {
      WallRoute route;
      route.cost_m = cost_m[next];
      for (std::size_t k = next; k != kNone; k = parent[k]) {
        route.segments.push_back(k);
      }
      std::reverse(route.segments.begin(), route.segments.end());
      return route;
    }
    const Point2 end = end_of(segments[next], side);
    for (std::size_t k = 0; k < segments.size(); ++k) {
      const double gap_m = (end_of(segments[k], opposite(side)) - end).norm();
      const double through_m = cost_m[next] + gap_m + segments[k].length_m;
      if (!done[k] && gap_m <= adjacency_m && through_m < cost_m[k]) {
        cost_m[k] = through_m;
        parent[k] = next;
      }
    }
  }
}

}  // namespace seeker::explore
