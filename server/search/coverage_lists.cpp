#include "server/search/coverage_lists.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"

namespace seeker::search {

int passes_limit(double area_m2, double cell_area_m2) {
  SEEKER_ASSERT(cell_area_m2 > 0.0);
  constexpr double kPerPass = 3.0;
  return std::max(1, static_cast<int>(std::ceil(area_m2 / (kPerPass * cell_area_m2))));
}

Pose2 potential_cell(const Pose2& map_T_base, double alpha_s_rad, double d_m, double r_m) {
  const Point2 p_base((d_m + r_m) * std::cos(alpha_s_rad), (d_m + r_m) * std::sin(alpha_s_rad));
  const Point2 p_map = map_T_base * p_base;
  return {p_map.x(), p_map.y(), wrap_angle(map_T_base.theta_rad + alpha_s_rad)};
}

CoverageLists::CoverageLists(double cell_m, int passes_limit) {
  SEEKER_ASSERT(cell_m > 0.0 && passes_limit >= 1);
  lists_.cell_size_m = cell_m;
  lists_.passes_limit_n = passes_limit;
}

bool CoverageLists::in_list(const std::vector<Point2>& list, const Point2& p_map) const {
  return std::any_of(list.begin(), list.end(), [&](const Point2& q) {
    return (q - p_map).lpNorm<Eigen::Infinity>() <= lists_.cell_size_m / 2.0;
  });
}

bool CoverageLists::searched(const Point2& p_map) const { return in_list(lists_.searched, p_map); }

void CoverageLists::remove_unsearched(const Point2& p_map) {
  auto& list = lists_.unsearched;
  list.erase(std::remove_if(
                 list.begin(), list.end(),
                 [&](const Point2& q) { return (q - p_map).lpNorm<Eigen::Infinity>() <= lists_.cell_size_m / 2.0; }),
             list.end());
}

bool CoverageLists::note_potential(const Point2& p_map) {
  if (in_list(lists_.searched, p_map) || in_list(lists_.unsearched, p_map) || in_list(lists_.unreachable, p_map)) {
    return false;
  }
  lists_.unsearched.push_back(p_map);
  return true;
}

Arrival CoverageLists::arrive(const Point2& p_map) {
  if (searched(p_map)) {
    ++lists_.passes_n;
    return lists_.passes_n >= lists_.passes_limit_n ? Arrival::kSearchWell : Arrival::kPass;
  }
  lists_.searched.push_back(p_map);
  lists_.passes_n = 0;
  remove_unsearched(p_map);
  return Arrival::kFresh;
}

std::optional<Point2> CoverageLists::nearest_unsearched(const Point2& p_map) const {
  const auto& list = lists_.unsearched;
  const auto nearest = std::min_element(list.begin(), list.end(), [&](const Point2& a, const Point2& b) {
    return (a - p_map).squaredNorm() < (b - p_map).squaredNorm();
  });
  return nearest == list.end() ? std::nullopt : std::optional<Point2>(*nearest);
}

void CoverageLists::escaped(const Point2& goal_map, const Point2& p_map) {
  remove_unsearched(goal_map);
  lists_.searched.push_back(p_map);
  lists_.passes_n = 0;
  lists_.passes_limit_n = std::max(1, lists_.passes_limit_n / 2);
}

void CoverageLists::drop_unreachable(const Point2& goal_map) {
  auto& list = lists_.unsearched;
  list.erase(std::remove(list.begin(), list.end(), goal_map), list.end());
  lists_.unreachable.push_back(goal_map);
}

void CoverageLists::take_back(const GridLists& lists) {
  if (lists.cell_size_m == lists_.cell_size_m && lists.passes_limit_n >= 1) {
    lists_ = lists;
  }
}

void CoverageLists::transform(const MapMove& move) {
  for (auto* list : {&lists_.searched, &lists_.unsearched, &lists_.unreachable}) {
    for (Point2& p : *list) {
      p = move * p;
    }
  }
}

}  // namespace seeker::search
