#include "server/nav/planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "server/nav/departure_cell.hpp"
#include "server/nav/ray.hpp"

namespace seeker::nav {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr std::uint8_t kNoParent = 255;
/// A straight way may cost this much more than the cell-by-cell way that it replaces.
constexpr double kShortcutTolerance = 1.01;

struct Direction {
  int di;
  int dj;
  float length;  ///< in cells
};
constexpr float kDiagonal = std::numbers::sqrt2_v<float>;
constexpr std::size_t kSides = 4;
/// The sides first, then the corners, each between the side of its number and the next one.
constexpr std::array<Direction, 8> kDirections{{{1, 0, 1.0F},
                                                {0, 1, 1.0F},
                                                {-1, 0, 1.0F},
                                                {0, -1, 1.0F},
                                                {1, 1, kDiagonal},
                                                {-1, 1, kDiagonal},
                                                {-1, -1, kDiagonal},
                                                {1, -1, kDiagonal}}};

float octile_m(CellIndex a, CellIndex b, double resolution_m) {
  const auto di = static_cast<float>(std::abs(a.i - b.i));
  const auto dj = static_cast<float>(std::abs(a.j - b.j));
  return static_cast<float>(resolution_m) * (std::max(di, dj) + (kDiagonal - 1.0F) * std::min(di, dj));
}

/// Queue of cells whose order is that of their priorities up to `width_m`: constant time where a heap needs a logarithm
/// and its cache misses. As no step costs less than the width, a flood that takes a whole bucket before the next
/// settles every cell once.
class BucketQueue {
 public:
  using Entry = std::pair<float, std::size_t>;  ///< priority and cell

  explicit BucketQueue(double width_m) : width_m_(static_cast<float>(width_m)) {}

  void push(float priority, std::size_t index) {
    const std::size_t bucket = std::max(current_, static_cast<std::size_t>(priority / width_m_));
    if (bucket >= buckets_.size()) {
      buckets_.resize(bucket + 1);
    }
    buckets_[bucket].emplace_back(priority, index);
  }
  [[nodiscard]] std::optional<Entry> pop() {
    while (current_ < buckets_.size()) {
      if (next_ < buckets_[current_].size()) {
        return buckets_[current_][next_++];
      }
      std::vector<Entry>().swap(buckets_[current_]);
      ++current_;
      next_ = 0;
    }
    return std::nullopt;
  }
  /// Everything of a lower priority has been taken out.
  [[nodiscard]] float taken_below() const { return static_cast<float>(current_) * width_m_; }

 private:
  float width_m_;
  std::vector<std::vector<Entry>> buckets_;
  std::size_t current_ = 0;
  std::size_t next_ = 0;  ///< in the current bucket
};

/// Costs and predecessors of one search from `start`; stops at `goal` when given (A*), else floods (Dijkstra).
struct Search {
  Grid<float> costs;
  Grid<std::uint8_t> parent;

  Search(const CostMap& map, CellIndex start, std::optional<CellIndex> goal)
      : costs(map.frame(), map.width(), map.height(), kFar),
        parent(map.frame(), map.width(), map.height(), kNoParent),
        map_(map),
        goal_(goal),
        open_(map.frame().resolution_m) {
    costs[start] = 0.0F;
    push(costs.index(start));
    while (const auto entry = open_.pop()) {
      if (entry->first > costs.cells()[entry->second] + heuristic(entry->second)) {
        continue;  // a cheaper way was found after this entry was queued
      }
      if (goal_ && costs[*goal_] < open_.taken_below()) {
        return;
      }
      expand(costs.cell(entry->second));
    }
  }

 private:
  [[nodiscard]] float heuristic(std::size_t index) const {
    return goal_ ? octile_m(costs.cell(index), *goal_, map_.frame().resolution_m) : 0.0F;
  }
  void push(std::size_t index) { open_.push(costs.cells()[index] + heuristic(index), index); }

  /// A diagonal step is left out where it would cut the corner of a cell that cannot be entered.
  void expand(CellIndex cell) {
    const std::size_t index = costs.index(cell);
    const float here = map_.cost(cell);
    const auto half_cell_m = static_cast<float>(map_.frame().resolution_m / 2.0);
    std::array<float, kSides> beside{};
    for (std::size_t d = 0; d < kDirections.size(); ++d) {
      const auto& [di, dj, length] = kDirections[d];
      if (d >= kSides && (beside[d - kSides] <= 0.0F || beside[(d + 1) % kSides] <= 0.0F)) {
        continue;
      }
      const float there = map_.cost({cell.i + di, cell.j + dj});
      if (d < kSides) {
        beside[d] = there;
      }
      if (there <= 0.0F) {
        continue;
      }
      const std::size_t next = index + static_cast<std::size_t>(dj * costs.width() + di);
      const float cost = costs.cells()[index] + half_cell_m * length * (here + there);
      if (cost < costs.cells()[next]) {
        costs.cells()[next] = cost;
        parent.cells()[next] = static_cast<std::uint8_t>(d);
        push(next);
      }
    }
  }

