#include "server/tour/route.hpp"

#include <algorithm>
#include <limits>

#include "common/core/assert.hpp"

namespace seeker::tour {
namespace {

/// Smaller gains are rounding errors, after which an improvement might not end.
constexpr double kLeastGain_m = 1e-6;
constexpr std::size_t kLongestStretch = 3;

/// A route under improvement. Position 0 is the start and the last position the end, so that every place has two
/// neighbours.
class Improver {
 public:
  Improver(const RouteCosts& costs, Route route) : costs_(costs), route_(std::move(route)) {}

  [[nodiscard]] Route run() {
    while (reverse_any() || move_any()) {
    }
    return std::move(route_);
  }

 private:
  static constexpr std::size_t kOutside = std::numeric_limits<std::size_t>::max();

  /// The place before a position, or kOutside for the start.
  [[nodiscard]] std::size_t before(std::size_t at) const { return at == 0 ? kOutside : route_[at - 1]; }
  [[nodiscard]] std::size_t after(std::size_t at) const { return at + 1 < route_.size() ? route_[at + 1] : kOutside; }
  [[nodiscard]] double leg(std::size_t a, std::size_t b) const {
    if (a == kOutside) {
      return b == kOutside ? 0.0 : costs_.from_start[b];
    }
    if (b == kOutside) {
      return costs_.to_end.empty() ? 0.0 : costs_.to_end[a];
    }
    return costs_.between(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }

  /// 2-opt: the first reversal of a stretch that gains.
  bool reverse_any() {
    for (std::size_t i = 0; i < route_.size(); ++i) {
      for (std::size_t j = i + 1; j < route_.size(); ++j) {
        const double now = leg(before(i), route_[i]) + leg(route_[j], after(j));
        const double then = leg(before(i), route_[j]) + leg(route_[i], after(j));
        if (then < now - kLeastGain_m) {
          std::reverse(at(i), at(j + 1));
          return true;
        }
      }
    }
    return false;
  }

  /// Or-opt: the first move of a short stretch that gains.
  bool move_any() {
    for (std::size_t length = 1; length <= kLongestStretch && length < route_.size(); ++length) {
      for (std::size_t i = 0; i + length <= route_.size(); ++i) {
        if (move_stretch(i, length)) {
          return true;
        }
      }
    }
    return false;
  }

  bool move_stretch(std::size_t i, std::size_t length) {
    const std::size_t first = route_[i];
    const std::size_t last = route_[i + length - 1];
    const std::size_t from = before(i);
    const std::size_t to = after(i + length - 1);
    const double freed = leg(from, first) + leg(last, to) - leg(from, to);
    // Gaps of the route without the stretch: before its position `gap`.
    Route rest = route_;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i), rest.begin() + static_cast<std::ptrdiff_t>(i + length));
    for (std::size_t gap = 0; gap <= rest.size(); ++gap) {
      const std::size_t a = gap == 0 ? kOutside : rest[gap - 1];
      const std::size_t b = gap == rest.size() ? kOutside : rest[gap];
      const double forward = leg(a, first) + leg(last, b) - leg(a, b);
      const double backward = leg(a, last) + leg(first, b) - leg(a, b);
      if (std::min(forward, backward) < freed - kLeastGain_m) {
        Route stretch(at(i), at(i + length));
        if (backward < forward) {
          std::reverse(stretch.begin(), stretch.end());
        }
        rest.insert(rest.begin() + static_cast<std::ptrdiff_t>(gap), stretch.begin(), stretch.end());
        route_ = std::move(rest);
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] Route::iterator at(std::size_t position) {
    return route_.begin() + static_cast<std::ptrdiff_t>(position);
  }

  const RouteCosts& costs_;
  Route route_;
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
    return 0.0;
  }
  double sum = costs.from_start[route.front()] + (costs.to_end.empty() ? 0.0 : costs.to_end[route.back()]);
  for (std::size_t k = 1; k < route.size(); ++k) {
    sum += costs.between(static_cast<Eigen::Index>(route[k - 1]), static_cast<Eigen::Index>(route[k]));
  }
  return sum;
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

Route improved_route(const RouteCosts& costs, Route route) {
  SEEKER_ASSERT(costs.between.rows() == costs.between.cols());
  SEEKER_ASSERT(static_cast<std::size_t>(costs.between.rows()) == costs.places());
  return Improver(costs, std::move(route)).run();
}

Route short_route(const RouteCosts& costs) {
  Route best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < costs.places(); ++first) {
    Route route = improved_route(costs, nearest_neighbours(costs, first));
    if (const double cost = route_cost(costs, route); best.empty() || cost < best_cost - kLeastGain_m) {
      best_cost = cost;
      best = std::move(route);
    }
  }
  return best;
}

}  // namespace seeker::tour
