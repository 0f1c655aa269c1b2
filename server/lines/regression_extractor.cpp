#include "server/lines/regression_extractor.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "common/core/angle.hpp"
#include "server/lines/point_row.hpp"
#include "server/lines/polar_fit.hpp"

namespace seeker::lines {
namespace {

/// Points first..last of a row, ends included.
struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;

  [[nodiscard]] std::size_t size() const { return last - first + 1; }
};

/// One scan on its way through the steps.
class Regression {
 public:
  Regression(const LaserScan& scan, const RegressionParams& params)
      : scan_(scan),
        params_(params),
        row_(point_row(scan, params.noise, {.min_m = params.min_range_m, .max_m = params.max_range_m})) {}

  [[nodiscard]] ScanLines run() {
    split_groups();
    for (const Stretch& group : groups_) {
      find_runs(group);
    }
    merge_runs();
    cut_overlaps();
    grow_runs();
    return build();
  }

 private:
  [[nodiscard]] double gap_limit_m(std::size_t i, double least_m) const {
    const double range_m = std::min(row_.polar[i].range_m, row_.polar[i - 1].range_m);
    return std::max(least_m, params_.max_gap_spacings * range_m * std::abs(scan_.angle_step_rad));
  }

  [[nodiscard]] int missing_before(std::size_t i) const {
    const double turn_rad = wrap_angle(row_.polar[i].angle_rad - row_.polar[i - 1].angle_rad);
    return static_cast<int>(std::lround(std::abs(turn_rad / scan_.angle_step_rad))) - 1;
  }

  void split_groups() {
    std::size_t first = 0;
    for (std::size_t i = 1; i <= row_.size(); ++i) {
      const bool ends = i == row_.size() || row_.gap_m(i) > gap_limit_m(i, params_.max_gap_m) ||
                        missing_before(i) > params_.max_missing_beams;
      if (!ends) {
        continue;
      }
      if (static_cast<int>(i - first) >= params_.min_group) {
        groups_.push_back({first, i - 1});
      }
      first = i;
    }
  }

  [[nodiscard]] Line fit(const Stretch& stretch) const {
    const auto points = std::span(row_.polar).subspan(stretch.first, stretch.size());
    const LineFit fit = fit_line(moments_of(points));
    Line line;
    line.r_m = fit.r_m;
    line.alpha_rad = fit.alpha_rad();
    line.covariance = polar_covariance(points, fit, params_.bearing_sigma_rad);
    return line;
  }

  /// Maximal runs of windows of a group with a fidelity below the limit; each run holds the points of its windows.
  void find_runs(const Stretch& group) {
    const std::size_t n = std::min(group.size(), static_cast<std::size_t>(params_.window_points));
    std::vector<Line> windows;
    for (std::size_t first = group.first; first + n - 1 <= group.last; ++first) {
      windows.push_back(fit({first, first + n - 1}));
    }
    std::vector<double> apart(windows.size() + 1, 0.0);  // entry k lies between the windows k - 1 and k
    for (std::size_t k = 1; k < windows.size(); ++k) {
      apart[k] = std::pow(mahalanobis_distance(windows[k - 1], windows[k]), 2);
    }
    if (windows.size() > 1) {
      // The first and the last window have one neighbour, which counts twice.
      apart.front() = apart[1];
      apart.back() = apart[windows.size() - 1];
    }
    bool open = false;
    for (std::size_t k = 0; k < windows.size(); ++k) {
      const bool faithful = apart[k] + apart[k + 1] < params_.max_fidelity;
      const std::size_t last = group.first + k + n - 1;
      if (faithful && open) {
        runs_.back().last = last;
      } else if (faithful) {
        runs_.push_back({group.first + k, last});
      }
      open = faithful;
    }
  }

  [[nodiscard]] bool is_adjacent(const Stretch& a, const Stretch& b) const {
    if (b.first <= a.last) {
      return true;
    }
    return (row_.points[b.first] - row_.points[a.last]).norm() <= gap_limit_m(b.first, params_.merge_gap_m);
  }

  void merge_runs() {
    std::vector<Stretch> merged;
    for (const Stretch& run : runs_) {
      merged.push_back(run);
      while (merged.size() > 1) {
        const Stretch& a = merged[merged.size() - 2];
        const Stretch& b = merged.back();
        if (!is_adjacent(a, b) || std::pow(mahalanobis_distance(fit(a), fit(b)), 2) >= params_.merge_chi2) {
          break;
        }
        const Stretch both{a.first, b.last};
        merged.pop_back();
        merged.back() = both;
      }
    }
    runs_ = std::move(merged);
  }

