// Which returns at a corner are of which wall, and which may be of either.
#include <algorithm>
#include <cmath>

#include "server/lines/fast_extractor.hpp"

namespace seeker::lines {

double FastExtractor::cosine_of(const LineFit& fit, int i) const {
  return std::max(std::abs(fit.normal.dot(point(i))) / static_cast<double>(range_[at(i)]), kMinCosine);
}

double FastExtractor::range_residual2(const LineFit& fit, int i) const {
  const double residual = (fit.normal.dot(point(i)) - fit.r_m) / cosine_of(fit, i);
  return residual * residual;
}

void FastExtractor::move_corner(Piece& from, Piece& to, int i) {
  Moments sums;
  sums.add(point(i).x(), point(i).y(), static_cast<double>(weight_[at(i)]));
  from.sums = from.sums - sums;
  to.sums = to.sums + sums;
  const int one = weight_[at(i)] > 0.0F ? 1 : 0;
  from.points -= one;
  to.points += one;
}

bool FastExtractor::meet_in_corner(const Piece& a, const Piece& b) const {
  const bool neighbours = a.last + 1 == b.first && !breaks_before(b.first);  // a door is no corner
  return neighbours && a.points >= kMinPiece && b.points >= kMinPiece;
}

bool FastExtractor::settle_corner(Piece& a, Piece& b) {
  if (!meet_in_corner(a, b)) {
    return false;
  }
  const int corner = b.first;
  while (a.points >= kMinPiece && range_residual2(b.fit, a.last) < range_residual2(a.fit, a.last)) {
    move_corner(a, b, a.last--);
    --b.first;
  }
  while (b.first >= corner && b.points >= kMinPiece &&
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
    // The second time with lines that are not distorted by each other's points any more.
    if (settle_corner(merged_[i], merged_[i + 1])) {
      settle_corner(merged_[i], merged_[i + 1]);
    }
  }
}

/// How many returns at an end of a line may as well be of the wall that meets it there. Told by where they are on their
/// own line and not by their own distances from that wall, which would choose those whose noise points there.
int FastExtractor::doubtful_at_corner(const Piece& piece, const LineFit& other, bool at_end) const {
  const int most = (piece.last - piece.first) / 2;
  int count = 0;
  while (count < most) {
    const int i = at_end ? piece.last - count : piece.first + count;
    const Point2 on_line = point(i) - piece.fit.distance_m(point(i).x(), point(i).y()) * piece.fit.normal;
    const double sigma_m = noise_.sigma_m(static_cast<double>(range_[at(i)])) * cosine_of(other, i);
    if (std::abs(other.distance_m(on_line.x(), on_line.y())) > params_.corner_sigmas * sigma_m) {
      break;
    }
    ++count;
  }
  return count;
}

void FastExtractor::doubt_corners() {
  for (std::size_t k = 0; k + 1 < merged_.size(); ++k) {
    Piece& a = merged_[k];
    Piece& b = merged_[k + 1];
    if (meet_in_corner(a, b)) {
      a.doubtful_last = doubtful_at_corner(a, b.fit, true);
      b.doubtful_first = doubtful_at_corner(b, a.fit, false);
    }
  }
}

}  // namespace seeker::lines
