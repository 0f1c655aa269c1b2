#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"
#include "common/core/rng.hpp"
#include "server/tour/route.hpp"

namespace seeker::tour {
namespace {

RouteCosts straight_lines(const Point2& start, const std::vector<Point2>& places) {
  RouteCosts costs;
  const auto count = static_cast<Eigen::Index>(places.size());
  costs.between = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const Point2& from = places[static_cast<std::size_t>(a)];
    costs.from_start.push_back((from - start).norm());
    for (Eigen::Index b = 0; b < count; ++b) {
      costs.between(a, b) = (places[static_cast<std::size_t>(b)] - from).norm();
    }
  }
  return costs;
}

std::vector<Point2> scattered(std::size_t count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Point2> places;
  for (std::size_t k = 0; k < count; ++k) {
    places.emplace_back(rng.uniform(0.0, 20.0), rng.uniform(0.0, 10.0));
  }
  return places;
}

double shortest_of_all(const RouteCosts& costs) {
  Route route(costs.places());
  std::iota(route.begin(), route.end(), std::size_t{0});
  double best = route_cost(costs, route);
  while (std::next_permutation(route.begin(), route.end())) {
    best = std::min(best, route_cost(costs, route));
  }
  return best;
}

TEST(Route, IsAsShortAsTheShortestOfFewPlaces) {
  constexpr double kNearlyBest = 1.03;  // 2-opt and or-opt end in a local optimum
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RouteCosts costs = straight_lines({0.0, 0.0}, scattered(7, seed));
    EXPECT_LE(route_cost(costs, short_route(costs)), kNearlyBest * shortest_of_all(costs)) << "seed " << seed;
    costs.to_end = costs.from_start;
    EXPECT_LE(route_cost(costs, short_route(costs)), kNearlyBest * shortest_of_all(costs)) << "seed " << seed;
  }
}

TEST(Route, AroundACircleIsTheCircle) {
  std::vector<Point2> places;
  constexpr int kPlaces = 24;
  for (const int k : {0, 13, 5, 20, 8, 1, 17, 11, 23, 3, 14, 9, 19, 2, 16, 6, 22, 10, 4, 18, 12, 7, 21, 15}) {
    const double angle_rad = kTwoPi * (k + 0.5) / kPlaces;
    places.emplace_back(5.0 * std::cos(angle_rad), 5.0 * std::sin(angle_rad));
  }
  RouteCosts costs = straight_lines({5.0, 0.0}, places);
  costs.to_end = costs.from_start;
  EXPECT_NEAR(route_cost(costs, short_route(costs)), kTwoPi * 5.0, 0.3);
}

TEST(Route, TheEndDecidesWhichSideIsFirst) {
  // Two places left and right of the start; with the end at the left one it is visited last.
  RouteCosts costs = straight_lines({0.0, 0.0}, {{-3.0, 0.0}, {4.0, 0.0}});
  EXPECT_EQ(short_route(costs), (Route{0, 1})) << "the nearer one first where the end is free";
  costs.to_end = {0.0, 7.0};
  EXPECT_EQ(short_route(costs), (Route{1, 0}));
}

TEST(Route, ABestRouteStaysAsItIs) {
  const RouteCosts costs = straight_lines({0.0, 0.0}, scattered(15, 4));
  const Route best = short_route(costs);
  EXPECT_EQ(improved_route(costs, best), best);
}

TEST(Route, ImprovementKeepsEveryPlaceAndLeavesNothingToImprove) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    RouteCosts costs = straight_lines({0.0, 0.0}, scattered(3 + seed, seed));
    if (seed % 2 == 0) {
      costs.to_end = costs.from_start;
    }
    Route begun(costs.places());
    std::iota(begun.begin(), begun.end(), std::size_t{0});
    const Route route = improved_route(costs, begun);
    EXPECT_LT(route_cost(costs, route), route_cost(costs, begun)) << "seed " << seed;
    EXPECT_EQ(improved_route(costs, route), route) << "seed " << seed;
    EXPECT_TRUE(std::is_permutation(route.begin(), route.end(), begun.begin(), begun.end())) << "seed " << seed;
  }
}

TEST(Route, ImprovingAFewOfThemIsNearlyAsShort) {
  constexpr double kNearly = 1.05;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RouteCosts costs = straight_lines({0.0, 0.0}, scattered(60, seed));
    EXPECT_LE(route_cost(costs, short_route(costs, 12)), kNearly * route_cost(costs, short_route(costs)))
        << "seed " << seed;
  }
}

TEST(Route, MissingPlacesComeWhereTheyCostLeast) {
  const RouteCosts costs = straight_lines({0.0, 0.0}, {{1.0, 0.0}, {2.0, 0.1}, {3.0, 0.0}});
  EXPECT_EQ(with_all_places(costs, {0, 2}), (Route{0, 1, 2}));
  EXPECT_EQ(with_all_places(costs, {}).size(), 3U);
}

TEST(Route, WhatCostsMoreThanItIsWorthIsLeftOut) {
  // On the way, three metres beside it, and at its end.
  const RouteCosts costs = straight_lines({0.0, 0.0}, {{5.0, 0.0}, {6.0, 3.0}, {10.0, 0.0}});
  EXPECT_EQ(profitable_route(costs, {0, 1, 2}, {2.0, 2.0, 20.0}), (Route{0, 2}));
  EXPECT_EQ(profitable_route(costs, {0, 1, 2}, {2.0, 4.0, 20.0}), (Route{0, 1, 2}));
  EXPECT_EQ(profitable_route(costs, {0, 1, 2}, {2.0, 2.0, 3.0}), Route{}) << "without its end the rest is not worth it";
}

TEST(Route, TowardsItsEndOnlyTheDetourCounts) {
  RouteCosts costs = straight_lines({0.0, 0.0}, {{1.0, 0.0}});
  costs.to_end = {9.0};
  costs.without_places_m = 10.0;
  EXPECT_EQ(profitable_route(costs, {0}, {0.5}), Route{0});
  EXPECT_DOUBLE_EQ(route_cost(costs, {}), 10.0);
}

TEST(Route, EveryPlaceThatIsKeptIsWorthItsDetour) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const RouteCosts costs = straight_lines({0.0, 0.0}, scattered(20, seed));
    Rng rng(seed);
    std::vector<double> worths_m;
    for (std::size_t k = 0; k < costs.places(); ++k) {
      worths_m.push_back(rng.uniform(0.0, 4.0));
    }
    const Route kept = profitable_route(costs, short_route(costs), worths_m);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      Route without = kept;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(k));
      EXPECT_LE(route_cost(costs, kept) - route_cost(costs, without), worths_m[kept[k]] + 1e-9) << "seed " << seed;
    }
  }
}

TEST(Route, OfNothingIsEmpty) {
  const RouteCosts none = straight_lines({0.0, 0.0}, {});
  EXPECT_TRUE(short_route(none).empty());
  EXPECT_DOUBLE_EQ(route_cost(none, {}), 0.0);
}

}  // namespace
}  // namespace seeker::tour
