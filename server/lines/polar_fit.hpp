/// \file
/// The weighted line fit of spec S5.5 as printed: point by point, with its gradients.
#pragma once

#include <span>

#include "server/lines/line.hpp"
#include "server/lines/line_fit.hpp"

namespace seeker::lines {

/// One return of a scan in polar coordinates of the frame `laser`.
struct PolarPoint {
  double range_m = 0.0;
  double angle_rad = 0.0;
  double weight = 1.0;   ///< q_c of the scanner; 1 where it has none
  double sigma_m = 0.0;  ///< standard deviation of the range

  [[nodiscard]] Point2 cartesian() const { return {range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)}; }
};

/// Derivative of (r, alpha) by one coordinate of one point.
struct LineGradient {
  double r = 0.0;
  double alpha = 0.0;
};

[[nodiscard]] Moments moments_of(std::span<const PolarPoint> points);

/// d(r, alpha) / d rho_i and d(r, alpha) / d theta_i, eqs before (5). `fit` must be of these points.
[[nodiscard]] LineGradient range_gradient(std::span<const PolarPoint> points, const LineFit& fit, std::size_t i);
[[nodiscard]] LineGradient bearing_gradient(std::span<const PolarPoint> points, const LineFit& fit, std::size_t i);

/// Covariance of (r, alpha), eqs (4)-(7), with independent errors of ranges and, unless 0, bearings.
[[nodiscard]] Matrix2 polar_covariance(std::span<const PolarPoint> points, const LineFit& fit,
                                       double bearing_sigma_rad = 0.0);

/// D of eq (12) between two lines. Near r = 0 a line may have either sign of its normal: the signs are unified first.
[[nodiscard]] double mahalanobis_distance(const Line& a, const Line& b);

}  // namespace seeker::lines
