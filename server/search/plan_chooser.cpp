#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/search/goal_chooser.hpp"

namespace seeker::search {
namespace {

constexpr int kMaxVisits = 3;  ///< of one cell as a goal
/// Views from one place that differ less than this see the same.
constexpr double kSameView_rad = 0.8;

/// Reachable floor whose evidence is too weak.
Grid<std::uint8_t> wanted_floor(const Grid<std::uint8_t>& reachable, const EvidenceGrid& evidence, double enough) {
  Grid<std::uint8_t> wanted = reachable;
  for (std::size_t k = 0; k < wanted.cells().size(); ++k) {
    if (wanted.cells()[k] != 0 && evidence.probability_at(wanted.frame().centre_of(wanted.cell(k))) >= enough) {
      wanted.cells()[k] = 0;
    }
  }
  return wanted;
}

/// Sums of a grid over rectangles in constant time.
class AreaSums {
 public:
  explicit AreaSums(const Grid<std::uint8_t>& grid)
      : frame_(grid.frame()), sums_({}, grid.width() + 1, grid.height() + 1, 0) {
    for (int j = 0; j < grid.height(); ++j) {
      for (int i = 0; i < grid.width(); ++i) {
        sums_[{i + 1, j + 1}] = grid[{i, j}] + sums_[{i, j + 1}] + sums_[{i + 1, j}] - sums_[{i, j}];
      }
    }
  }
  /// Over the square of half side `reach_m` about p.
  [[nodiscard]] int about(const Point2& p_map, double reach_m) const {
    const CellIndex low = clamp(frame_.cell_of(p_map - Point2::Constant(reach_m)));
    CellIndex high = frame_.cell_of(p_map + Point2::Constant(reach_m));
    high = clamp({high.i + 1, high.j + 1});
    return sums_[high] - sums_[{low.i, high.j}] - sums_[{high.i, low.j}] + sums_[low];
  }

