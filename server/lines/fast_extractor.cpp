#include "server/lines/fast_extractor.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/assert.hpp"

namespace seeker::lines {
namespace {

/// kMinCosine where the line itself is uncertain.
constexpr double kMinCosineOfFit = 0.3;

using Array = Eigen::Map<const Eigen::ArrayXf>;

Array run(const std::vector<float>& values, int first, int last) {
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
    sums.add(static_cast<double>(x_[i]), static_cast<double>(y_[i]), static_cast<double>(weight_[i]));
    sums_[i + 1] = sums;
  }
  max_variance_m2_ = 0.0;
  if (n > 0) {
    const auto last = static_cast<int>(n) - 1;
    const auto floor2 = static_cast<float>(noise_.floor_m * noise_.floor_m);
    const auto slope2 = static_cast<float>(noise_.slope * noise_.slope);
    Eigen::Map<Eigen::ArrayXf>(variance_.data(), last + 1) = floor2 * run(range_, 0, last).square().inverse() + slope2;
    max_variance_m2_ = noise_.variance_m2(static_cast<double>(run(range_, 0, last).maxCoeff()));
  }
}

Point2 FastExtractor::point(int i) const { return {static_cast<double>(x_[at(i)]), static_cast<double>(y_[at(i)])}; }

FastExtractor::Piece FastExtractor::piece(int first, int last) const {
  Piece p{.first = first,
          .last = last,
          .points = last - first + 1,
          .sums = sums_[at(last + 1)] - sums_[at(first)],
          .across_m2 = 0.0,
          .fit = {}};
  if (p.points >= kMinPiece) {
    p.fit = fit_line(p.sums);
    p.across_m2 = p.fit.across_m2;
  } else if (p.points > 2) {
    p.across_m2 = across_of(p.sums);
  }
  return p;
}

double FastExtractor::mean_variance(const LineFit& fit, int first, int last) const {
  // With beta = theta - alpha the variance across the line is floor^2 cos^2(beta) + slope^2 r^2, and the sum of
  // cos 2 beta over n evenly spaced beams is cos(beta_1 + beta_n) sin(n step) / sin(step).
  const std::size_t a = rank_in_circle(first);
  const std::size_t b = rank_in_circle(last);
  const Point2 u(static_cast<double>(cos_[a]), static_cast<double>(sin_[a]));
  const Point2 v(static_cast<double>(cos_[b]), static_cast<double>(sin_[b]));
  const double cos_1 = fit.normal.dot(u);
  const double cos_n = fit.normal.dot(v);
  const double sin_1 = fit.tangent().dot(u);
  const double sin_n = fit.tangent().dot(v);
  const double sin_turn = sin_n * cos_1 - cos_n * sin_1;
  const double cos_turn = cos_n * cos_1 + sin_n * sin_1;
  const double beams = rank_[at(last)] - rank_[at(first)] + 1;
  const double sum = (cos_1 * cos_n - sin_1 * sin_n) * (sin_turn * cos_step_ / sin_step_ + cos_turn);
  const double cosine2 = 0.5 + 0.5 * std::clamp(sum / beams, -1.0, 1.0);
  return noise_.floor_m * noise_.floor_m * (cosine2 + kMinCosineOfFit * kMinCosineOfFit) +
         noise_.slope * noise_.slope * fit.r_m * fit.r_m;
}

bool FastExtractor::is_near(const LineFit& fit, int first, int last, double sigmas) const {
  const Eigen::Vector2f normal = fit.normal.cast<float>();
  const auto r = static_cast<float>(fit.r_m);
  const auto k2 = static_cast<float>(sigmas * sigmas);
  const double slack = params_.straightness_m * params_.straightness_m +
                       kMinCosineOfFit * kMinCosineOfFit * noise_.floor_m * noise_.floor_m;
  const auto across = normal.x() * run(x_, first, last) + normal.y() * run(y_, first, last);
  const auto excess = (across - r).square() - k2 * run(variance_, first, last) * across.square();
  return excess.maxCoeff() <= k2 * static_cast<float>(slack);
}

bool FastExtractor::is_one_line(double across_m2, double parts_m2, double w, double points, double variance_m2) const {
  return (across_m2 - parts_m2) / w <=
         params_.split_chi2 * variance_m2 / points + params_.straightness_m * params_.straightness_m;
}

bool FastExtractor::is_line(const Piece& whole) const {
  // The mean square has the relative standard deviation sqrt(2 / n). First without looking at the points.
  const double n = whole.points;
  const double straightness2 = params_.straightness_m * params_.straightness_m;
  const double factor = 1.0 + params_.excess_sigmas * std::sqrt(2.0 / n);
  if (whole.fit.mean_square_m2 > ((1.0 + kMinCosineOfFit) * max_variance_m2_ + straightness2) * factor ||
      !is_near(whole.fit, whole.first, whole.last, params_.split_sigmas)) {
    return false;
  }
  const double variance = mean_variance(whole.fit, whole.first, whole.last);
  if (whole.fit.mean_square_m2 > (variance + straightness2) * factor) {
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
    const double parts = across_of(before) + across_of(whole.sums - before);
    if (!is_one_line(whole.across_m2, parts, whole.sums.w, n, variance)) {
      return false;
    }
  }
  return true;
}

int FastExtractor::farthest_from_chord(int first, int last) const {
  const float dx = x_[at(last)] - x_[at(first)];
  const float dy = y_[at(last)] - y_[at(first)];
  const auto aside = (dx * (run(y_, first, last) - y_[at(first)]) - dy * (run(x_, first, last) - x_[at(first)])).abs();
  const float farthest = aside.maxCoeff();
  for (int i = 1; i < last - first; ++i) {
    if (aside.coeff(i) >= farthest) {
      return first + i;
    }
  }
  return (first + last) / 2;
}

void FastExtractor::split(int first, int last) {
  stack_.clear();
  stack_.emplace_back(first, last);
  while (!stack_.empty()) {
    const auto [a, b] = stack_.back();
    stack_.pop_back();
    const Piece whole = piece(a, b);
    if (whole.points < kMinPiece || is_line(whole)) {
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
  if (count - start_ > 1) {
    const Eigen::Index n = count - start_ - 1;
    const auto x = run(x_, start_, count - 1);
    const auto y = run(y_, start_, count - 1);
    gap2_m2_ = (x.tail(n) - x.head(n)).square() + (y.tail(n) - y.head(n)).square();
  }
  // Most neighbours are neither far apart nor is a beam missing between them.
  const auto gap2 = static_cast<float>(params_.max_gap_m * params_.max_gap_m);
  for (int i = start_ + 1; i < count; ++i) {
    const bool close = gap2_m2_[i - start_ - 1] <= gap2 && rank_[at(i)] - rank_[at(i - 1)] == 1;
    if (!close && breaks_before(i)) {
      split(first, i - 1);
      first = i;
    }
  }
  if (first < count) {
    split(first, count - 1);
  }
}

bool FastExtractor::absorb(Piece& piece, const Piece& next) {
  const bool neighbours = next.first == piece.last + 1 && !breaks_before(next.first);
  if (!neighbours && (point(next.first) - point(piece.last)).norm() > params_.max_merge_gap_m) {
    return false;
  }
  const Moments sums = piece.sums + next.sums;
  const int points = piece.points + next.points;
  const double parts = piece.across_m2 + next.across_m2;
  const double across = across_of(sums);
  // First with more noise than any return has, which needs no fit.
  if (!is_one_line(across, parts, sums.w, points, (1.0 + kMinCosineOfFit * kMinCosineOfFit) * max_variance_m2_)) {
    return false;
  }
  const LineFit fit = fit_line(sums);
  if (!is_one_line(across, parts, sums.w, points, mean_variance(fit, piece.first, next.last)) ||
      !is_near(fit, piece.first, piece.last, params_.merge_sigmas) ||
      !is_near(fit, next.first, next.last, params_.merge_sigmas)) {
    return false;
  }
  for (int i = piece.last + 1; i < next.first; ++i) {
    // In the place of a neighbour and without weight it does no harm.
    weight_[at(i)] = 0.0F;
    x_[at(i)] = x_[at(piece.last)];
    y_[at(i)] = y_[at(piece.last)];
  }
  piece = {piece.first, next.last, points, sums, across, fit};
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

std::size_t FastExtractor::rank_in_circle(int i) const {
  const auto rank = static_cast<std::size_t>(rank_[at(i)]);
  return rank < beams_ ? rank : rank - beams_;
}

std::size_t FastExtractor::beam_of(int i) const {
  const std::size_t rank = rank_in_circle(i);
  return clockwise_ ? beams_ - 1 - rank : rank;
}

NoiseSums FastExtractor::noise_of(const Piece& piece) {
  const auto x = run(x_, piece.first, piece.last);
  const auto y = run(y_, piece.first, piece.last);
  const auto weight = run(weight_, piece.first, piece.last);
  const Eigen::Vector2f normal = piece.fit.normal.cast<float>();
  const auto middle = static_cast<float>(piece.fit.tangent().dot(piece.fit.mean));
  const auto bearing2 = static_cast<float>(params_.bearing_sigma_rad * params_.bearing_sigma_rad);
  const auto slack = static_cast<float>(kMinCosine * kMinCosine * noise_.floor_m * noise_.floor_m);
  along_ = normal.x() * y - normal.y() * x;
  weighted_ = weight * (run(variance_, piece.first, piece.last) * (normal.x() * x + normal.y() * y).square() +
                        bearing2 * along_.square() + slack);
  along_ -= middle;
  NoiseSums noise;
  noise.wv = static_cast<double>(weighted_.sum());
  const float doubt = 1.0F + static_cast<float>(params_.corner_doubt);
  weighted_.head(piece.doubtful_first) *= doubt;
  weighted_.tail(piece.doubtful_last) *= doubt;
  weighted_ *= weight;
  noise.w2v = static_cast<double>(weighted_.sum());
  weighted_ *= along_;
  noise.w2vs = static_cast<double>(weighted_.sum());
  noise.w2vss = static_cast<double>((weighted_ * along_).sum());
  return noise;
}

void FastExtractor::finish(const LaserScan& scan, const Piece& piece, Line& line) {
  const NoiseSums noise = noise_of(piece);
  line.covariance = line_covariance(piece.fit, piece.sums.w, noise);
  const double dof = std::max(1.0, piece.points - 2.0);
  scatters_.push_back({dof, piece.fit.across_m2 / noise.wv * (piece.points / dof)});
  describe_line(piece.fit, point(piece.first), point(piece.last), line);
  line.first_beam = beam_of(piece.first);
  line.last_beam = beam_of(piece.last);
  line.start_rad = scan.angle_rad(line.first_beam);
  line.end_rad = scan.angle_rad(line.last_beam);
  line.points = piece.points;
}

void FastExtractor::mark_beams(const Piece& piece, std::int32_t line, ScanLines& found) const {
  const std::size_t first = beam_of(clockwise_ ? piece.last : piece.first);
  const std::size_t last = beam_of(clockwise_ ? piece.first : piece.last);
  const auto beams = static_cast<std::size_t>(piece.points);
  // Without holes, outliers and the cut within it is one run of beams.
  if (last >= first && last - first + 1 == beams) {
    std::fill_n(found.line_of_beam.begin() + static_cast<std::ptrdiff_t>(first), beams, line);
    return;
  }
  for (int i = piece.first; i <= piece.last; ++i) {
    if (weight_[at(i)] > 0.0F) {
      found.line_of_beam[beam_of(i)] = line;
    }
  }
}

void FastExtractor::write(const LaserScan& scan, ScanLines& found) {
  const auto turn = static_cast<std::int32_t>(beams_);
  const auto beyond_cut = [&](const Piece& piece) { return rank_[at(piece.first)] >= turn; };
  std::rotate(merged_.begin(), std::find_if(merged_.begin(), merged_.end(), beyond_cut), merged_.end());
  scatters_.clear();
  constexpr double kShortest_m = 1e-3;
  const double min_length_m = std::max(params_.min_length_m, kShortest_m);
  for (const Piece& piece : merged_) {
    if (piece.points < std::max(params_.min_points, kMinPiece) ||
        (point(piece.last) - point(piece.first)).squaredNorm() < min_length_m * min_length_m) {
      continue;
    }
    mark_beams(piece, static_cast<std::int32_t>(found.lines.size()), found);
    finish(scan, piece, found.lines.emplace_back());
  }
  settle_noise(found);
}

void FastExtractor::extract(const LaserScan& scan, ScanLines& found) {
  SEEKER_ASSERT(scan.quality.empty() || scan.quality.size() == scan.ranges_m.size());
  SEEKER_ASSERT(std::isfinite(scan.angle_min_rad) && std::isfinite(scan.angle_step_rad));
  found.lines.clear();
  found.history.clear();
  found.line_of_beam.assign(scan.ranges_m.size(), kNoLine);
  use_geometry(scan);
  load(scan);
  estimator_.differences(range_, rank_, step_rad_, full_circle_ && even_seam_ ? static_cast<std::int32_t>(beams_) : 0,
                         squares_);
  noise_ = estimator_.estimate(range_, squares_, params_.noise);
  open_circle();
  sum_up();
  split_groups();
  merge_pieces();
  settle_corners();
  doubt_corners();
  write(scan, found);
  const Eigen::Map<const Eigen::ArrayXf> ranges(range_.data(), static_cast<Eigen::Index>(range_.size()));
  found.noise = noise_;
  found.range_sigma_m = noise_.sigma_m(range_.empty() ? 0.0 : static_cast<double>(ranges.mean()));
}

}  // namespace seeker::lines