  const CostMap& map_;
  std::optional<CellIndex> goal_;
  BucketQueue open_;
};

/// Cost of the straight way; infinity when it is not clear. Each crossed cell counts with the length inside it only on
/// average, which is exact enough to compare ways.
double straight_cost(const CostMap& map, const Point2& a, const Point2& b) {
  const GridFrame& f = map.frame();
  RayWalk walk((a - f.origin) / f.resolution_m, (b - f.origin) / f.resolution_m);
  double sum = 0.0;
  int cells = 0;
  do {
    const float cost = map.cost(walk.cell());
    if (cost <= 0.0F) {
      return std::numeric_limits<double>::infinity();
    }
    sum += cost;
    ++cells;
  } while (walk.advance());
  return sum / cells * (b - a).norm();
}

std::vector<CellIndex> trace(const Grid<std::uint8_t>& parent, CellIndex goal) {
  std::vector<CellIndex> cells{goal};
  while (parent[cells.back()] != kNoParent) {
    const Direction& back = kDirections[parent[cells.back()]];
    cells.push_back({cells.back().i - back.di, cells.back().j - back.dj});
    SEEKER_ASSERT(cells.size() <= parent.cells().size());
  }
  std::reverse(cells.begin(), cells.end());
  return cells;
}

/// Drops the cells between two that a straight way joins at no higher cost.
std::vector<Point2> shorten(const CostMap& map, const Grid<float>& costs, const std::vector<CellIndex>& cells) {
  const GridFrame& f = map.frame();
  std::vector<Point2> kept{f.centre_of(cells.front())};
  std::size_t anchor = 0;
  for (std::size_t k = 2; k < cells.size(); ++k) {
    const double way = static_cast<double>(costs[cells[k]]) - static_cast<double>(costs[cells[anchor]]);
    const double direct = straight_cost(map, f.centre_of(cells[anchor]), f.centre_of(cells[k]));
    if (!(direct <= kShortcutTolerance * way)) {
      anchor = k - 1;
      kept.push_back(f.centre_of(cells[anchor]));
    }
  }
  if (cells.size() > 1) {
    kept.push_back(f.centre_of(cells.back()));
  }
  return kept;
}

/// The ends of the way: where the robot really stands and where it really wants to be.
void attach_ends(const CostMap& map, const Point2& start, const Point2& goal, std::vector<Point2>& waypoints) {
  if (map.traversable(goal)) {
    if (waypoints.size() > 1) {
      waypoints.back() = goal;
    } else {
      waypoints.push_back(goal);
    }
  }
  // The first cell's centre is kept only where the straight way to the second waypoint would leave the free floor.
  if (waypoints.size() > 1 && map.traversable(start) && map.segment_is_clear(start, waypoints[1])) {
    waypoints.front() = start;
  } else {
    waypoints.insert(waypoints.begin(), start);
  }
}

Path make_path(const CostMap& map, const Grid<float>& costs, const Grid<std::uint8_t>& parent, const Point2& start,
               const Point2& goal, CellIndex goal_cell, bool shortened) {
  const std::vector<CellIndex> cells = trace(parent, goal_cell);
  Path path;
  if (shortened) {
    path.waypoints = shorten(map, costs, cells);
  } else {
    for (const CellIndex& cell : cells) {
      path.waypoints.push_back(map.frame().centre_of(cell));
    }
  }
  attach_ends(map, start, goal, path.waypoints);
  for (std::size_t k = 1; k < path.waypoints.size(); ++k) {
    path.length_m += (path.waypoints[k] - path.waypoints[k - 1]).norm();
  }
  path.cost = std::max(static_cast<double>(costs[goal_cell]), path.length_m);
  return path;
}

Result<CellIndex> snap_start(const CostMap& map, const Point2& start, const PlannerParams& params) {
  if (!start.allFinite()) {
    return fail(Errc::kInvalidArgument, "the start of the way is not a finite point");
  }
  if (const auto cell = departure_cell(map, start, params.start_snap_m)) {
    return *cell;
  }
  return fail(Errc::kUnreachable,
              "the robot is walled in: no free floor near where it stands; move it away from the obstacles");
}

Result<CellIndex> snap_goal(const CostMap& map, const Point2& goal, const PlannerParams& params) {
  if (!goal.allFinite()) {
    return fail(Errc::kInvalidArgument, "the goal of the way is not a finite point");
  }
  if (const auto cell = map.nearest_traversable(goal, params.goal_snap_m)) {
    return *cell;
  }
  const UnreachableCause cause = map.obstruction(goal);
  return fail(Errc::kUnreachable, "the goal is no place for the robot: " + std::string(explain(cause)) + "; " +
                                      std::string(remedy_of(cause)));
}

tl::unexpected<Error> no_connection() {
  return fail(Errc::kUnreachable,
              "no way leads to the goal: obstacles, keep-out areas, the bound or unknown space cut it off");
}

}  // namespace

