#include "server/vision/solids/moment_features.hpp"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "common/core/assert.hpp"

namespace seeker::vision {
namespace {

double signed_log(double value) {
  constexpr double kSmallest = 1e-12;
  const double size = std::log10(std::abs(value) + kSmallest);
  return value < 0.0 ? -size : size;
}

}  // namespace

std::array<double, kHuInvariants> hu_invariants(const cv::Mat& weights) {
  const cv::Moments m = cv::moments(weights);
  SEEKER_ASSERT(m.m00 > 0.0);
  // Sums and differences as in the printed formulas.
  const double s = m.nu20 + m.nu02;
  const double d = m.nu20 - m.nu02;
  const double p = m.nu30 + m.nu12;
  const double q = m.nu21 + m.nu03;
  const double a = m.nu30 - 3.0 * m.nu12;
  const double b = 3.0 * m.nu21 - m.nu03;
  const double p2 = p * p;
  const double q2 = q * q;
  return {s,
          d * d + 4.0 * m.nu11 * m.nu11,
          a * a + b * b,
          p2 + q2,
          a * p * (p2 - 3.0 * q2) + b * q * (3.0 * p2 - q2),
          d * (p2 - q2) + 4.0 * m.nu11 * p * q,
          b * p * (p2 - 3.0 * q2) - a * q * (3.0 * p2 - q2)};
}

SolidFeatures solid_features(const cv::Mat& mask, const cv::Mat& grey) {
  cv::Mat inside;
  grey.copyTo(inside, mask);
  SolidFeatures features{};
  std::size_t at = 0;
  for (const cv::Mat* picture : std::initializer_list<const cv::Mat*>{&mask, &inside}) {
    for (const double phi : hu_invariants(*picture)) {
      features[at++] = signed_log(phi);
    }
  }
  return features;
}

}  // namespace seeker::vision
