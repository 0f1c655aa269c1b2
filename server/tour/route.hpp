/// \file
/// Orders of visits: short routes from a start over all of some places, with a given end or without.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace seeker::tour {

/// What the legs of a route cost, in metres of path. Legs between places cost the same in both directions; what differs
/// by direction, such as turning at the start, belongs into the first leg.
struct RouteCosts {
  std::vector<double> from_start;  ///< first leg, by place
  Eigen::MatrixXd between;         ///< leg from place to place: square, symmetric
  std::vector<double> to_end;      ///< last leg, by place; empty: the route ends at its last place

  double without_places_m = 0.0;  ///< from the start to the end where there is no place in between

  [[nodiscard]] std::size_t places() const { return from_start.size(); }
};

/// Places in the order of their visits.
using Route = std::vector<std::size_t>;

/// Sum of the legs.
[[nodiscard]] double route_cost(const RouteCosts& costs, const Route& route);

/// The route with every missing place added where that is cheapest, in order of their numbers.
[[nodiscard]] Route with_all_places(const RouteCosts& costs, Route route);

/// The route that 2-opt and or-opt (stretches of up to three places, in either direction) lead to from `route`: no
/// single one of these changes makes it shorter. A route that is best already stays as it is.
[[nodiscard]] Route improved_route(const RouteCosts& costs, const Route& route);

/// The route without the places whose detour costs more than they are worth, left out one by one, the worst first;
/// `worths_m` by place.
[[nodiscard]] Route profitable_route(const RouteCosts& costs, Route route, const std::vector<double>& worths_m);

/// A short route from nothing: nearest neighbours from every first place, of which the shortest `most_improved` are
/// improved. It depends on its inputs alone.
[[nodiscard]] Route short_route(const RouteCosts& costs,
                                std::size_t most_improved = std::numeric_limits<std::size_t>::max());

}  // namespace seeker::tour
