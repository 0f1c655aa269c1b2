#include <gtest/gtest.h>
#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/lines/polar_fit.hpp"

namespace seeker::lines {
namespace {

/// Noisy points of a line with all weights different.
std::vector<PolarPoint> points_of_a_line(double r_m, double alpha_rad, std::uint64_t seed, double sigma_m = 0.02) {
  Rng rng(seed);
  std::vector<PolarPoint> points;
  for (int k = -10; k <= 14; ++k) {
    const double angle = alpha_rad + 0.05 * k;
    const double range = r_m / std::cos(angle - alpha_rad) + rng.normal(sigma_m);
    points.push_back({.range_m = range, .angle_rad = angle, .weight = rng.uniform(0.5, 2.0), .sigma_m = sigma_m});
  }
  return points;
}

/// The double angle 2 alpha by tan(2 alpha) = num / den.
struct DoubleAngle {
  double num = 0.0;
  double den = 0.0;
};

/// Num and Den from the double sums over pairs that the paper prints, spec S5.5, eqs (10) and (11).
DoubleAngle paired_double_angle(const std::vector<PolarPoint>& points) {
  double w = 0.0;
  for (const PolarPoint& p : points) {
    w += p.weight;
  }
  DoubleAngle sum;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PolarPoint& p = points[i];
    const double own = (p.weight - w) * p.weight * p.range_m * p.range_m / w;
    sum.num += own * std::sin(2.0 * p.angle_rad);
    sum.den += own * std::cos(2.0 * p.angle_rad);
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const PolarPoint& q = points[j];
      const double both = 2.0 / w * p.weight * q.weight * p.range_m * q.range_m;
      sum.num += both * std::sin(p.angle_rad + q.angle_rad);
      sum.den += both * std::cos(p.angle_rad + q.angle_rad);
    }
  }
  return sum;
}

struct Case {
  double r_m;
  double alpha_rad;
};

class LineFits : public ::testing::TestWithParam<Case> {
 protected:
  std::vector<PolarPoint> points_ = points_of_a_line(GetParam().r_m, GetParam().alpha_rad, 3);
};

TEST_P(LineFits, FindTheLine) {
  const LineFit fit = fit_line(moments_of(points_));
  EXPECT_NEAR(fit.r_m, GetParam().r_m, 0.03);
  EXPECT_NEAR(wrap_angle(fit.alpha_rad() - GetParam().alpha_rad), 0.0, 0.03);
  EXPECT_NEAR(fit.normal.norm(), 1.0, 1e-12);
}

TEST_P(LineFits, LeaveTheSmallestPossibleSquares) {
  const Moments sums = moments_of(points_);
  const LineFit fit = fit_line(sums);
  const auto squares = [&](double r_m, double alpha_rad) {
    double sum = 0.0;
    for (const PolarPoint& p : points_) {
      const double d = p.range_m * std::cos(p.angle_rad - alpha_rad) - r_m;
      sum += p.weight * d * d;
    }
    return sum;
  };
  const double least = squares(fit.r_m, fit.alpha_rad());
  EXPECT_NEAR(fit.across_m2, least, 1e-9);
  EXPECT_NEAR(across_of(sums), least, 1e-9);
  for (const double d : {-1e-4, 1e-4}) {
    EXPECT_GT(squares(fit.r_m + d, fit.alpha_rad()), least);
    EXPECT_GT(squares(fit.r_m, fit.alpha_rad() + d), least);
  }
}

TEST_P(LineFits, AgreeInCentredAndPairedForm) {
  const Moments sums = moments_of(points_);
  const DoubleAngle paired = paired_double_angle(points_);
  EXPECT_NEAR(-2.0 * (sums.xy - sums.x * sums.y / sums.w), paired.num, 1e-9);
  EXPECT_NEAR(sums.yy - sums.y * sums.y / sums.w - (sums.xx - sums.x * sums.x / sums.w), paired.den, 1e-9);
  const double alpha = 0.5 * std::atan2(paired.num, paired.den);
  EXPECT_NEAR(std::remainder(fit_line(sums).alpha_rad() - alpha, kPi), 0.0, 1e-12);
}

