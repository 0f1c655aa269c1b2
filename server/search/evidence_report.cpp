#include <algorithm>
#include <cmath>
#include <string>

#include "server/search/evidence.hpp"

namespace seeker::search {
namespace {

/// Reason per cell: 0 none, else index + 1 into `reasons`.
struct GapMap {
  Grid<int> reason;
  std::vector<std::string> reasons;

  int code_of(const std::string& text) {
    const auto found = std::find(reasons.begin(), reasons.end(), text);
    if (found != reasons.end()) {
      return static_cast<int>(found - reasons.begin()) + 1;
    }
    reasons.push_back(text);
    return static_cast<int>(reasons.size());
  }
};

/// Takes the connected area of one reason out of the map.
Gap take_gap(GapMap& map, CellIndex seed) {
  const int code = map.reason[seed];
  std::vector<CellIndex> open{seed};
  map.reason[seed] = 0;
  Point2 sum = Point2::Zero();
  std::size_t cells = 0;
  std::vector<CellIndex> members;
  while (!open.empty()) {
    const CellIndex cell = open.back();
    open.pop_back();
    members.push_back(cell);
    sum += map.reason.frame().centre_of(cell);
    ++cells;
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const CellIndex next{cell.i + di, cell.j + dj};
        if (map.reason.contains(next) && map.reason[next] == code) {
          map.reason[next] = 0;
          open.push_back(next);
        }
      }
    }
  }
  // The member nearest to the mean: the mean itself may lie in a wall.
  const Point2 mean = sum / static_cast<double>(cells);
  const auto nearest = std::min_element(members.begin(), members.end(), [&](CellIndex a, CellIndex b) {
    return (map.reason.frame().centre_of(a) - mean).squaredNorm() <
           (map.reason.frame().centre_of(b) - mean).squaredNorm();
  });
  const double side = map.reason.frame().resolution_m;
  return {map.reason.frame().centre_of(*nearest), static_cast<double>(cells) * side * side,
          map.reasons[static_cast<std::size_t>(code - 1)]};
}

std::vector<Gap> take_gaps(GapMap& map, double min_area_m2) {
  std::vector<Gap> gaps;
  for (std::size_t k = 0; k < map.reason.cells().size(); ++k) {
    if (map.reason.cells()[k] == 0) {
      continue;
    }
    constexpr double kRounding_m2 = 1e-9;
    Gap gap = take_gap(map, map.reason.cell(k));
    if (gap.area_m2 + kRounding_m2 >= min_area_m2) {
      gaps.push_back(std::move(gap));
    }
  }
  std::stable_sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.area_m2 > b.area_m2; });
  return gaps;
}

}  // namespace

EvidenceReport EvidenceGrid::report(const Grid<std::uint8_t>& reachable, const ReasonOf& reason_of) const {
  constexpr double kScale = 254.0;
  EvidenceReport report;
  report.probability = Grid<std::uint8_t>(reachable.frame(), reachable.width(), reachable.height(), kNotReachableFloor);
  GapMap gaps{Grid<int>(reachable.frame(), reachable.width(), reachable.height(), 0), {}};
  for (std::size_t k = 0; k < reachable.cells().size(); ++k) {
    const CellIndex cell = reachable.cell(k);
    const Point2 centre = reachable.frame().centre_of(cell);
    if (reachable.cells()[k] == 0) {
      if (const auto reason = reason_of(centre)) {
        gaps.reason[cell] = gaps.code_of(*reason);
      }
      continue;
    }
    const double p = probability_at(centre);
    report.probability[cell] = static_cast<std::uint8_t>(std::lround(p * kScale));
    if (p < params_.threshold) {
      gaps.reason[cell] = gaps.code_of(reason_of(centre).value_or("not seen"));
    }
  }
  report.summary = summary(reachable);
  report.gaps = take_gaps(gaps, params_.min_gap_m2);
  report.summary.gaps = static_cast<int>(report.gaps.size());
  return report;
}

CoverageSummary EvidenceGrid::summary(const Grid<std::uint8_t>& reachable) const {
  const double area = reachable.frame().resolution_m * reachable.frame().resolution_m;
  CoverageSummary summary;
  summary.threshold = params_.threshold;
  double mass = 0.0;
  std::size_t cells = 0;
  for (std::size_t k = 0; k < reachable.cells().size(); ++k) {
    if (reachable.cells()[k] == 0) {
      continue;
    }
    const double p = probability_at(reachable.frame().centre_of(reachable.cell(k)));
    ++cells;
    mass += p;
    summary.covered_area_m2 += p >= params_.threshold ? area : 0.0;
  }
  summary.reachable_area_m2 = static_cast<double>(cells) * area;
  summary.mean_probability = cells == 0 ? 0.0 : mass / static_cast<double>(cells);
  return summary;
}

}  // namespace seeker::search