  /// Divides the points that two neighbours share at the bearing of the point in which their lines meet.
  void cut_overlaps() {
    for (std::size_t k = 1; k < runs_.size(); ++k) {
      Stretch& a = runs_[k - 1];
      Stretch& b = runs_[k];
      if (b.first > a.last) {
        continue;
      }
      const std::size_t cut = cut_between(a, b);
      a.last = std::max(cut, a.first + 1) - 1;
      b.first = std::min(cut, b.last);
    }
    std::erase_if(runs_, [](const Stretch& run) { return run.last <= run.first; });
  }

  /// The first point of the second run.
  [[nodiscard]] std::size_t cut_between(const Stretch& a, const Stretch& b) const {
    constexpr double kParallel = 1e-3;
    const std::size_t middle = (b.first + a.last + 1) / 2;
    const LineFit one = fit_line(moments_of(std::span(row_.polar).subspan(a.first, a.size())));
    const LineFit two = fit_line(moments_of(std::span(row_.polar).subspan(b.first, b.size())));
    const double cross = one.normal.x() * two.normal.y() - one.normal.y() * two.normal.x();
    if (std::abs(cross) < kParallel) {
      return middle;
    }
    const Point2 corner = Point2(one.r_m * two.normal.y() - two.r_m * one.normal.y(),
                                 two.r_m * one.normal.x() - one.r_m * two.normal.x()) /
                          cross;
    const double bearing_rad = std::atan2(corner.y(), corner.x());
    for (std::size_t i = b.first; i <= a.last; ++i) {
      if (wrap_angle(row_.polar[i].angle_rad - bearing_rad) > 0.0) {
        return i;
      }
    }
    return a.last + 1;
  }

  [[nodiscard]] bool is_inlier(const LineFit& fit, std::size_t i) const {
    const double distance_m = std::abs(fit.distance_m(row_.points[i].x(), row_.points[i].y()));
    return distance_m <= params_.outlier_sigmas * row_.polar[i].sigma_m;
  }

  [[nodiscard]] const Stretch& group_of(std::size_t point) const {
    return *std::find_if(groups_.begin(), groups_.end(),
                         [&](const Stretch& group) { return group.first <= point && point <= group.last; });
  }

  /// A window that shows a corner ends a run some points before it: inliers up to the next run, or to the end of the
  /// group, belong to the line, too.
  void grow_runs() {
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      Stretch& run = runs_[k];
      const LineFit fit = fit_line(moments_of(std::span(row_.polar).subspan(run.first, run.size())));
      const std::size_t group_end = group_of(run.last).last + 1;
      const std::size_t end = k + 1 < runs_.size() ? std::min(runs_[k + 1].first, group_end) : group_end;
      while (run.last + 1 < end && is_inlier(fit, run.last + 1)) {
        ++run.last;
      }
      const std::size_t group_begin = group_of(run.first).first;
      const std::size_t begin = k > 0 ? std::max(runs_[k - 1].last + 1, group_begin) : group_begin;
      while (run.first > begin && is_inlier(fit, run.first - 1)) {
        --run.first;
      }
    }
  }

  /// Parts of a list of points between which there is a gap: no line goes on where its inliers end. Without this, a
  /// line across a corner would be held by the few points at which it crosses the two walls.
  [[nodiscard]] std::vector<Indices> split_at_gaps(const Indices& points) const {
    std::vector<Indices> parts;
    for (const std::size_t i : points) {
      const bool goes_on = !parts.empty() && (row_.points[i] - row_.points[parts.back().back()]).norm() <=
                                                 gap_limit_m(i, params_.merge_gap_m);
      if (!goes_on) {
        parts.emplace_back();
      }
      parts.back().push_back(i);
    }
    return parts;
  }

  /// The inliers of each run; points of a run without return in between are not in the row.
  [[nodiscard]] ScanLines build() const {
    std::vector<Indices> lines;
    for (const Stretch& run : runs_) {
      Indices all(run.size());
      std::iota(all.begin(), all.end(), run.first);
      const LineFit fit = fit_points(row_, all);
      Indices inliers;
      std::copy_if(all.begin(), all.end(), std::back_inserter(inliers),
                   [&](std::size_t i) { return is_inlier(fit, i); });
      for (Indices& part : split_at_gaps(inliers)) {
        const double length_m = (row_.points[part.back()] - row_.points[part.front()]).norm();
        if (static_cast<int>(part.size()) >= std::max(params_.min_points, 2) &&
            length_m >= std::max(params_.min_length_m, 1e-3)) {
          lines.push_back(std::move(part));
        }
      }
    }
    return build_lines(scan_, row_, std::move(lines), params_.bearing_sigma_rad);
  }

  const LaserScan& scan_;
  const RegressionParams& params_;
  PointRow row_;
  std::vector<Stretch> groups_;
  std::vector<Stretch> runs_;
};

}  // namespace

ScanLines RegressionExtractor::extract(const LaserScan& scan) const { return Regression(scan, params_).run(); }

}  // namespace seeker::lines
