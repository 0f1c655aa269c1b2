#include <array>

#include "server/search/goal_chooser.hpp"

namespace seeker::search {
namespace {

constexpr std::array<CellIndex, 4> kDirections{CellIndex{1, 0}, CellIndex{0, 1}, CellIndex{-1, 0}, CellIndex{0, -1}};
constexpr int kQuarter = 4;

CellIndex neighbour(CellIndex cell, int direction) {
  const CellIndex step = kDirections.at(static_cast<std::size_t>(direction));
  return {cell.i + step.i, cell.j + step.j};
}

}  // namespace

bool SpiralChooser::open(const ChooseInput& input, CellIndex cell) const {
  const Point2 centre = frame().centre_of(cell);
  return !visited_.contains(cell) && !nav::near_any(centre, input.unreachable, params_.failed_radius_m) &&
         input.costs.cheapest_near(centre, params_.failed_radius_m / 2.0).has_value();
}

std::optional<CellIndex> SpiralChooser::spiral_step(const ChooseInput& input, CellIndex here) {
  // The reference side is the right: rotate right where it is open, else straight on, else left (BSA rules 1-3).
  for (const int quarter : {-1, 0, 1}) {
    const int direction = (direction_ + quarter + kQuarter) % kQuarter;
    if (open(input, neighbour(here, direction))) {
      direction_ = direction;
      return neighbour(here, direction);
    }
  }
  return std::nullopt;
}

std::optional<CellIndex> SpiralChooser::backtrack(const ChooseInput& input) {
  std::optional<CellIndex> best;
  double best_cost = 0.0;
  for (const CellIndex cell : visited_) {
    for (int direction = 0; direction < kQuarter; ++direction) {
      const CellIndex next = neighbour(cell, direction);
      if (!open(input, next)) {
        continue;
      }
      const auto place = input.costs.cheapest_near(frame().centre_of(next), params_.failed_radius_m / 2.0);
      const double cost = *input.costs.cost_to(*place);
      if (!best || cost < best_cost) {
        best = next;
        best_cost = cost;
        direction_ = direction;
      }
    }
  }
  return best;
}

std::optional<Goal> SpiralChooser::choose(const ChooseInput& input) {
  const CellIndex here = frame().cell_of(input.map_T_base.translation());
  visited_.insert(here);
  const CellIndex from = last_.value_or(here);
  std::optional<CellIndex> next = spiral_step(input, from);
  const bool spiral = next.has_value();
  if (!next) {
    next = backtrack(input);
  }
  if (!next) {
    return std::nullopt;
  }
  const auto place = input.costs.cheapest_near(frame().centre_of(*next), params_.failed_radius_m / 2.0);
  return Goal{input.floor.cost.frame().centre_of(*place), spiral ? "spiral" : "backtracking", false, 0.0};
}

void SpiralChooser::visited(const Goal& goal, const Pose2& /*map_T_base*/) {
  last_ = frame().cell_of(goal.p_map);
  visited_.insert(*last_);
}

void SpiralChooser::transform(const MapMove& move) {
  std::set<CellIndex> moved;
  for (const CellIndex cell : visited_) {
    moved.insert(frame().cell_of(move * frame().centre_of(cell)));
  }
  visited_ = std::move(moved);
  last_.reset();
}

}  // namespace seeker::search
