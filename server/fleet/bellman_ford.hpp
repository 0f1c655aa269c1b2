/// \file
/// Shortest ways along a graph of places (spec S4.4, eq (1)).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::fleet {

/// Undirected; an edge is as long as it is straight.
struct PlaceGraph {
  struct Edge {
    std::size_t a = 0;
    std::size_t b = 0;
  };
  std::vector<Point2> places;
  std::vector<Edge> edges;  ///< indices into `places`
};

/// Ways from one place to all others.
struct ShortestWays {
  std::vector<double> distance_m;                     ///< infinity where no way leads
  std::vector<std::optional<std::size_t>> came_from;  ///< nothing for the source and what no way leads to
  int rounds = 0;                                     ///< k of eq (1) after which nothing changed any more

  [[nodiscard]] bool reaches(std::size_t place) const;
  /// From the source to the place, both included; empty where no way leads.
  [[nodiscard]] std::vector<std::size_t> way_to(std::size_t place) const;
};

/// Bellman-Ford with D^0(source) = 0; ends after |T|-1 rounds, or earlier when a round changes nothing.
[[nodiscard]] ShortestWays bellman_ford(const PlaceGraph& graph, std::size_t source);

}  // namespace seeker::fleet
