#include "server/lines/split_extractors.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "server/lines/point_row.hpp"

namespace seeker::lines {
namespace {

/// A run of points, ends included.
struct Run {
  std::size_t first = 0;
  std::size_t last = 0;
};

Indices indices_of(const Run& run) {
  Indices indices(run.last - run.first + 1);
  std::iota(indices.begin(), indices.end(), run.first);
  return indices;
}

/// The point of a run that is farthest from a line.
struct Farthest {
  std::size_t point = 0;
  double distance_m = 0.0;
};

Farthest farthest_from(const PointRow& row, const Run& run, const Point2& normal, double r_m) {
  Farthest farthest{.point = run.first};
  for (std::size_t i = run.first; i <= run.last; ++i) {
    const double distance = std::abs(normal.dot(row.points[i]) - r_m);
    if (distance > farthest.distance_m) {
      farthest = {i, distance};
    }
  }
  return farthest;
}

Farthest farthest_from_fit(const PointRow& row, const Run& run) {
  const LineFit fit = fit_points(row, indices_of(run));
  return farthest_from(row, run, fit.normal, fit.r_m);
}

Farthest farthest_from_chord(const PointRow& row, const Run& run) {
  const Point2 along = (row.points[run.last] - row.points[run.first]).stableNormalized();
  const Point2 normal(-along.y(), along.x());
  return farthest_from(row, run, normal, normal.dot(row.points[run.first]));
}

using FindFarthest = std::function<Farthest(const PointRow&, const Run&)>;

std::vector<Run> split_runs(const PointRow& row, const SplitParams& params, const FindFarthest& find) {
  std::vector<Run> stack;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= row.size(); ++i) {
    if (i == row.size() || row.gap_m(i) > params.gap_m) {
      stack.push_back({first, i - 1});
      first = i;
    }
  }
  std::reverse(stack.begin(), stack.end());
  std::vector<Run> runs;
  while (!stack.empty()) {
    const Run run = stack.back();
    stack.pop_back();
    const Farthest corner = run.last - run.first < 2 ? Farthest{} : find(row, run);
    if (corner.distance_m <= params.split_m) {
      runs.push_back(run);
      continue;
    }
    const std::size_t split = std::clamp(corner.point, run.first + 1, run.last - 1);
    stack.push_back({split + 1, run.last});
    stack.push_back({run.first, split});
  }
  return runs;
}

std::vector<Run> merge_runs(const PointRow& row, const SplitParams& params, const std::vector<Run>& runs) {
  std::vector<Run> merged;
  for (const Run& run : runs) {
    merged.push_back(run);
    while (merged.size() > 1) {
      const Run both{merged[merged.size() - 2].first, merged.back().last};
      const double gap_m = (row.points[merged.back().first] - row.points[merged[merged.size() - 2].last]).norm();
      if (gap_m > params.merge_gap_m || farthest_from_fit(row, both).distance_m > params.split_m) {
        break;
      }
      merged.pop_back();
      merged.back() = both;
    }
  }
  return merged;
}

ScanLines finish(const LaserScan& scan, const PointRow& row, const SplitParams& params, const std::vector<Run>& runs) {
  std::vector<Indices> lines;
  for (const Run& run : runs) {
    const double length_m = (row.points[run.last] - row.points[run.first]).norm();
    const auto points = static_cast<int>(run.last - run.first + 1);
    if (points >= std::max(params.min_points, 2) && length_m >= std::max(params.min_length_m, 1e-3)) {
      lines.push_back(indices_of(run));
    }
  }
  return build_lines(scan, row, std::move(lines), params.bearing_sigma_rad);
}

}  // namespace

ScanLines SplitAndMerge::extract(const LaserScan& scan) const {
  const PointRow row = point_row(scan, params_.noise);
  return finish(scan, row, params_, merge_runs(row, params_, split_runs(row, params_, farthest_from_fit)));
}

ScanLines Iepf::extract(const LaserScan& scan) const {
  const PointRow row = point_row(scan, params_.noise);
  return finish(scan, row, params_, split_runs(row, params_, farthest_from_chord));
}

}  // namespace seeker::lines
