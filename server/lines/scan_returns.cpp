// How a scan becomes a row of returns: geometry, groups, and where to open a full circle.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/angle.hpp"
#include "server/lines/fast_extractor.hpp"

namespace seeker::lines {
namespace {

/// The cut of a full circle is at most so many steps wide.
constexpr double kMaxSeamSteps = 3.5;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

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
    cos_[k] = std::cos(angle_rad);
    sin_[k] = std::sin(angle_rad);
  }
  const double step = std::abs(step_rad_);
  const double seam = kTwoPi - step * (static_cast<double>(n) - 1.0);
  full_circle_ = n > 2 && std::abs(seam) <= kMaxSeamSteps * step;
  constexpr double kEven = 0.02;
  even_seam_ = std::abs(seam - step) < kEven * step;
}

void FastExtractor::load(const LaserScan& scan) {
  const std::size_t n = scan.ranges_m.size();
  for (auto* values : {&x_, &y_, &weight_}) {
    values->resize(n);
  }
  range_.resize(n);
  rank_.resize(n);
  const auto low = static_cast<float>(std::max(scan.range_min_m, params_.min_range_m));
  double limit = scan.range_max_m > 0.0 ? scan.range_max_m : std::numeric_limits<float>::max();
  limit = params_.max_range_m > 0.0 ? std::min(limit, params_.max_range_m) : limit;
  const auto high = static_cast<float>(limit);
  const bool graded = !scan.quality.empty();
  std::size_t m = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t beam = clockwise_ ? n - 1 - k : k;
    const float range = scan.ranges_m[beam];
    const double weight = graded ? scan.quality[beam] : 1.0;
    range_[m] = range;
    rank_[m] = static_cast<std::int32_t>(k);
    x_[m] = static_cast<double>(range) * cos_[k];
    y_[m] = static_cast<double>(range) * sin_[k];
    weight_[m] = weight;
    m += (range >= low && range <= high && weight > 0.0) ? 1U : 0U;
  }
  for (auto* values : {&x_, &y_, &weight_}) {
    values->resize(m);
  }
  range_.resize(m);
  rank_.resize(m);
}

bool FastExtractor::breaks_before(int i) const {
  const std::size_t b = at(i);
  const std::size_t a = b - 1;
  const int step = rank_[b] - rank_[a];
  if (step > params_.max_missing_beams + 1) {
    return true;
  }
  const double dx = x_[b] - x_[a];
  const double dy = y_[b] - y_[a];
  const double spacing = std::abs(step_rad_) * step * static_cast<double>(std::min(range_[a], range_[b]));
  const double gap = std::max(params_.max_gap_m, params_.max_gap_spacings * spacing);
  if (dx * dx + dy * dy <= gap * gap) {
    return false;
  }
  const double limit = params_.in_line_sigmas * params_.in_line_sigmas;
  return static_cast<double>(squares_[a]) > limit * noise_.variance_m2(static_cast<double>(range_[a])) &&
         static_cast<double>(squares_[b]) > limit * noise_.variance_m2(static_cast<double>(range_[b]));
}

int FastExtractor::widest_gap(int count) const {
  int widest = 0;
  double width2 = 0.0;
  for (int i = 1; i < count; ++i) {
    const double dx = x_[at(i)] - x_[at(i - 1)];
    const double dy = y_[at(i)] - y_[at(i - 1)];
    const double gap2 = dx * dx + dy * dy;
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
  // The two entries that see over the cut.
  for (const std::size_t i : {at(count) - 1, at(count)}) {
    if (even_seam_ && i > 0 && i + 1 < rank_.size() && rank_[i + 1] - rank_[i - 1] == 2) {
      squares_[i] = NoiseEstimator::difference(range_[i - 1], range_[i], range_[i + 1], step_rad_);
    }
  }
}

}  // namespace seeker::lines
