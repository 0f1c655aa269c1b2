#include "server/lines/polar_fit.hpp"

#include <limits>

#include <Eigen/LU>

#include "common/core/angle.hpp"

namespace seeker::lines {
namespace {

/// What all gradients of one fit share.
struct Shared {
  double w = 0.0;
  Point2 mean{0.0, 0.0};
  double num = 0.0;
  double den = 0.0;
  double g = 0.0;  ///< num^2 + den^2
};

Shared shared_of(const Moments& sums) {
  Shared s;
  s.w = sums.w;
  s.mean = Point2(sums.x, sums.y) / sums.w;
  s.num = -2.0 * (sums.xy - sums.w * s.mean.x() * s.mean.y());
  s.den = sums.yy - sums.w * s.mean.y() * s.mean.y() - (sums.xx - sums.w * s.mean.x() * s.mean.x());
  s.g = s.num * s.num + s.den * s.den;
  return s;
}

LineGradient range_gradient(const PolarPoint& p, const LineFit& fit, const Shared& s) {
  const double c = std::cos(p.angle_rad);
  const double d = std::sin(p.angle_rad);
  const double c2 = std::cos(2.0 * p.angle_rad);
  const double d2 = std::sin(2.0 * p.angle_rad);
  LineGradient gradient;
  gradient.alpha = p.weight / s.g *
                   (s.den * (s.mean.x() * d + s.mean.y() * c - p.range_m * d2) -
                    s.num * (s.mean.x() * c - s.mean.y() * d - p.range_m * c2));
  gradient.r = p.weight / s.w * fit.normal.dot(Point2(c, d)) + gradient.alpha * fit.tangent().dot(s.mean);
  return gradient;
}

LineGradient bearing_gradient(const PolarPoint& p, const LineFit& fit, const Shared& s) {
  const Point2 point = p.cartesian();
  const Point2 moved(-point.y(), point.x());
  const Point2 off = point - s.mean;
  const double dnum = -2.0 * p.weight * (off.y() * moved.x() + off.x() * moved.y());
  const double dden = 2.0 * p.weight * (off.y() * moved.y() - off.x() * moved.x());
  LineGradient gradient;
  gradient.alpha = 0.5 * (s.den * dnum - s.num * dden) / s.g;
  gradient.r = p.weight / s.w * fit.normal.dot(moved) + gradient.alpha * fit.tangent().dot(s.mean);
  return gradient;
}

void add(Matrix2& covariance, const LineGradient& gradient, double sigma) {
  const double variance = sigma * sigma;
  covariance(0, 0) += gradient.r * gradient.r * variance;
  covariance(0, 1) += gradient.r * gradient.alpha * variance;
  covariance(1, 0) = covariance(0, 1);
  covariance(1, 1) += gradient.alpha * gradient.alpha * variance;
}

}  // namespace

Moments moments_of(std::span<const PolarPoint> points) {
  Moments sums;
  for (const PolarPoint& p : points) {
    const Point2 point = p.cartesian();
    sums.add(point.x(), point.y(), p.weight);
  }
  return sums;
}

LineGradient range_gradient(std::span<const PolarPoint> points, const LineFit& fit, std::size_t i) {
  return range_gradient(points[i], fit, shared_of(moments_of(points)));
}

LineGradient bearing_gradient(std::span<const PolarPoint> points, const LineFit& fit, std::size_t i) {
  return bearing_gradient(points[i], fit, shared_of(moments_of(points)));
}

Matrix2 polar_covariance(std::span<const PolarPoint> points, const LineFit& fit, double bearing_sigma_rad) {
  const Shared s = shared_of(moments_of(points));
  Matrix2 covariance = Matrix2::Zero();
  if (s.g <= 0.0) {
    return covariance;
  }
  for (const PolarPoint& p : points) {
    add(covariance, range_gradient(p, fit, s), p.sigma_m);
    if (bearing_sigma_rad > 0.0) {
      add(covariance, bearing_gradient(p, fit, s), bearing_sigma_rad);
    }
  }
  return covariance;
}

double mahalanobis_distance(const Line& a, const Line& b) {
  double r = b.r_m;
  double alpha = b.alpha_rad;
  Matrix2 covariance = b.covariance;
  if (std::abs(wrap_angle(a.alpha_rad - alpha)) > kPi / 2.0) {
    r = -r;
    alpha += kPi;
    covariance(0, 1) = -covariance(0, 1);
    covariance(1, 0) = -covariance(1, 0);
  }
  const Point2 delta(a.r_m - r, wrap_angle(a.alpha_rad - alpha));
  covariance += a.covariance;
  if (!(covariance.determinant() > 0.0)) {
    return delta.isZero() ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return std::sqrt(std::max(0.0, delta.dot(covariance.inverse() * delta)));
}

}  // namespace seeker::lines
