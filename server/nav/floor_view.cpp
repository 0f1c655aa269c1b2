#include "server/nav/floor_view.hpp"

#include <utility>

#include "common/core/assert.hpp"
#include "server/nav/planner.hpp"

namespace seeker::nav {
namespace {

constexpr std::size_t kMaxObstacles = 256;
constexpr double kSameObstacle_m = 0.1;

}  // namespace

FloorSource::FloorSource(const CostMapParams& cost, ForbiddenAreas areas, double floor_cell_m, double period_s)
    : cost_(cost), areas_(std::move(areas)), floor_cell_m_(floor_cell_m), period_s_(period_s) {}

void FloorSource::attend(const OccupancyMap& map, const Pose2& map_T_base, RobotTime now) {
  map_ = &map;
  map_T_base_ = map_T_base;
  now_ = now;
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
  CostMapLimits limits;
  limits.bound = areas_.bound;
  limits.keep_out = areas_.keep_out;
  limits.obstacles = obstacles_;
  auto cost = CostMap::build(*occupancy, cost_, limits);
  if (!cost) {
    return tl::unexpected(cost.error());
  }
  auto reachable = reachable_floor(*cost, map_T_base_.translation(), floor_cell_m_);
  if (!reachable) {
    return tl::unexpected(reachable.error());
  }
  return FloorView{std::move(*occupancy), std::move(*cost), std::move(*reachable), map_->revision(), now_};
}

void FloorSource::add_obstacle(const Point2& p_map) {
  for (const Point2& known : obstacles_) {
    if ((known - p_map).norm() < kSameObstacle_m) {
      return;
    }
  }
  if (obstacles_.size() < kMaxObstacles) {
    obstacles_.push_back(p_map);
    stale_ = true;
  }
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

void FloorSource::transform(const Pose2& new_T_old) {
  for (Point2& p : obstacles_) {
    p = new_T_old * p;
  }
  stale_ = true;
}

}  // namespace seeker::nav