 private:
  [[nodiscard]] CellIndex clamp(CellIndex c) const {
    return {std::clamp(c.i, 0, sums_.width() - 1), std::clamp(c.j, 0, sums_.height() - 1)};
  }
  GridFrame frame_;
  Grid<int> sums_;
};

}  // namespace

std::vector<PlanChooser::Candidate> PlanChooser::cells(const ChooseInput& input,
                                                       const Grid<std::uint8_t>& wanted) const {
  const AreaSums sums(wanted);
  const GridFrame frame{Point2::Zero(), params_.cell_m};
  const Point2 corner = wanted.frame().origin;
  const CellIndex low = frame.cell_of(corner);
  const CellIndex high = frame.cell_of(corner + wanted.frame().resolution_m * Point2(wanted.width(), wanted.height()));
  std::vector<Candidate> candidates;
  for (CellIndex cell = low; cell.j <= high.j; ++cell.j) {
    for (cell.i = low.i; cell.i <= high.i; ++cell.i) {
      const auto visits = visits_.find(cell);
      const auto place = input.costs.cheapest_near(frame.centre_of(cell), params_.cell_m / 2.0);
      if (!place || (visits != visits_.end() && visits->second >= kMaxVisits)) {
        continue;
      }
      const Point2 p = input.floor.cost.frame().centre_of(*place);
      if (nav::near_any(p, input.unreachable, params_.failed_radius_m)) {
        continue;
      }
      const double cost = *input.costs.cost_to(*place);
      const int most = sums.about(p, input.evidence.hit_rate().max_range_m);
      if (most >= params_.min_gain_cells) {
        candidates.push_back({{p, "unsearched cell", false, 0.0, {}}, cost, most / (cost + params_.travel_offset_m)});
      }
    }
  }
  return candidates;
}

void PlanChooser::add_frontiers(const ChooseInput& input, std::vector<Candidate>& candidates) const {
  for (const nav::Frontier& frontier : nav::find_frontiers(input.floor.cost, input.costs, params_.min_frontier_m)) {
    if (nav::near_any(frontier.p_map, input.unreachable, params_.failed_radius_m) ||
        nav::near_any(frontier.p_map, seen_frontiers_, params_.frontier_reach_m)) {
      continue;
    }
    const double score = params_.frontier_bonus_cells / (frontier.cost + params_.travel_offset_m);
    candidates.push_back({{frontier.p_map, "frontier", true, params_.frontier_bonus_cells, {}, frontier.length_m},
                          frontier.cost,
                          score});
  }
}

void PlanChooser::add_map_views(const ChooseInput& input, std::vector<Candidate>& candidates) const {
  if (!input.map_views) {
    return;
  }
  for (const Pose2& view : input.map_views()) {
    const std::optional<double> cost = input.costs.cost_to(view.translation());
    const bool failed = nav::near_any(view.translation(), input.unreachable, params_.failed_radius_m);
    const bool seen = std::any_of(seen_views_.begin(), seen_views_.end(), [&](const Pose2& other) {
      return distance_m(view, other) < params_.frontier_reach_m &&
             std::abs(wrap_angle(view.theta_rad - other.theta_rad)) < kSameView_rad;
    });
    if (cost && !failed && !seen) {
      const double score = params_.frontier_bonus_cells / (*cost + params_.travel_offset_m);
      candidates.push_back(
          {{view.translation(), "open wall", true, params_.frontier_bonus_cells, view.theta_rad}, *cost, score});
    }
  }
}

std::optional<Goal> PlanChooser::foresee(const ChooseInput& input) const {
  const Grid<std::uint8_t> wanted =
      wanted_floor(input.floor.reachable, input.evidence, params_.cell_target_probability);
  std::vector<Candidate> candidates = cells(input, wanted);
  add_frontiers(input, candidates);
  add_map_views(input, candidates);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.bound > b.bound; });
  std::optional<Goal> best;
  double best_score = 0.0;
  // The exact gain costs a visibility computation: only candidates whose bound can still win are computed.
  for (Candidate& candidate : candidates) {
    if (candidate.bound <= best_score) {
      break;
    }
    double score = candidate.bound;
    if (!candidate.goal.is_frontier) {
      candidate.goal.expected_gain =
          input.evidence.expected_gain(input.floor.occupancy, wanted, candidate.goal.p_map, input.target_size_m);
      if (candidate.goal.expected_gain < params_.min_gain_cells) {
        continue;
      }
      score = candidate.goal.expected_gain / (candidate.cost + params_.travel_offset_m);
    }
    if (score > best_score) {
      best_score = score;
      best = candidate.goal;
    }
  }
  return best;
}

void PlanChooser::visited(const Goal& goal, const Pose2& /*map_T_base*/) {
  ++visits_[GridFrame{Point2::Zero(), params_.cell_m}.cell_of(goal.p_map)];
  if (goal.heading_rad) {
    seen_views_.push_back({goal.p_map.x(), goal.p_map.y(), *goal.heading_rad});
  } else if (goal.is_frontier) {
    seen_frontiers_.push_back(goal.p_map);
  }
}

bool PlanChooser::still_worth(const Goal& goal, const nav::FloorView& floor, const EvidenceGrid& evidence,
                              double target_size_m) const {
  if (goal.is_frontier) {
    return goal.heading_rad || nav::border_near(floor.cost, goal.p_map, params_.frontier_reach_m);
  }
  constexpr double kWorthShare = 0.5;  ///< of what was expected when the goal was chosen
  const Grid<std::uint8_t> wanted = wanted_floor(floor.reachable, evidence, params_.cell_target_probability);
  const double gain = evidence.expected_gain(floor.occupancy, wanted, goal.p_map, target_size_m);
  return gain >= std::max(params_.min_gain_cells, kWorthShare * goal.expected_gain);
}

void PlanChooser::transform(const MapMove& move) {
  visits_.clear();
  for (Point2& p : seen_frontiers_) {
    p = move * p;
  }
  for (Pose2& view : seen_views_) {
    view = move * view;
  }
}

}  // namespace seeker::search
