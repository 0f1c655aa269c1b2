#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/fleet/bellman_ford.hpp"

namespace seeker::fleet {
namespace {

TEST(BellmanFord, TakesTheShorterPathRound) {
  PlaceGraph graph;
  graph.places = {{0, 0}, {1, 0}, {1, 1}, {0, 5}};
  graph.edges = {{0, 1}, {1, 2}, {2, 3}, {0, 3}};
  const ShortestPaths paths = bellman_ford(graph, 0);
  EXPECT_DOUBLE_EQ(paths.distance_m[2], 2.0);
  EXPECT_EQ(paths.path_to(2), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(paths.path_to(3), (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(paths.path_to(0), (std::vector<std::size_t>{0}));
}

TEST(BellmanFord, SaysWhereNoPathLeads) {
  PlaceGraph graph;
  graph.places = {{0, 0}, {1, 0}, {2, 0}};
  graph.edges = {{0, 1}};
  const ShortestPaths paths = bellman_ford(graph, 1);
  EXPECT_FALSE(paths.reaches(2));
  EXPECT_TRUE(paths.path_to(2).empty());
  EXPECT_TRUE(paths.reaches(0));
}

TEST(BellmanFord, KnowsTheOnlyPlace) {
  PlaceGraph graph;
  graph.places = {{3, 4}};
  EXPECT_DOUBLE_EQ(bellman_ford(graph, 0).distance_m[0], 0.0);
}

/// Floyd and Warshall's all pairs: another algorithm for the same distances.
std::vector<std::vector<double>> all_pairs(const PlaceGraph& graph) {
  const std::size_t n = graph.places.size();
  std::vector<std::vector<double>> d(n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
  for (std::size_t k = 0; k < n; ++k) {
    d[k][k] = 0.0;
  }
  for (const auto& [a, b] : graph.edges) {
    const double length = (graph.places[a] - graph.places[b]).norm();
    d[a][b] = std::min(d[a][b], length);
    d[b][a] = std::min(d[b][a], length);
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        d[a][b] = std::min(d[a][b], d[a][k] + d[k][b]);
      }
    }
  }
  return d;
}

RC_GTEST_PROP(BellmanFord, FindsTheDistancesOfAllPairs, ()) {
  const auto n = *rc::gen::inRange<std::size_t>(1, 12);
  PlaceGraph graph;
  for (std::size_t k = 0; k < n; ++k) {
    graph.places.emplace_back(*rc::gen::inRange(0, 20), *rc::gen::inRange(0, 20));
  }
  const int edges = *rc::gen::inRange(0, 30);
  for (int k = 0; k < edges; ++k) {
    graph.edges.push_back({*rc::gen::inRange<std::size_t>(0, n), *rc::gen::inRange<std::size_t>(0, n)});
  }
  const auto source = *rc::gen::inRange<std::size_t>(0, n);
  const ShortestPaths paths = bellman_ford(graph, source);
  const auto oracle = all_pairs(graph);
  for (std::size_t k = 0; k < n; ++k) {
    RC_ASSERT(paths.reaches(k) == std::isfinite(oracle[source][k]));
    if (!paths.reaches(k)) {
      continue;
    }
    RC_ASSERT(std::abs(paths.distance_m[k] - oracle[source][k]) < 1e-9);
    const std::vector<std::size_t> path = paths.path_to(k);
    double length = 0.0;
    for (std::size_t step = 1; step < path.size(); ++step) {
      length += (graph.places[path[step]] - graph.places[path[step - 1]]).norm();
    }
    RC_ASSERT(std::abs(length - paths.distance_m[k]) < 1e-9);
  }
}

}  // namespace
}  // namespace seeker::fleet
