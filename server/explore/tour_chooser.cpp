#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/text.hpp"
#include "server/explore/coarse_paths.hpp"
#include "server/explore/leg_forecast.hpp"
#include "server/explore/tour_places.hpp"
#include "server/explore/tour_shares.hpp"
#include "server/explore/trail.hpp"
#include "server/tour/route.hpp"

namespace seeker::explore {
namespace {

/// The direction of a path's first leg is that of its first place so far away.
constexpr double kFirstLeg_m = 0.3;
/// Only the paths to so many of the nearest places are looked at for their first direction; of others the straight line
/// counts.
constexpr std::size_t kKnownTurns = 8;
/// More passages than this on one leg are no reason to go elsewhere first.
constexpr int kMostPassages = 2;
/// The first place of a tour may change so often before one is finished without becoming dearer,
constexpr int kFreeChanges = 4;
/// and after so many doublings no tour could save it.
constexpr int kMostDoublings = 10;
/// So many of the routes from nothing are improved: the time of a decision rises with them, the tour hardly shortens.
constexpr std::size_t kMostImproved = 12;
/// More than any route.
constexpr double kNever_m = 1e5;

/// Rotation towards the place before the first leg.
double first_rotation_rad(const PlaceInput& input, const TourPlace& place, bool look_at_path) {
  const Pose2& map_T_base = input.robot.map_T_base;
  Point2 towards = place.opening.map_T_view.translation();
  if (look_at_path && !input.floor.cost.segment_is_clear(map_T_base.translation(), towards)) {
    if (const auto path = input.costs.path_to(input.floor.cost, towards)) {
      const auto first = std::find_if(path->waypoints.begin(), path->waypoints.end(), [&](const Point2& p) {
        return (p - map_T_base.translation()).norm() > kFirstLeg_m;
      });
      towards = first != path->waypoints.end() ? *first : towards;
    }
  }
  if ((towards - map_T_base.translation()).norm() < kFirstLeg_m) {
    towards = place.opening.p_map;
  }
  return std::abs(bearing_to(map_T_base, towards));
}

PlaceChoice nothing_left() {
  PlaceChoice choice;
  choice.decision.rule = "tour";
  choice.decision.why = "what is left is too little to drive to";
  return choice;
}

/// The tour of one decision.
struct Plan {
  std::vector<TourPlace> places;
  tour::RouteCosts costs;
  tour::Route route;
};

/// The place of a tour that the robot drives to; `by_the_way`: next, after an opening that is none.
struct Heading {
  std::size_t place = 0;
  bool by_the_way = false;
};

/// Plans a tour over all openings that matter and drives to the first of its places. The tour begins as the last one,
/// so that the robot does not waver.
class TourChooser final : public PlaceChooser {
 public:
  explicit TourChooser(const ExploreParams& params) : params_(params) {}

  [[nodiscard]] PlaceChoice choose(const PlaceInput& input) override;
  [[nodiscard]] bool wants_wall_ends() const override { return true; }
  [[nodiscard]] bool changes_its_mind() const override { return true; }
  [[nodiscard]] bool shares() const override { return true; }
  [[nodiscard]] std::optional<DriveManner> manner() const override {
    return DriveManner{true, params_.tour.replan_period_s, params_.tour.look_s};
  }

 private:
  [[nodiscard]] tour::RouteCosts costs_of(const PlaceInput& input, const CoarsePaths& paths,
                                          const std::vector<TourPlace>& places, const tour::Rooms& rooms) const;
  [[nodiscard]] double rotation_m(double rotation_rad, double free_rad) const;
  [[nodiscard]] double detour_rotation_m(double rotation_rad) const {
    return rotation_m(rotation_rad, params_.tour.free_rotation_rad);
  }
  [[nodiscard]] bool keep_own_share(const PlaceInput& input, const CoarsePaths& paths, Plan& plan);
  [[nodiscard]] tour::Route plan_route(const Plan& plan, const Opening* goal);
  [[nodiscard]] double worth_m(const TourPlace& place) const;
  [[nodiscard]] std::optional<Heading> heading_for(const Plan& plan, const Opening& goal) const;
  [[nodiscard]] tour::Route last_route(const Plan& plan) const;
  [[nodiscard]] tour::Route with_first(const Plan& plan, const tour::Route& route, std::size_t first) const;
  [[nodiscard]] const TourPlace* on_the_way(const PlaceInput& input, const CoarsePaths& paths,
                                            const std::vector<TourPlace>& passing, const TourPlace& next) const;
  [[nodiscard]] std::optional<Point2> certain_place_before(const PlaceInput& input, const CoarsePaths& paths,
                                                           const Opening& goal) const;
  [[nodiscard]] ExploreDecision publish(const Plan& plan, const TourPlace& chosen, bool by_the_way) const;

