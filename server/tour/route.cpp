#include "server/tour/route.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "common/core/assert.hpp"

namespace seeker::tour {
namespace {

/// Smaller gains are rounding errors, after which an improvement might not end.
constexpr double kLeastGain_m = 1e-6;
constexpr std::size_t kLongestStretch = 3;

/// A route under improvement, between a start and an end that are nodes as the places are, so that every place has two
/// neighbours.
class Improver {
 public:
  Improver(const RouteCosts& costs, const Route& route)
      : nodes_(costs.places() + 2), start_(costs.places()), legs_m_(nodes_ * nodes_, 0.0) {
    const std::size_t end = start_ + 1;
    for (std::size_t a = 0; a < costs.places(); ++a) {
      for (std::size_t b = 0; b < costs.places(); ++b) {
        legs_m_[a * nodes_ + b] = costs.between(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      }
      legs_m_[start_ * nodes_ + a] = costs.from_start[a];
      legs_m_[a * nodes_ + end] = costs.to_end.empty() ? 0.0 : costs.to_end[a];
    }
    stops_.push_back(start_);
    stops_.insert(stops_.end(), route.begin(), route.end());
    stops_.push_back(end);
  }

  [[nodiscard]] Route run() {
    for (bool better = true; better;) {
      better = reverse_stretches();
      better = move_stretches() || better;
    }
    return {stops_.begin() + 1, stops_.end() - 1};
  }

 private:
  [[nodiscard]] double leg_m(std::size_t from, std::size_t to) const { return legs_m_[from * nodes_ + to]; }
  [[nodiscard]] std::size_t last() const { return stops_.size() - 2; }  ///< position of the last place

  /// 2-opt: every reversal of a stretch that gains.
  bool reverse_stretches() {
    bool better = false;
    for (std::size_t i = 1; i <= last(); ++i) {
      for (std::size_t j = i + 1; j <= last(); ++j) {
        const double now = leg_m(stops_[i - 1], stops_[i]) + leg_m(stops_[j], stops_[j + 1]);
        const double then = leg_m(stops_[i - 1], stops_[j]) + leg_m(stops_[i], stops_[j + 1]);
        if (then < now - kLeastGain_m) {
          std::reverse(at(i), at(j + 1));
          better = true;
        }
      }
    }
    return better;
  }

  /// Or-opt: every move of a short stretch that gains.
  bool move_stretches() {
    bool better = false;
    for (std::size_t length = 1; length <= kLongestStretch && length < last(); ++length) {
      for (std::size_t i = 1; i + length - 1 <= last(); ++i) {
        better = move_stretch(i, length) || better;
      }
    }
    return better;
  }

  /// Moves the stretch to the first gap where that gains.
  bool move_stretch(std::size_t i, std::size_t length) {
    const std::size_t first = stops_[i];
    const std::size_t final = stops_[i + length - 1];
    const std::size_t before = stops_[i - 1];
    const std::size_t after = stops_[i + length];
    const double freed = leg_m(before, first) + leg_m(final, after) - leg_m(before, after) - kLeastGain_m;
    for (std::size_t gap = 1; gap <= last() + 1; ++gap) {  // before the stop there
      if (gap >= i && gap <= i + length) {
        continue;
      }
      const std::size_t a = stops_[gap - 1];
      const std::size_t b = stops_[gap];
      const double forward = leg_m(a, first) + leg_m(final, b) - leg_m(a, b);
      const double backward = leg_m(a, final) + leg_m(first, b) - leg_m(a, b);
      if (std::min(forward, backward) < freed) {
        if (backward < forward) {
          std::reverse(at(i), at(i + length));
        }
        if (gap < i) {
          std::rotate(at(gap), at(i), at(i + length));
        } else {
          std::rotate(at(i), at(i + length), at(gap));
        }
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] Route::iterator at(std::size_t position) {
    return stops_.begin() + static_cast<std::ptrdiff_t>(position);
  }

  std::size_t nodes_;
  std::size_t start_;           ///< the node before the first place; the next one is the end
  std::vector<double> legs_m_;  ///< from node to node, by rows
  Route stops_;                 ///< start, places, end
};

/// From a first place always to the nearest that is left.
Route nearest_neighbours(const RouteCosts& costs, std::size_t first) {
  Route route{first};
  std::vector<bool> visited(costs.places(), false);
  visited[first] = true;
  while (route.size() < costs.places()) {
    std::size_t best = costs.places();
    for (std::size_t k = 0; k < costs.places(); ++k) {
      const auto leg = [&](std::size_t to) {
        return costs.between(static_cast<Eigen::Index>(route.back()), static_cast<Eigen::Index>(to));
      };
      if (!visited[k] && (best == costs.places() || leg(k) < leg(best))) {
        best = k;
      }
    }
    visited[best] = true;
    route.push_back(best);
  }
  return route;
}

}  // namespace

double route_cost(const RouteCosts& costs, const Route& route) {
  if (route.empty()) {
    return costs.without_places_m;
  }
  double sum = costs.from_start[route.front()] + (costs.to_end.empty() ? 0.0 : costs.to_end[route.back()]);
  for (std::size_t k = 1; k < route.size(); ++k) {
    sum += costs.between(static_cast<Eigen::Index>(route[k - 1]), static_cast<Eigen::Index>(route[k]));
  }
  return sum;
}

Route profitable_route(const RouteCosts& costs, Route route, const std::vector<double>& worths_m) {
  SEEKER_ASSERT(worths_m.size() == costs.places());
  while (!route.empty()) {
    const double all_m = route_cost(costs, route);
    std::vector<double> excesses_m;
    for (std::size_t k = 0; k < route.size(); ++k) {
      Route without = route;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(k));
      excesses_m.push_back(all_m - route_cost(costs, without) - worths_m[route[k]]);
    }
    const auto worst = std::max_element(excesses_m.begin(), excesses_m.end());
    if (*worst <= 0.0) {
      break;
    }
    route.erase(route.begin() + (worst - excesses_m.begin()));
  }
  return route;
}

Route with_all_places(const RouteCosts& costs, Route route) {
  std::vector<bool> present(costs.places(), false);
  for (const std::size_t place : route) {
    present[place] = true;
  }
  for (std::size_t place = 0; place < costs.places(); ++place) {
    if (present[place]) {
      continue;
    }
    Route best;
    double best_cost = std::numeric_limits<double>::infinity();
    for (std::size_t gap = 0; gap <= route.size(); ++gap) {
      Route longer = route;
      longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(gap), place);
      const double cost = route_cost(costs, longer);
      if (best.empty() || cost < best_cost) {
        best_cost = cost;
        best = std::move(longer);
      }
    }
    route = std::move(best);
  }
  return route;
}

Route improved_route(const RouteCosts& costs, const Route& route) {
  SEEKER_ASSERT(costs.between.rows() == costs.between.cols());
  SEEKER_ASSERT(static_cast<std::size_t>(costs.between.rows()) == costs.places());
  return Improver(costs, route).run();
}

Route short_route(const RouteCosts& costs, std::size_t most_improved) {
  std::vector<std::pair<double, Route>> routes;
  for (std::size_t first = 0; first < costs.places(); ++first) {
    Route route = nearest_neighbours(costs, first);
    const double cost = route_cost(costs, route);
    routes.emplace_back(cost, std::move(route));
  }
  std::stable_sort(routes.begin(), routes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  routes.resize(std::min(routes.size(), most_improved));
  Route best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const auto& [unimproved, begun] : routes) {
    Route route = improved_route(costs, begun);
    if (const double cost = route_cost(costs, route); best.empty() || cost < best_cost - kLeastGain_m) {
      best_cost = cost;
      best = std::move(route);
    }
  }
  return best;
}

}  // namespace seeker::tour