Result<Path> plan(const CostMap& map, const Point2& start_map, const Point2& goal_map, const PlannerParams& params) {
  const auto start = snap_start(map, start_map, params);
  if (!start) {
    return tl::unexpected(start.error());
  }
  const auto goal = snap_goal(map, goal_map, params);
  if (!goal) {
    return tl::unexpected(goal.error());
  }
  const Search search(map, *start, *goal);
  if (search.costs[*goal] == kFar) {
    return no_connection();
  }
  return make_path(map, search.costs, search.parent, start_map, goal_map, *goal, params.shorten);
}

UnreachableCause cause_of_no_path(const CostMap& map, const Point2& start_map, const Point2& goal_map,
                                  const PlannerParams& params) {
  if (!departure_cell(map, start_map, params.start_snap_m)) {
    const UnreachableCause here = map.obstruction(start_map);
    const bool forbidden = here == UnreachableCause::kOutsideBound || here == UnreachableCause::kKeptOut;
    return forbidden ? UnreachableCause::kRobotForbidden : UnreachableCause::kRobotEnclosed;
  }
  return map.nearest_traversable(goal_map, params.goal_snap_m) ? UnreachableCause::kCutOff : map.obstruction(goal_map);
}

Result<DistanceField> DistanceField::build(const CostMap& map, const Point2& start_map, const PlannerParams& params) {
  const auto start = snap_start(map, start_map, params);
  if (!start) {
    return tl::unexpected(start.error());
  }
  Search search(map, *start, std::nullopt);
  DistanceField field;
  field.params_ = params;
  field.start_ = start_map;
  field.costs_ = std::move(search.costs);
  field.parent_ = std::move(search.parent);
  return field;
}

std::optional<double> DistanceField::cost_to(CellIndex cell) const {
  if (!costs_.contains(cell) || costs_[cell] == kFar) {
    return std::nullopt;
  }
  return costs_[cell];
}

std::optional<double> DistanceField::cost_to(const Point2& goal_map) const {
  return cost_to(costs_.frame().cell_of(goal_map));
}

std::optional<CellIndex> DistanceField::cheapest_near(const Point2& goal_map, double radius_m,
                                                      const std::function<bool(const Point2&)>& fits) const {
  const int reach = static_cast<int>(std::ceil(radius_m / costs_.frame().resolution_m));
  const CellIndex centre = costs_.frame().cell_of(goal_map);
  std::optional<CellIndex> best;
  for (int j = centre.j - reach; j <= centre.j + reach; ++j) {
    for (int i = centre.i - reach; i <= centre.i + reach; ++i) {
      const CellIndex cell{i, j};
      const Point2 middle = costs_.frame().centre_of(cell);
      const bool better =
          (middle - goal_map).norm() <= radius_m && cost_to(cell) && (!best || costs_[cell] < costs_[*best]);
      if (better && (!fits || fits(middle))) {
        best = cell;
      }
    }
  }
  return best;
}

Result<Path> DistanceField::path_to(const CostMap& map, const Point2& goal_map) const {
  const auto goal = snap_goal(map, goal_map, params_);
  if (!goal) {
    return tl::unexpected(goal.error());
  }
  SEEKER_ASSERT(costs_.frame() == map.frame() && costs_.contains(*goal));
  if (costs_[*goal] == kFar) {
    return no_connection();
  }
  return make_path(map, costs_, parent_, start_, goal_map, *goal, params_.shorten);
}

}  // namespace seeker::nav
