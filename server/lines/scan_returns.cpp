// How a scan becomes a row of returns: geometry, groups, and where to open a full circle.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "server/lines/fast_extractor.hpp"
#include "server/lines/scan_circle.hpp"

namespace seeker::lines {
namespace {

/// Keeps quotients finite; no scanner has such beams.
constexpr double kSmallestStep = 1e-9;

}  // namespace

void FastExtractor::use_geometry(const LaserScan& scan) {
  const std::size_t n = scan.ranges_m.size();
  if (n == beams_ && scan.angle_min_rad == first_rad_ && scan.angle_step_rad == step_rad_) {
    return;
  }
  beams_ = n;
  first_rad_ = scan.angle_min_rad;
  step_rad_ = scan.angle_step_rad;
  clockwise_ = step_rad_ < 0.0;
  cos_.resize(n);
  sin_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double angle_rad = scan.angle_rad(clockwise_ ? n - 1 - k : k);
    cos_[k] = static_cast<float>(std::cos(angle_rad));
    sin_[k] = static_cast<float>(std::sin(angle_rad));
  }
  all_ranks_.resize(n);
  std::iota(all_ranks_.begin(), all_ranks_.end(), 0);
  const double step = std::abs(step_rad_);
  cos_step_ = std::cos(step);
  sin_step_ = std::max(std::sin(step), kSmallestStep);
  full_circle_ = circle_of(scan).closed;
  even_seam_ = circle_of(scan).even;
}

bool FastExtractor::load_all(const LaserScan& scan, float low, float high) {
  const auto n = static_cast<Eigen::Index>(scan.ranges_m.size());
  const Eigen::Map<const Eigen::ArrayXf> ranges(scan.ranges_m.data(), n);
  // What is not a number stays, and is not within the limits.
  if (n == 0 || !(ranges.minCoeff<Eigen::PropagateNaN>() >= low && ranges.maxCoeff<Eigen::PropagateNaN>() <= high)) {
    return false;
  }
  std::copy(scan.ranges_m.begin(), scan.ranges_m.end(), range_.begin());
  std::copy(all_ranks_.begin(), all_ranks_.end(), rank_.begin());
  Eigen::Map<Eigen::ArrayXf>(weight_.data(), n).setOnes();
  Eigen::Map<Eigen::ArrayXf>(x_.data(), n) = ranges * Eigen::Map<const Eigen::ArrayXf>(cos_.data(), n);
  Eigen::Map<Eigen::ArrayXf>(y_.data(), n) = ranges * Eigen::Map<const Eigen::ArrayXf>(sin_.data(), n);
  return true;
}

void FastExtractor::load(const LaserScan& scan) {
  const std::size_t n = scan.ranges_m.size();
  for (auto* values : {&x_, &y_, &weight_, &range_}) {
    values->resize(n);
  }
  rank_.resize(n);
  const auto low = static_cast<float>(std::max(scan.range_min_m, params_.min_range_m));
  double limit = scan.range_max_m > 0.0 ? scan.range_max_m : std::numeric_limits<float>::max();
  limit = params_.max_range_m > 0.0 ? std::min(limit, params_.max_range_m) : limit;
  const auto high = static_cast<float>(limit);
  const bool graded = !scan.quality.empty();
  if (!clockwise_ && !graded && load_all(scan, low, high)) {
    return;
  }
  std::size_t m = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t beam = clockwise_ ? n - 1 - k : k;
    const float range = scan.ranges_m[beam];
    const float weight = graded ? static_cast<float>(scan.quality[beam]) : 1.0F;
    range_[m] = range;
    rank_[m] = static_cast<std::int32_t>(k);
    x_[m] = range * cos_[k];
    y_[m] = range * sin_[k];
    weight_[m] = weight;
    m += (range >= low && range <= high && weight > 0.0F) ? 1U : 0U;
  }
  for (auto* values : {&x_, &y_, &weight_, &range_}) {
    values->resize(m);
  }
  rank_.resize(m);
}

bool FastExtractor::breaks_before(int i) const {
  const std::size_t b = at(i);
  const std::size_t a = b - 1;
  const int step = rank_[b] - rank_[a];
  if (step > params_.max_missing_beams + 1) {
    return true;
  }
  const double dx = static_cast<double>(x_[b] - x_[a]);
  const double dy = static_cast<double>(y_[b] - y_[a]);
  const double distance2 = dx * dx + dy * dy;
  if (distance2 <= params_.max_gap_m * params_.max_gap_m) {
    return false;
  }
  const double spacing = std::abs(step_rad_) * step * static_cast<double>(std::min(range_[a], range_[b]));
  const double gap = params_.max_gap_spacings * spacing;
  if (distance2 <= gap * gap) {
    return false;
  }
  const double limit = params_.in_line_sigmas * params_.in_line_sigmas;
  return static_cast<double>(squares_[a]) > limit * noise_.variance_m2(static_cast<double>(range_[a])) &&
         static_cast<double>(squares_[b]) > limit * noise_.variance_m2(static_cast<double>(range_[b]));
}

int FastExtractor::widest_gap(int count) const {
  int widest = 0;
  float width2 = 0.0F;
  for (int i = 1; i < count; ++i) {
    const float dx = x_[at(i)] - x_[at(i - 1)];
    const float dy = y_[at(i)] - y_[at(i - 1)];
    const float gap2 = dx * dx + dy * dy;
    if (gap2 > width2 && breaks_before(i)) {
      width2 = gap2;
      widest = i;
    }
  }
  if (widest == 0 && count > 0) {
    // No gap: walls all around. The farthest return is in a corner.
    widest = static_cast<int>(std::max_element(range_.begin(), range_.begin() + count) - range_.begin());
  }
  return widest;
}

void FastExtractor::open_circle() {
  start_ = 0;
  const auto count = static_cast<int>(x_.size());
  if (!full_circle_ || count == 0) {
    return;
  }
  start_ = widest_gap(count);
  const std::size_t head = at(start_);
  const auto repeat = [head](auto& values) {
    values.reserve(2 * values.size());
    values.insert(values.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(head));
  };
  repeat(x_);
  repeat(y_);
  repeat(weight_);
  repeat(range_);
  repeat(squares_);
  repeat(rank_);
  const auto turn = static_cast<std::int32_t>(beams_);
  for (std::size_t i = at(count); i < rank_.size(); ++i) {
    rank_[i] += turn;
  }
}

}  // namespace seeker::lines
