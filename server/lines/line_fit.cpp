#include "server/lines/line_fit.hpp"

#include "common/core/angle.hpp"

namespace seeker::lines {

double LineFit::alpha_rad() const {
  const double alpha = std::atan2(normal.y(), normal.x());
  return alpha <= -kPi ? kPi : alpha;
}

void describe_line(const LineFit& fit, const Point2& first, const Point2& last, Line& line) {
  line.r_m = fit.r_m;
  line.alpha_rad = fit.alpha_rad();
  line.start = first - fit.distance_m(first.x(), first.y()) * fit.normal;
  line.end = last - fit.distance_m(last.x(), last.y()) * fit.normal;
  line.length_m = (line.end - line.start).norm();
  line.rms_m = std::sqrt(fit.mean_square_m2);
  line.slope.reset();
  line.intercept_m.reset();
  // Steeper lines than a million to one are vertical.
  constexpr double kVertical = 1e-6;
  if (std::abs(fit.normal.y()) > kVertical) {
    line.slope = -fit.normal.x() / fit.normal.y();
    line.intercept_m = fit.r_m / fit.normal.y();
  }
}

}  // namespace seeker::lines
