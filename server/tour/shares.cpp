#include "server/tour/shares.hpp"

#include <algorithm>
#include <limits>

#include "common/core/assert.hpp"

namespace seeker::tour {
namespace {

constexpr double kSaved_m = 1e-6;  ///< less is rounding

/// Routes of all robots while places are given to them.
class Routes {
 public:
  explicit Routes(const ShareCosts& costs) : costs_(costs), routes_(costs.robots()), lengths_m_(costs.robots(), 0.0) {}

  /// Where a place lengthens a robot's route the least.
  struct Insertion {
    std::size_t robot = 0;
    std::size_t at = 0;                                         ///< index of the place in the route
    double length_m = std::numeric_limits<double>::infinity();  ///< of the whole route with it
  };
  [[nodiscard]] Insertion cheapest(std::size_t robot, std::size_t place) const {
    Insertion best{robot};
    const std::vector<std::size_t>& route = routes_[robot];
    const std::size_t first = costs_.bound_for[robot] == ShareCosts::kNowhere ? 0 : 1;
    for (std::size_t at = std::min(first, route.size()); at <= route.size(); ++at) {
      const double before_m = leg(robot, at, place);
      const double saved_m = at < route.size() ? leg(robot, at, route[at]) : 0.0;
      const double after_m = at < route.size() ? between(place, route[at]) : 0.0;
      const double length_m = lengths_m_[robot] + before_m + after_m - saved_m;
      if (length_m < best.length_m - kSaved_m) {
        best = {robot, at, length_m};
      }
    }
    return best;
  }

  void insert(std::size_t place, const Insertion& where) {
    std::vector<std::size_t>& route = routes_[where.robot];
    route.insert(route.begin() + static_cast<std::ptrdiff_t>(where.at), place);
    lengths_m_[where.robot] = where.length_m;
  }

  void remove(std::size_t robot, std::size_t at) {
    routes_[robot].erase(routes_[robot].begin() + static_cast<std::ptrdiff_t>(at));
    lengths_m_[robot] = length_of(robot);
  }

  [[nodiscard]] std::size_t longest() const {
    return static_cast<std::size_t>(std::max_element(lengths_m_.begin(), lengths_m_.end()) - lengths_m_.begin());
  }
  [[nodiscard]] const std::vector<std::size_t>& route(std::size_t robot) const { return routes_[robot]; }
  [[nodiscard]] double length_m(std::size_t robot) const { return lengths_m_[robot]; }

 private:
  [[nodiscard]] double between(std::size_t a, std::size_t b) const {
    return costs_.between(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }
  /// From the place before index `at`, or from the robot.
  [[nodiscard]] double leg(std::size_t robot, std::size_t at, std::size_t to) const {
    return at == 0 ? costs_.from_robot[robot][to] : between(routes_[robot][at - 1], to);
  }
  [[nodiscard]] double length_of(std::size_t robot) const {
    double length_m = 0.0;
    for (std::size_t at = 0; at < routes_[robot].size(); ++at) {
      length_m += leg(robot, at, routes_[robot][at]);
    }
    return length_m;
  }

  const ShareCosts& costs_;
  std::vector<std::vector<std::size_t>> routes_;
  std::vector<double> lengths_m_;
};

/// The place that leaves the shortest of all routes behind, and where.
void give_next(Routes& routes, std::size_t robots, std::vector<std::size_t>& open) {
  std::size_t next = 0;
  Routes::Insertion best;
  for (std::size_t k = 0; k < open.size(); ++k) {
    for (std::size_t robot = 0; robot < robots; ++robot) {
      const Routes::Insertion here = routes.cheapest(robot, open[k]);
      if (here.length_m < best.length_m - kSaved_m) {
        best = here;
        next = k;
      }
    }
  }
  routes.insert(open[next], best);
  open.erase(open.begin() + static_cast<std::ptrdiff_t>(next));
}

/// Moves one place away from the longest route; false: that would make no shorter longest one.
bool relieve_longest(Routes& routes, const ShareCosts& costs) {
  const std::size_t from = routes.longest();
  const double longest_m = routes.length_m(from);
  const std::size_t first = costs.bound_for[from] == ShareCosts::kNowhere ? 0 : 1;
  for (std::size_t at = first; at < routes.route(from).size(); ++at) {
    const std::size_t place = routes.route(from)[at];
    for (std::size_t robot = 0; robot < costs.robots(); ++robot) {
      const Routes::Insertion there = routes.cheapest(robot, place);
      if (robot == from || there.length_m >= longest_m - kSaved_m) {
        continue;
      }
      Routes changed = routes;
      changed.remove(from, at);
      if (changed.length_m(from) < longest_m - kSaved_m) {
        routes.remove(from, at);
        routes.insert(place, there);
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::vector<std::size_t> shared_places(const ShareCosts& costs) {
  SEEKER_ASSERT(costs.robots() > 0 && costs.bound_for.size() == costs.robots());
  Routes routes(costs);
  std::vector<std::size_t> open;
  for (std::size_t place = 0; place < costs.places(); ++place) {
    const auto bound = std::find(costs.bound_for.begin(), costs.bound_for.end(), place);
    if (bound == costs.bound_for.end()) {
      open.push_back(place);
    } else {
      const auto robot = static_cast<std::size_t>(bound - costs.bound_for.begin());
      routes.insert(place, {robot, 0, costs.from_robot[robot][place]});
    }
  }
  while (!open.empty()) {
    give_next(routes, costs.robots(), open);
  }
  // Each round makes the longest route shorter, or one fewer is that long; the bound is for rounding alone.
  for (std::size_t round = 0; round < costs.places() && relieve_longest(routes, costs); ++round) {
  }
  std::vector<std::size_t> robot_of(costs.places());
  for (std::size_t robot = 0; robot < costs.robots(); ++robot) {
    for (const std::size_t place : routes.route(robot)) {
      robot_of[place] = robot;
    }
  }
  return robot_of;
}

}  // namespace seeker::tour
