#include "server/slam/map_agreement.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::slam {
namespace {

struct Counts {
  std::uint8_t beams = 0;
  std::uint8_t points = 0;
};

std::uint8_t one_more(std::uint8_t count) { return count == 255 ? count : static_cast<std::uint8_t>(count + 1); }

Grid<Counts> empty_grid(const std::vector<SeenPoints>& seen_map, const FreeSpaceParams& params) {
  bool any = false;
  Point2 low = Point2::Zero();
  Point2 high = Point2::Zero();
  const auto include = [&](const Point2& p) {
    low = any ? low.cwiseMin(p) : p;
    high = any ? high.cwiseMax(p) : p;
    any = true;
  };
  for (const SeenPoints& seen : seen_map) {
    include(seen.origin);
    for (const OrientedPoint& point : seen.points) {
      include(point.p);
    }
  }
  const Point2 cells = (high - low) / params.resolution_m + Point2::Constant(4.0);
  if (!any || !cells.allFinite() || cells.x() * cells.y() > static_cast<double>(params.max_cells)) {
    return {};
  }
  return {{low - Point2::Constant(2.0 * params.resolution_m), params.resolution_m},
          static_cast<int>(std::ceil(cells.x())),
          static_cast<int>(std::ceil(cells.y()))};
}

/// Calls visit(p) along the beam every `step_m` from `begin_m` to `end_m`, until it says true.
template <class Visit>
bool along(const Point2& from, const Point2& direction, double begin_m, double end_m, double step_m,
           const Visit& visit) {
  for (double at_m = begin_m; at_m < end_m; at_m += step_m) {
    if (visit(Point2(from + at_m * direction))) {
      return true;
    }
  }
  return false;
}

void count(const SeenPoints& seen, const FreeSpaceParams& params, Grid<Counts>& grid) {
  const double step_m = 0.7 * params.resolution_m;
  for (const OrientedPoint& point : seen.points) {
    const Point2 beam = point.p - seen.origin;
    const double range_m = beam.norm();
    Counts& hit = grid[grid.frame().cell_of(point.p)];
    hit.points = one_more(hit.points);
    if (range_m <= params.end_margin_m) {
      continue;
    }
    CellIndex last{-1, -1};
    along(seen.origin, beam / range_m, 0.0, std::min(range_m - params.end_margin_m, params.max_range_m), step_m,
          [&](const Point2& p) {
            const CellIndex cell = grid.frame().cell_of(p);
            if (cell != last) {
              grid[cell].beams = one_more(grid[cell].beams);
              last = cell;
            }
            return false;
          });
  }
}

FreeSpace::State state_of(const Grid<Counts>& counts, CellIndex cell, const FreeSpaceParams& params) {
  const Counts& here = counts[cell];
  if (here.points >= params.min_points && here.points >= params.solid_ratio * (here.points + here.beams)) {
    return FreeSpace::State::kSolid;
  }
  if (here.beams < params.min_beams) {
    return FreeSpace::State::kUnknown;
  }
  for (int k = 0; k < 9; ++k) {
    if (counts[{cell.i + k % 3 - 1, cell.j + k / 3 - 1}].points > 0) {
      return FreeSpace::State::kPassed;
    }
  }
  return FreeSpace::State::kFree;
}

}  // namespace

SeenPoints seen_points(const LaserScan& scan, const NormalParams& params) {
  return {scan.base_T_laser.translation(), oriented_points(scan, params)};
}

SeenPoints transform(const Pose2& a_T_b, const SeenPoints& seen_b) {
  SeenPoints seen_a{a_T_b * seen_b.origin, seen_b.points};
  for (OrientedPoint& point : seen_a.points) {
    point = transform(a_T_b, point);
  }
  return seen_a;
}

FreeSpace::FreeSpace(const std::vector<SeenPoints>& seen_map, const FreeSpaceParams& params) {
  Grid<Counts> counts = empty_grid(seen_map, params);
  if (counts.empty()) {
    return;
  }
  for (const SeenPoints& seen : seen_map) {
    count(seen, params, counts);
  }
  states_ = Grid<State>(counts.frame(), counts.width(), counts.height(), State::kUnknown);
  for (int j = 1; j + 1 < counts.height(); ++j) {
    for (int i = 1; i + 1 < counts.width(); ++i) {
      states_[{i, j}] = state_of(counts, {i, j}, params);
    }
  }
}

Agreement agreement_of(const LikelihoodPyramid& map, const FreeSpace& free_space,
                       const std::vector<SeenPoints>& seen_base, const Pose2& map_T_base,
                       const AgreementParams& params) {
  std::size_t beams = 0;
  std::size_t through = 0;
  std::size_t in_free = 0;
  for (const SeenPoints& seen : seen_base) {
    const Point2 origin = map_T_base * seen.origin;
    for (const OrientedPoint& point : thin_out(seen.points, params.max_beams)) {
      const Point2 end = map_T_base * point.p;
      const double range_m = (end - origin).norm();
      const Point2 direction = (end - origin) / std::max(range_m, 1e-6);
      // A surface that stops the beam faces it.
      const int facing = map.direction_of(std::atan2(-direction.y(), -direction.x()));
      const bool crossed = along(
          origin, direction, params.near_m, std::min(range_m - params.end_margin_m, params.max_range_m), params.step_m,
          [&](const Point2& p) { return free_space.is_solid(p) && map.value(p, facing) >= params.solid; });
      ++beams;
      through += crossed ? 1 : 0;
      in_free += !crossed && free_space.is_free(end) ? 1 : 0;
    }
  }
  const double total = std::max<double>(1.0, static_cast<double>(beams));
  return {static_cast<double>(through) / total, static_cast<double>(in_free) / total};
}

Fit fit_of(const LikelihoodPyramid& map, const FreeSpace& free_space, const std::vector<OrientedPoint>& points_base,
           const Pose2& map_T_base) {
  constexpr double kFull = 255.0;
  double all = 0.0;
  double standing = 0.0;
  std::size_t count = 0;
  for (const OrientedPoint& point_base : points_base) {
    const OrientedPoint point = transform(map_T_base, point_base);
    const int direction = map.direction_of(std::atan2(point.normal.y(), point.normal.x()));
    const double likelihood = map.value(point.p, direction) / kFull;
    all += likelihood;
    if (!free_space.is_free(point.p)) {
      standing += likelihood;
      ++count;
    }
  }
  const auto mean = [](double sum, std::size_t n) { return n == 0 ? 0.0 : sum / static_cast<double>(n); };
  return {mean(all, points_base.size()), mean(standing, count)};
}

}  // namespace seeker::slam