  ExploreParams params_;
  std::vector<std::vector<std::uint64_t>> last_order_;  ///< ids of the openings of the last tour's places
  std::optional<RobotTime> without_share_since_;        ///< since when all that is left is the share of others
  int changes_ = 0;                                     ///< of the first place since the robot last finished one
};

/// Cost of a rotation of which `free_rad` cost nothing.
double TourChooser::rotation_m(double rotation_rad, double free_rad) const {
  return params_.tour.rotation_m_rad * std::max(0.0, rotation_rad - free_rad);
}

tour::RouteCosts TourChooser::costs_of(const PlaceInput& input, const CoarsePaths& paths,
                                       const std::vector<TourPlace>& places, const tour::Rooms& rooms) const {
  std::vector<Point2> views;
  std::vector<double> beyond_m;
  for (const TourPlace& place : places) {
    views.push_back(place.seen_from_map);
    beyond_m.push_back(std::min(params_.tour.beyond_m, std::sqrt(place.gain_m2)));
  }
  const auto leg = [&](double length_m, const std::vector<int>& passages, const TourPlace& to) {
    const int crossed = passages[to.room];
    const double doors = crossed == tour::Rooms::kUnreached ? 0 : std::min(crossed, kMostPassages);
    return length_m + doors * params_.tour.passage_m;
  };
  tour::RouteCosts costs;
  const auto count = static_cast<Eigen::Index>(places.size());
  costs.between = Eigen::MatrixXd::Zero(count, count);
  const Point2 here = input.robot.map_T_base.translation();
  const std::vector<double> from_here = paths.lengths_m(here, views);
  const std::vector<int> passages_here = rooms.passages_from(rooms.at(here));
  for (std::size_t a = 0; a < places.size(); ++a) {
    const double first_m = std::isfinite(from_here[a]) ? from_here[a] : places[a].opening.cost;
    const double rotation_rad = first_rotation_rad(input, places[a], a < kKnownTurns);
    costs.from_start.push_back(params_.tour.first_leg_weight * leg(first_m, passages_here, places[a]) + beyond_m[a] +
                               rotation_m(rotation_rad, params_.tour.aside_rotation_rad));
    // The places before it are nearer to the robot, so that the search for them ends soon.
    const std::vector<double> lengths = paths.expected_m(views[a], std::span<const Point2>(views).first(a));
    const std::vector<int> passages = rooms.passages_from(places[a].room);
    for (std::size_t b = 0; b < a; ++b) {
      const double cost = leg(lengths[b], passages, places[b]) + beyond_m[a] + beyond_m[b];
      costs.between(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = cost;
      costs.between(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(a)) = cost;
    }
  }
  if (input.robot.end_map) {
    costs.to_end = paths.expected_m(*input.robot.end_map, views);
    costs.without_places_m = paths.expected_m(*input.robot.end_map, {&here, 1}).front();
    for (std::size_t k = 0; k < costs.to_end.size(); ++k) {
      costs.to_end[k] += beyond_m[k];
    }
  }
  return costs;
}

/// Leaves what other robots see to out of the plan. False: that is all of it, and the robot waits.
bool TourChooser::keep_own_share(const PlaceInput& input, const CoarsePaths& paths, Plan& plan) {
  const std::vector<std::size_t> own = own_share(input, paths, plan.places, plan.costs.between);
  if (own.empty()) {
    without_share_since_ = without_share_since_.value_or(input.robot.now);
    const std::vector<RobotTopology>& others = input.robot.fleet->others;
    const bool they_drive = std::any_of(others.begin(), others.end(), [](const RobotTopology& other) {
      return other.active && other.target_map.has_value();
    });
    const double wait_s = they_drive ? params_.tour.share_wait_s : params_.tour.idle_wait_s;
    return to_seconds(input.robot.now - *without_share_since_) > wait_s;
  }
  without_share_since_.reset();
  if (own.size() < plan.places.size()) {
    std::vector<TourPlace> places;
    std::transform(own.begin(), own.end(), std::back_inserter(places),
                   [&](std::size_t k) { return std::move(plan.places[k]); });
    plan.places = std::move(places);
    plan.costs = costs_among(plan.costs, own);
  }
  return true;
}

/// What is left of the last tour's order.
tour::Route TourChooser::last_route(const Plan& plan) const {
  tour::Route route;
  for (const std::vector<std::uint64_t>& ids : last_order_) {
    for (std::size_t k = 0; k < plan.places.size(); ++k) {
      const std::vector<std::uint64_t>& here = plan.places[k].ids;
      const bool same = std::find_first_of(here.begin(), here.end(), ids.begin(), ids.end()) != here.end();
      if (same && std::find(route.begin(), route.end(), k) == route.end()) {
        route.push_back(k);
      }
    }
  }
  return route;
}

/// The best route that begins with this place.
tour::Route TourChooser::with_first(const Plan& plan, const tour::Route& route, std::size_t first) const {
  tour::RouteCosts costs = plan.costs;
  for (std::size_t k = 0; k < costs.from_start.size(); ++k) {
    costs.from_start[k] += k == first ? 0.0 : kNever_m;
  }
  tour::Route then{first};
  std::copy_if(route.begin(), route.end(), std::back_inserter(then), [&](std::size_t k) { return k != first; });
  return tour::improved_route(costs, then);
}

std::optional<Heading> TourChooser::heading_for(const Plan& plan, const Opening& goal) const {
  const auto with_id = [&](std::uint64_t id) {
    return std::find_if(plan.places.begin(), plan.places.end(), [&](const TourPlace& place) {
      return std::find(place.ids.begin(), place.ids.end(), id) != place.ids.end();
    });
  };
  auto place = with_id(goal.id);
  const bool by_the_way = place == plan.places.end();
  if (by_the_way && !last_order_.empty()) {
    place = with_id(last_order_.front().front());
  }
  if (place == plan.places.end()) {
    return std::nullopt;
  }
  return Heading{static_cast<std::size_t>(place - plan.places.begin()), by_the_way};
}

/// With more places than a tour takes, each end of a drive has another tour, and the robot would turn round between
/// them without end: after a few changes of the first place, what the next one must save doubles with each, until a
/// place is finished.
tour::Route TourChooser::plan_route(const Plan& plan, const Opening* goal) {
  const tour::RouteCosts& costs = plan.costs;
  const double hysteresis_m = params_.tour.hysteresis_m;
  tour::Route route = tour::improved_route(costs, tour::with_all_places(costs, last_route(plan)));
  tour::Route fresh = tour::short_route(costs, kMostImproved);
  if (tour::route_cost(costs, fresh) < tour::route_cost(costs, route) - hysteresis_m) {
    route = std::move(fresh);
  }
  const std::optional<Heading> heading = goal != nullptr ? heading_for(plan, *goal) : std::nullopt;
  if (!heading) {
    changes_ = 0;
  } else if (heading->place != route.front()) {
    const int too_many = changes_ - kFreeChanges;
    const double usual_m = heading->by_the_way ? 0.0 : hysteresis_m;
    const double worth_m = too_many <= 0 ? usual_m : hysteresis_m * std::exp2(std::min(too_many, kMostDoublings));
    tour::Route same = with_first(plan, route, heading->place);
    if (tour::route_cost(costs, same) < tour::route_cost(costs, route) + worth_m) {
      return same;
    }
    ++changes_;
  }
  return route;
}

/// Of the openings that do not matter by themselves the one whose detour is the shortest for what it shows, if it is
/// short enough.
const TourPlace* TourChooser::on_the_way(const PlaceInput& input, const CoarsePaths& paths,
                                         const std::vector<TourPlace>& passing, const TourPlace& next) const {
  std::vector<const TourPlace*> near;
  std::vector<Point2> places{next.opening.map_T_view.translation()};
  for (const TourPlace& place : passing) {
    if (place.opening.cost <= params_.tour.passing_near_m) {
      near.push_back(&place);
      places.push_back(place.opening.map_T_view.translation());
    }
  }
  if (near.empty()) {
    return nullptr;
  }
  const std::vector<double> from_here = paths.lengths_m(input.robot.map_T_base.translation(), places);
  const std::vector<double> to_next = paths.lengths_m(places.front(), places);
  const double direct_m = from_here.front() + detour_rotation_m(first_rotation_rad(input, next, true));
  const TourPlace* best = nullptr;
  double best_m = 0.0;
  for (std::size_t k = 0; k < near.size(); ++k) {
    const double there_m = from_here[k + 1] + detour_rotation_m(first_rotation_rad(input, *near[k], true));
    const double rotation_on_rad = std::abs(bearing_to(near[k]->opening.map_T_view, places.front()));
    const double detour_m = there_m + to_next[k + 1] + detour_rotation_m(rotation_on_rad) - direct_m;
    const double wall_m = near[k]->opening.kind == OpeningKind::kWallFace ? near[k]->opening.size_m : 0.0;
    const bool under_way = input.goal != nullptr && input.goal->id == near[k]->opening.id;
    const double kept_m = under_way ? params_.tour.hysteresis_m : 0.0;  // else it turns to and fro between two goals
    const double spare_m = params_.tour.passing_m + params_.tour.passing_wall * wall_m + kept_m - detour_m;
    if (spare_m > best_m) {
      best_m = spare_m;
      best = near[k];
    }
  }
  return best;
}

/// Where to pass on the way so that the position stays certain enough; nothing: the leg is certain enough by itself, or
/// no place would help.
std::optional<Point2> TourChooser::certain_place_before(const PlaceInput& input, const CoarsePaths& paths,
                                                        const Opening& goal) const {
  const StrategyInput& robot = input.robot;
  const OneStepParams& one_step = params_.one_step;
  const double limit_m = params_.guard.max_position_sigma_m;
  if (robot.trail == nullptr || forecast_blind_leg(input, goal, one_step).worst_sigma_m <= limit_m) {
    return std::nullopt;
  }
  const LegForecast seeing =
      forecast_leg(input, goal, forecast_scene(input, one_step), forecast_belief(robot, one_step), one_step);
  if (seeing.worst_sigma_m <= limit_m) {
    return std::nullopt;
  }
  const std::vector<Point2> certain = robot.trail->certain_places(params_.guard.regain_position_sigma_m);
  const std::vector<double> there = paths.lengths_m(robot.map_T_base.translation(), certain);
  const std::vector<double> on = paths.lengths_m(goal.map_T_view.translation(), certain);
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < certain.size(); ++k) {
    if (std::isfinite(there[k] + on[k]) && (!best || there[k] + on[k] < there[*best] + on[*best])) {
      best = k;
    }
  }
  const bool elsewhere = best && there[*best] > params_.viewpoints.reached_m;
  return elsewhere ? std::optional(certain[*best]) : std::nullopt;
}

/// The detour that a place is worth. Behind a wide opening may lie more than the sensor shows of it, so that it is
/// worth any.
double TourChooser::worth_m(const TourPlace& place) const {
  return place.gain_m2 < params_.tour.room_m2 ? params_.tour.detour_m_m2 * place.gain_m2 : kNever_m;
}

PlaceChoice TourChooser::choose(const PlaceInput& input) {
  const tour::Rooms rooms = rooms_of(input.floor, params_.tour.rooms);
  TourPlaces found = tour_places(input, rooms, params_);
  PlaceChoice choice;
  if (found.worth_it.empty()) {
    last_order_.clear();
    return nothing_left();
  }
  Plan plan;
  plan.places = std::move(found.worth_it);
  const CoarsePaths paths(input.floor.reachable);
  plan.costs = costs_of(input, paths, plan.places, rooms);
  if (!keep_own_share(input, paths, plan)) {
    last_order_.clear();
    choice.others_busy = true;
    choice.decision.rule = "tour";
    choice.decision.why = "what is left is the share of other robots";
    return choice;
  }
  std::vector<double> worths_m;
  std::transform(plan.places.begin(), plan.places.end(), std::back_inserter(worths_m),
                 [this](const TourPlace& place) { return worth_m(place); });
  plan.route = tour::profitable_route(plan.costs, plan_route(plan, input.goal), worths_m);
  last_order_.clear();
  if (plan.route.empty()) {
    return nothing_left();
  }
  for (const std::size_t k : plan.route) {
    last_order_.push_back(plan.places[k].ids);
  }
  const TourPlace& next = plan.places[plan.route.front()];
  const TourPlace* by_the_way = on_the_way(input, paths, found.passing, next);
  const TourPlace& chosen = by_the_way != nullptr ? *by_the_way : next;
  choice.opening = chosen.opening;
  choice.via_map = certain_place_before(input, paths, chosen.opening);
  choice.decision = publish(plan, chosen, by_the_way != nullptr);
  if (choice.via_map) {
    choice.decision.why += ", by " + text(*choice.via_map) + ", where the position is certain";
  }
  return choice;
}

/// The places in the order of the tour; with one by the way first.
ExploreDecision TourChooser::publish(const Plan& plan, const TourPlace& chosen, bool by_the_way) const {
  ExploreDecision decision;
  decision.rule = "tour";
  const auto add = [&](const TourPlace& place, double score) {
    if (decision.candidates.size() < kMaxDecisionCandidates) {
      decision.candidates.push_back(candidate_of(place.opening, score));
    }
  };
  const double length_m = tour::route_cost(plan.costs, plan.route);
  if (by_the_way) {
    add(chosen, -length_m);
  }
  for (const std::size_t k : plan.route) {
    add(plan.places[k], -length_m);
  }
  decision.chosen = 0;
  decision.why =
      by_the_way ? "by the way: " + describe(chosen.opening)
                 : "first of a tour of " + std::to_string(plan.route.size()) + " places to " + describe(chosen.opening);
  return decision;
}

}  // namespace

std::unique_ptr<PlaceChooser> make_tour_chooser(const ExploreParams& params) {
  return std::make_unique<TourChooser>(params);
}

}  // namespace seeker::explore
