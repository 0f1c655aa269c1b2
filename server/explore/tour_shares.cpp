#include "server/explore/tour_shares.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "server/tour/shares.hpp"

namespace seeker::explore {
namespace {

/// A robot whose goal lies within this distance of a place is on its way to that place: maps of two robots differ a
/// bit, and each has its own viewpoint of an opening.
constexpr double kSameGoal_m = 1.5;

/// A robot with its first legs.
struct Sharer {
  std::string id;
  std::vector<double> legs_m;
  std::size_t bound_for = tour::ShareCosts::kNowhere;
  bool self = false;
};

double distance_to(const TourPlace& place, const Point2& p_map) {
  return std::min((place.seen_from_map - p_map).norm(), (place.opening.p_map - p_map).norm());
}

/// The first legs of a robot. They are measured alike for all robots, so that each robot comes to the same shares.
std::vector<double> legs_from(const Point2& robot_map, const CoarsePaths& paths, const std::vector<TourPlace>& places) {
  std::vector<Point2> views;
  std::transform(places.begin(), places.end(), std::back_inserter(views),
                 [](const TourPlace& place) { return place.seen_from_map; });
  return paths.expected_m(robot_map, views);
}

Sharer self_of(const PlaceInput& input, const CoarsePaths& paths, const std::vector<TourPlace>& places) {
  Sharer self{input.robot.fleet->robot_id, legs_from(input.robot.map_T_base.translation(), paths, places)};
  self.self = true;
  for (std::size_t k = 0; input.goal != nullptr && k < places.size(); ++k) {
    const std::vector<std::uint64_t>& ids = places[k].ids;
    if (std::find(ids.begin(), ids.end(), input.goal->id) != ids.end()) {
      self.bound_for = k;
    }
  }
  return self;
}

Sharer other_of(const RobotTopology& robot, const CoarsePaths& paths, const std::vector<TourPlace>& places) {
  Sharer other{robot.robot_id, legs_from(robot.map_T_base.translation(), paths, places)};
  double nearest_m = kSameGoal_m;
  for (std::size_t k = 0; robot.target_map && k < places.size(); ++k) {
    if (distance_to(places[k], *robot.target_map) < nearest_m) {
      nearest_m = distance_to(places[k], *robot.target_map);
      other.bound_for = k;
    }
  }
  return other;
}

/// Of several robots on their way to one place the nearest keeps it, the first by name of those that are equally near.
void keep_nearest(std::vector<Sharer>& robots) {
  for (std::size_t a = 0; a < robots.size(); ++a) {
    for (std::size_t b = a + 1; b < robots.size(); ++b) {
      const std::size_t place = robots[a].bound_for;
      if (place == tour::ShareCosts::kNowhere || robots[b].bound_for != place) {
        continue;
      }
      Sharer& farther = robots[b].legs_m[place] < robots[a].legs_m[place] ? robots[a] : robots[b];
      farther.bound_for = tour::ShareCosts::kNowhere;
    }
  }
}

}  // namespace

std::vector<std::size_t> own_share(const PlaceInput& input, const CoarsePaths& paths,
                                   const std::vector<TourPlace>& places, const Eigen::MatrixXd& between) {
  std::vector<Sharer> robots;
  if (input.robot.fleet != nullptr) {
    robots.push_back(self_of(input, paths, places));
    for (const RobotTopology& robot : input.robot.fleet->others) {
      if (robot.active) {
        robots.push_back(other_of(robot, paths, places));
      }
    }
  }
  std::vector<std::size_t> own(places.size());
  std::iota(own.begin(), own.end(), std::size_t{0});
  if (robots.size() < 2) {
    return own;
  }
  std::sort(robots.begin(), robots.end(), [](const Sharer& a, const Sharer& b) { return a.id < b.id; });
  keep_nearest(robots);
  tour::ShareCosts shared;
  shared.between = between;
  std::size_t self = 0;
  for (std::size_t k = 0; k < robots.size(); ++k) {
    shared.from_robot.push_back(robots[k].legs_m);
    shared.bound_for.push_back(robots[k].bound_for);
    self = robots[k].self ? k : self;
  }
  const std::vector<std::size_t> robot_of = tour::shared_places(shared);
  own.erase(std::remove_if(own.begin(), own.end(), [&](std::size_t place) { return robot_of[place] != self; }),
            own.end());
  return own;
}

tour::RouteCosts costs_among(const tour::RouteCosts& costs, const std::vector<std::size_t>& places) {
  tour::RouteCosts some;
  const auto count = static_cast<Eigen::Index>(places.size());
  some.between = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const std::size_t from = places[static_cast<std::size_t>(a)];
    some.from_start.push_back(costs.from_start[from]);
    if (!costs.to_end.empty()) {
      some.to_end.push_back(costs.to_end[from]);
    }
    for (Eigen::Index b = 0; b < count; ++b) {
      some.between(a, b) = costs.between(static_cast<Eigen::Index>(from),
                                         static_cast<Eigen::Index>(places[static_cast<std::size_t>(b)]));
    }
  }
  some.without_places_m = costs.without_places_m;
  return some;
}

}  // namespace seeker::explore
