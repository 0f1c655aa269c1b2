#include "server/nav/floor_view.hpp"

#include <algorithm>
#include <utility>

#include "common/core/assert.hpp"
#include "server/nav/planner.hpp"
#include "server/nav/shared_floor.hpp"

namespace seeker::nav {
namespace {

constexpr std::size_t kMaxObstacles = 256;
constexpr double kSameObstacle_m = 0.1;
constexpr double kObstacleMemory_s = 60.0;
/// What the sensors show now was added with one of their last readings.
constexpr double kJustMet_s = 1.0;
/// Other robots nearer than this are planned around.
constexpr double kNearMover_m = 3.0;
/// So far from the robot ends what it may not enter: a cell's diagonal.
constexpr double kBeside_m = 0.1;

}  // namespace

FloorSource::FloorSource(const CostMapParams& cost, ForbiddenAreas areas, double floor_cell_m, double period_s)
    : cost_(cost), areas_(std::move(areas)), floor_cell_m_(floor_cell_m), period_s_(period_s) {}

void FloorSource::attend(const OccupancyMap& map, const Pose2& map_T_base, RobotTime now, std::vector<Mover> movers,
                         std::shared_ptr<const Grid<std::uint8_t>> others_floor) {
  map_ = &map;
  map_T_base_ = map_T_base;
  now_ = now;
  movers_ = std::move(movers);
  forget_older_than(kObstacleMemory_s);
  if (others_floor_ != others_floor) {
    others_floor_ = std::move(others_floor);
    stale_ = true;
  }
}

Result<std::shared_ptr<const FloorView>> FloorSource::view(bool fresh) {
  SEEKER_ASSERT(map_ != nullptr);
  const bool young = last_ && to_seconds(now_ - last_->built) < period_s_;
  const bool same = last_ && last_->revision == map_->revision();
  if (last_ && !stale_ && (same || (young && !fresh))) {
    return last_;
  }
  auto built = build();
  if (!built) {
    return tl::unexpected(built.error());
  }
  last_ = std::make_shared<const FloorView>(std::move(*built));
  stale_ = false;
  return last_;
}

Result<FloorView> FloorSource::build() const {
  auto occupancy = map_->snapshot();
  if (!occupancy) {
    return fail(Errc::kNotReady, "the map is still empty; wait for the range sensors");
  }
  if (others_floor_ == nullptr) {
    return view_of(std::move(*occupancy));
  }
  Result<FloorView> own = view_of(*occupancy);
  Result<FloorView> all = view_of(with_known(*occupancy, *others_floor_));
  if (all) {
    // On floor that only others have seen, nothing is reachable by its own.
    Grid<std::uint8_t> reachable = own ? std::move(own->reachable) : Grid<std::uint8_t>();
    all->own = FloorView::Own{std::move(*occupancy), std::move(reachable)};
  }
  return all;
}

Result<FloorView> FloorSource::view_of(Grid<std::uint8_t> occupancy) const {
  CostMapLimits limits;
  limits.bound = areas_.bound;
  limits.keep_out = areas_.keep_out;
  limits.obstacles = obstacles_map();
  auto cost = CostMap::build(occupancy, cost_, limits);
  if (!cost) {
    return tl::unexpected(cost.error());
  }
  auto reachable = reachable_floor(*cost, map_T_base_.translation(), floor_cell_m_);
  if (!reachable) {
    return tl::unexpected(reachable.error());
  }
  return FloorView{std::move(occupancy), std::move(*cost), std::move(*reachable), map_->revision(), now_};
}

std::optional<CostMap> FloorSource::around_movers(const FloorView& view) const {
  std::optional<CostMap> costs;
  for (const Mover& mover : movers_) {
    const double distance = distance_m(mover.frame_T_base, map_T_base_);
    if (distance < kNearMover_m) {
      // A mover nearer than its radius does not enclose the robot: the path may lead away from it.
      const double apart_m = std::min(mover.radius_m + mover.slack_m + cost_.robot_radius_m, distance - kBeside_m);
      costs = (costs ? *costs : view.cost).without_disc(mover.frame_T_base.translation(), apart_m);
    }
  }
  return costs;
}

void FloorSource::add_obstacle(const Point2& p_map) {
  if (std::any_of(movers_.begin(), movers_.end(), [&](const Mover& mover) { return mover.may_cover(p_map); })) {
    return;
  }
  const auto known = std::find_if(obstacles_.begin(), obstacles_.end(),
                                  [&](const Obstacle& one) { return (one.p_map - p_map).norm() < kSameObstacle_m; });
  if (known != obstacles_.end()) {
    known->noted = now_;
    return;
  }
  if (obstacles_.size() >= kMaxObstacles) {
    obstacles_.erase(std::min_element(obstacles_.begin(), obstacles_.end(),
                                      [](const Obstacle& a, const Obstacle& b) { return a.noted < b.noted; }));
  }
  obstacles_.push_back({p_map, now_});
  stale_ = true;
}

void FloorSource::forget_past_obstacles() { forget_older_than(kJustMet_s); }

void FloorSource::forget_older_than(double age_s) {
  const auto forgotten =
      std::erase_if(obstacles_, [&](const Obstacle& one) { return to_seconds(now_ - one.noted) > age_s; });
  stale_ = stale_ || forgotten > 0;
}

std::vector<Point2> FloorSource::obstacles_map() const {
  std::vector<Point2> places;
  places.reserve(obstacles_.size());
  for (const Obstacle& one : obstacles_) {
    places.push_back(one.p_map);
  }
  return places;
}

std::optional<Grid<std::uint8_t>> FloorSource::unrestricted_floor() const {
  if (!last_ || areas_.empty()) {
    return std::nullopt;
  }
  const auto cost = CostMap::build(last_->occupancy, cost_, {});
  if (!cost) {
    return std::nullopt;
  }
  auto floor = reachable_floor(*cost, map_T_base_.translation(), floor_cell_m_);
  return floor ? std::optional(std::move(*floor)) : std::nullopt;
}

void FloorSource::transform(const MapMove& move) {
  for (Obstacle& one : obstacles_) {
    one.p_map = move * one.p_map;
  }
  stale_ = true;
}

}  // namespace seeker::nav