TEST_P(LineFits, HaveGradientsLikeDifferences) {
  constexpr double kStep = 1e-6;
  const LineFit fit = fit_line(moments_of(points_));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto difference = [&](double PolarPoint::*coordinate) {
      std::vector<PolarPoint> up = points_;
      std::vector<PolarPoint> down = points_;
      up[i].*coordinate += kStep;
      down[i].*coordinate -= kStep;
      const LineFit a = fit_line(moments_of(up));
      const LineFit b = fit_line(moments_of(down));
      return LineGradient{(a.r_m - b.r_m) / (2.0 * kStep), wrap_angle(a.alpha_rad() - b.alpha_rad()) / (2.0 * kStep)};
    };
    const LineGradient by_range = range_gradient(points_, fit, i);
    const LineGradient range_difference = difference(&PolarPoint::range_m);
    EXPECT_NEAR(by_range.r, range_difference.r, 1e-7);
    EXPECT_NEAR(by_range.alpha, range_difference.alpha, 1e-7);
    const LineGradient by_bearing = bearing_gradient(points_, fit, i);
    const LineGradient bearing_difference = difference(&PolarPoint::angle_rad);
    EXPECT_NEAR(by_bearing.r, bearing_difference.r, 1e-7);
    EXPECT_NEAR(by_bearing.alpha, bearing_difference.alpha, 1e-7);
  }
}

TEST_P(LineFits, HaveTheSameCovarianceFromSumsAndFromPoints) {
  // To first order in the residuals: exact on points without noise.
  for (const double bearing_sigma : {0.0, 0.01}) {
    const std::vector<PolarPoint> exact = [&] {
      std::vector<PolarPoint> points = points_;
      for (PolarPoint& p : points) {
        p.range_m = GetParam().r_m / std::cos(p.angle_rad - GetParam().alpha_rad);
      }
      return points;
    }();
    const Moments sums = moments_of(exact);
    const LineFit fit = fit_line(sums);
    NoiseSums noise;
    for (const PolarPoint& p : exact) {
      const double c = std::cos(p.angle_rad - fit.alpha_rad());
      const double along = fit.tangent().dot(p.cartesian());
      const double s = along - fit.tangent().dot(fit.mean);
      const double variance = p.sigma_m * p.sigma_m * c * c + bearing_sigma * bearing_sigma * along * along;
      noise.w2v += p.weight * p.weight * variance;
      noise.w2vs += p.weight * p.weight * variance * s;
      noise.w2vss += p.weight * p.weight * variance * s * s;
    }
    const Matrix2 from_sums = line_covariance(fit, sums.w, noise);
    const Matrix2 from_points = polar_covariance(exact, fit, bearing_sigma);
    EXPECT_LT((from_sums - from_points).norm(), 1e-9 * from_points.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Directions, LineFits,
                         ::testing::Values(Case{2.0, 0.3}, Case{1.0, kPi / 2.0}, Case{3.0, -2.8}, Case{0.8, kPi},
                                           Case{0.5, -kPi / 2.0}, Case{2.5, 0.0}));

TEST(LineFit, CoincidingPointsGiveNoNaN) {
  Moments sums;
  for (int k = 0; k < 5; ++k) {
    sums.add(1.25, -0.5, 1.0);
  }
  const LineFit fit = fit_line(sums);
  EXPECT_TRUE(std::isfinite(fit.r_m));
  EXPECT_TRUE(std::isfinite(fit.alpha_rad()));
  EXPECT_EQ(fit.along_m2, 0.0);
}

TEST(MahalanobisDistance, SeesOneLineUnderBothSigns) {
  Line a;
  a.r_m = 0.001;
  a.alpha_rad = 0.2;
  a.covariance << 1e-4, 2e-5, 2e-5, 1e-4;
  Line b = a;
  b.r_m = 0.002;
  b.alpha_rad = wrap_angle(0.2 + kPi);
  b.covariance(0, 1) = -2e-5;
  b.covariance(1, 0) = -2e-5;
  const Matrix2 sum = 2.0 * a.covariance;
  const double expected = 0.003 * std::sqrt(sum.inverse()(0, 0));
  EXPECT_NEAR(mahalanobis_distance(a, b), expected, 1e-9);
  EXPECT_NEAR(mahalanobis_distance(b, a), expected, 1e-9);
}

}  // namespace
}  // namespace seeker::lines
