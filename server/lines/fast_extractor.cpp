#include "server/lines/fast_extractor.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/assert.hpp"

namespace seeker::lines {
namespace {

/// Beams that graze the wall at a smaller cosine are not believed to know it any better.
constexpr double kMinCosine = 0.05;
/// ... and here, where the line itself is uncertain, not any better than this.
constexpr double kMinCosineOfFit = 0.3;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

using Array = Eigen::Map<const Eigen::ArrayXd>;

Array run(const std::vector<double>& values, int first, int last) {
  return Array(values.data() + first, last - first + 1);
}

}  // namespace

void FastExtractor::sum_up() {
  const std::size_t n = x_.size();
  variance_.resize(n);
  sums_.resize(n + 1);
  Moments sums;
  sums_[0] = sums;
  for (std::size_t i = 0; i < n; ++i) {
    const double range = static_cast<double>(range_[i]);
    variance_[i] = noise_.variance_m2(range) / (range * range);
    sums.add(x_[i], y_[i], weight_[i]);
    sums_[i + 1] = sums;
  }
}

FastExtractor::Piece FastExtractor::piece(int first, int last) const {
  Piece p{.first = first,
          .last = last,
          .points = last - first + 1,
          .sums = sums_[at(last + 1)] - sums_[at(first)],
          .fit = {}};
  p.fit = fit_line(p.sums);
  return p;
}

double FastExtractor::mean_variance(const LineFit& fit, int first, int last) const {
  const auto across = fit.normal.x() * run(x_, first, last) + fit.normal.y() * run(y_, first, last);
  const double slack = kMinCosineOfFit * kMinCosineOfFit * noise_.floor_m * noise_.floor_m;
  return (run(variance_, first, last) * across.square()).mean() + slack;
}

bool FastExtractor::is_near(const LineFit& fit, int first, int last) const {
  const auto across = fit.normal.x() * run(x_, first, last) + fit.normal.y() * run(y_, first, last);
  const double slack = params_.straightness_m * params_.straightness_m +
                       kMinCosineOfFit * kMinCosineOfFit * noise_.floor_m * noise_.floor_m;
  const double k2 = params_.split_sigmas * params_.split_sigmas;
  const auto taken = (run(weight_, first, last) > 0.0).cast<double>();
  const auto excess =
      (across - fit.r_m).square() * taken - k2 * (run(variance_, first, last) * across.square() + slack);
  return excess.maxCoeff() <= 0.0;
}

bool FastExtractor::is_one_line(double across_m2, const Moments& a, const Moments& b, double points,
                                double variance_m2) const {
  const double gained_m2 = (across_m2 - across_of(a) - across_of(b)) / (a.w + b.w);
  return gained_m2 <= params_.bend_chi2 * variance_m2 / points + params_.straightness_m * params_.straightness_m;
}

bool FastExtractor::is_line(const Piece& whole) const {
  if (!is_near(whole.fit, whole.first, whole.last)) {
    return false;
  }
  // The mean square has the relative standard deviation sqrt(2 / n).
  const double n = whole.points;
  const double variance = mean_variance(whole.fit, whole.first, whole.last);
  const double straightness2 = params_.straightness_m * params_.straightness_m;
  if (whole.fit.mean_square_m2 > (variance + straightness2) * (1.0 + params_.excess_sigmas * std::sqrt(2.0 / n))) {
    return false;
  }
  constexpr int kMinHalf = 4;
  if (whole.points < 2 * kMinHalf) {
    return true;
  }
  // Too flat a corner to stand out from the noise at any point shows in the sum.
  for (const int quarter : {1, 2, 3}) {
    const int corner = whole.first + std::max(kMinHalf, quarter * whole.points / 4);
    const Moments before = sums_[at(corner)] - sums_[at(whole.first)];
    if (!is_one_line(whole.fit.across_m2, before, whole.sums - before, n, variance)) {
      return false;
    }
  }
  return true;
}

int FastExtractor::farthest_from_chord(int first, int last) const {
  const double dx = x_[at(last)] - x_[at(first)];
  const double dy = y_[at(last)] - y_[at(first)];
  int farthest = (first + last) / 2;
  double distance = 0.0;
  for (int i = first + 1; i < last; ++i) {
    const double d = std::abs(dx * (y_[at(i)] - y_[at(first)]) - dy * (x_[at(i)] - x_[at(first)]));
    if (d > distance) {
      distance = d;
      farthest = i;
    }
  }
  return farthest;
}

void FastExtractor::split(int first, int last) {
  stack_.clear();
  stack_.emplace_back(first, last);
  while (!stack_.empty()) {
    const auto [a, b] = stack_.back();
    stack_.pop_back();
    const Piece whole = piece(a, b);
    if (b - a < 2 || is_line(whole)) {
      pieces_.push_back(whole);
      continue;
    }
    const int corner = std::min(farthest_from_chord(a, b), b - 1);
    stack_.emplace_back(corner + 1, b);
    stack_.emplace_back(a, corner);
  }
}

void FastExtractor::split_groups() {
  pieces_.clear();
  const auto count = static_cast<int>(x_.size());
  int first = start_;
  for (int i = start_ + 1; i <= count; ++i) {
    if (i == count || breaks_before(i)) {
      split(first, i - 1);
      first = i;
    }
  }
}

bool FastExtractor::absorb(Piece& piece, const Piece& next) {
  const double dx = x_[at(next.first)] - x_[at(piece.last)];
  const double dy = y_[at(next.first)] - y_[at(piece.last)];
  const bool neighbours = next.first == piece.last + 1 && !breaks_before(next.first);
  if (!neighbours && dx * dx + dy * dy > params_.max_merge_gap_m * params_.max_merge_gap_m) {
    return false;
  }
  const Moments sums = piece.sums + next.sums;
  const LineFit fit = fit_line(sums);
  const int points = piece.points + next.points;
  const double variance = (piece.points * mean_variance(fit, piece.first, piece.last) +
                           next.points * mean_variance(fit, next.first, next.last)) /
                          points;
  if (!is_one_line(fit.across_m2, piece.sums, next.sums, points, variance) || !is_near(fit, piece.first, piece.last) ||
      !is_near(fit, next.first, next.last)) {
    return false;
  }
  for (int i = piece.last + 1; i < next.first; ++i) {
    weight_[at(i)] = 0.0;
  }
  piece = {piece.first, next.last, points, sums, fit};
  return true;
}

void FastExtractor::merge_pieces() {
  merged_.clear();
  for (const Piece& next : pieces_) {
    merged_.push_back(next);
    bool merging = true;
    while (merging && merged_.size() > 1) {
      const std::size_t n = merged_.size();
      merging = false;
      if (absorb(merged_[n - 2], merged_[n - 1])) {
        merged_.pop_back();
        merging = true;
      } else if (n > 2 && merged_[n - 2].points <= params_.max_outliers && absorb(merged_[n - 3], merged_[n - 1])) {
        merged_.resize(n - 2);
        merging = true;
      }
    }
  }
}

double FastExtractor::range_residual2(const LineFit& fit, int i) const {
  const double across = fit.normal.x() * x_[at(i)] + fit.normal.y() * y_[at(i)];
  const double cosine = std::max(std::abs(across) / static_cast<double>(range_[at(i)]), kMinCosine);
  const double residual = (across - fit.r_m) / cosine;
  return residual * residual;
}

void FastExtractor::move_corner(Piece& from, Piece& to, int point) {
  Moments sums;
  sums.add(x_[at(point)], y_[at(point)], weight_[at(point)]);
  from.sums = from.sums - sums;
  to.sums = to.sums + sums;
  const int one = weight_[at(point)] > 0.0 ? 1 : 0;
  from.points -= one;
  to.points += one;
}

bool FastExtractor::settle_corner(Piece& a, Piece& b) {
  constexpr int kMinPoints = 3;
  if (a.last + 1 != b.first || a.points <= kMinPoints || b.points <= kMinPoints) {
    return false;
  }
  const int corner = b.first;
  while (a.points > kMinPoints && range_residual2(b.fit, a.last) < range_residual2(a.fit, a.last)) {
    move_corner(a, b, a.last--);
    --b.first;
  }
  while (b.first >= corner && b.points > kMinPoints &&
         range_residual2(a.fit, b.first) < range_residual2(b.fit, b.first)) {
    move_corner(b, a, b.first++);
    ++a.last;
  }
  if (b.first == corner) {
    return false;
  }
  a.fit = fit_line(a.sums);
  b.fit = fit_line(b.sums);
  return true;
}

void FastExtractor::settle_corners() {
  for (std::size_t i = 0; i + 1 < merged_.size(); ++i) {
    // The second time with lines that no longer bend into each other.
    if (settle_corner(merged_[i], merged_[i + 1])) {
      settle_corner(merged_[i], merged_[i + 1]);
    }
  }
}

std::size_t FastExtractor::beam_of(int i) const {
  const std::size_t rank = static_cast<std::size_t>(rank_[at(i)]) % beams_;
  return clockwise_ ? beams_ - 1 - rank : rank;
}

Line FastExtractor::finish(const LaserScan& scan, const Piece& piece) const {
  const LineFit& fit = piece.fit;
  const Point2 tangent = fit.tangent();
  const double middle = tangent.dot(fit.mean);
  const double bearing2 = params_.bearing_sigma_rad * params_.bearing_sigma_rad;
  const double slack = kMinCosine * kMinCosine * noise_.floor_m * noise_.floor_m;
  NoiseSums noise;
  for (int i = piece.first; i <= piece.last; ++i) {
    const double across = fit.normal.x() * x_[at(i)] + fit.normal.y() * y_[at(i)];
    const double along = tangent.x() * x_[at(i)] + tangent.y() * y_[at(i)];
    const double variance = variance_[at(i)] * across * across + bearing2 * along * along + slack;
    const double w = weight_[at(i)];
    const double wv = w * variance;
    const double w2vs = w * wv * (along - middle);
    noise.wv += wv;
    noise.w2v += w * wv;
    noise.w2vs += w2vs;
    noise.w2vss += w2vs * (along - middle);
  }
  Line line;
  line.covariance = line_covariance(fit, piece.sums.w, noise);
  // A worse fit than the noise explains says that the wall or the noise is worse than believed.
  const double dof = std::max(1.0, piece.points - 2.0);
  const double excess = fit.across_m2 / noise.wv * (piece.points / dof);
  if (excess > 1.0 + params_.inflation_sigmas * std::sqrt(2.0 / dof)) {
    line.covariance *= excess;
  }
  describe_line(fit, {x_[at(piece.first)], y_[at(piece.first)]}, {x_[at(piece.last)], y_[at(piece.last)]}, line);
  line.first_beam = beam_of(piece.first);
  line.last_beam = beam_of(piece.last);
  line.start_rad = scan.angle_rad(line.first_beam);
  line.end_rad = scan.angle_rad(line.last_beam);
  line.points = piece.points;
  return line;
}

void FastExtractor::write(const LaserScan& scan, ScanLines& found) {
  const auto first_past_cut = std::find_if(merged_.begin(), merged_.end(), [this](const Piece& p) {
    return rank_[at(p.first)] >= static_cast<std::int32_t>(beams_);
  });
  std::rotate(merged_.begin(), first_past_cut, merged_.end());
  for (const Piece& piece : merged_) {
    const double dx = x_[at(piece.last)] - x_[at(piece.first)];
    const double dy = y_[at(piece.last)] - y_[at(piece.first)];
    const double least = std::max(params_.min_length_m, 1e-3);
    if (piece.points < std::max(params_.min_points, 3) || dx * dx + dy * dy < least * least) {
      continue;
    }
    const auto index = static_cast<std::int32_t>(found.lines.size());
    for (int i = piece.first; i <= piece.last; ++i) {
      if (weight_[at(i)] > 0.0) {
        found.line_of_beam[beam_of(i)] = index;
      }
    }
    found.lines.push_back(finish(scan, piece));
  }
}

void FastExtractor::extract(const LaserScan& scan, ScanLines& found) {
  SEEKER_ASSERT(scan.quality.empty() || scan.quality.size() == scan.ranges_m.size());
  SEEKER_ASSERT(std::isfinite(scan.angle_min_rad) && std::isfinite(scan.angle_step_rad));
  found.lines.clear();
  found.line_of_beam.assign(scan.ranges_m.size(), kNoLine);
  use_geometry(scan);
  load(scan);
  estimator_.differences(range_, rank_, step_rad_, squares_);
  noise_ = estimator_.estimate(range_, squares_, params_.noise);
  open_circle();
  sum_up();
  split_groups();
  merge_pieces();
  settle_corners();
  write(scan, found);
  const Eigen::Map<const Eigen::ArrayXf> ranges(range_.data(), static_cast<Eigen::Index>(range_.size()));
  found.range_sigma_m = noise_.sigma_m(range_.empty() ? 0.0 : static_cast<double>(ranges.mean()));
}

ScanLines FastExtractor::extract(const LaserScan& scan) {
  ScanLines found;
  extract(scan, found);
  return found;
}

}  // namespace seeker::lines
