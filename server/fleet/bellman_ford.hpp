/// \file
/// Shortest paths along a graph of places (spec S4.4, eq (1)).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::fleet {

/// An undirected graph; the length of an edge is the straight distance.
struct PlaceGraph {
  struct Edge {
    std::size_t a = 0;
    std::size_t b = 0;
  };
  std::vector<Point2> places;
  std::vector<Edge> edges;  ///< indices into `places`
};

/// Shortest paths from one place to all others.
struct ShortestPaths {
  std::vector<double> distance_m;  ///< path length to each place; infinity without a path
  /// Previous place on the path; no value for the source and for places without a path.
  std::vector<std::optional<std::size_t>> came_from;
  int rounds = 0;  ///< k of eq (1) after which the distances did not change any more

  [[nodiscard]] bool reaches(std::size_t place) const;
  /// The path from the source to the place, both included; empty without a path.
  [[nodiscard]] std::vector<std::size_t> path_to(std::size_t place) const;
};

/// Bellman-Ford with D^0(source) = 0; ends after |T|-1 rounds, or earlier when a round changes nothing.
[[nodiscard]] ShortestPaths bellman_ford(const PlaceGraph& graph, std::size_t source);

}  // namespace seeker::fleet
