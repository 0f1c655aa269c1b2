/// \file
/// Draws what an omnidirectional camera sees of a plain room: floor, wall, upright flat signs. Its own mirror formula.
#pragma once

#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"

namespace seeker::vision::testing {

/// An upright flat picture on the floor plane.
struct FlatObject {
  cv::Mat picture;
  double bearing_rad = 0.0;  ///< of its centre
  double range_m = 1.0;
  double width_m = 0.30;
  double height_m = 0.30;
  double z_min_m = 0.45;
  double rotation_rad = 0.0;  ///< away from facing the camera
};

/// Hyperbolic mirror: radius = gain cos(e) / (shape - sin(e)); horizon at 172.7 px.
struct Mirror {
  double u0 = 315.0;
  double v0 = 240.0;
  double gain = 190.0;
  double shape = 1.1;
  double rim = 235.0;
  double height_m = 0.60;
  double wall_m = 6.0;
};

inline double elevation_at(const Mirror& m, double radius) {
  double low = -1.5;
  double high = 0.6;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (m.gain * std::cos(middle) / (m.shape - std::sin(middle)) < radius ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Grey of the nearest object along a ray, or of floor or wall.
inline double shade(const Mirror& m, const std::vector<FlatObject>& objects, double bearing, double elevation) {
  const double slope = std::tan(elevation);
  double nearest = m.wall_m;
  double grey = 165.0 + 25.0 * std::sin(3.0 * bearing) + 8.0 * std::sin(41.0 * bearing);
  if (slope < 0.0 && m.height_m / -slope < nearest) {
    nearest = m.height_m / -slope;
    grey = 120.0 + 10.0 * std::sin(9.0 * nearest) + 6.0 * std::sin(17.0 * bearing);
  }
  for (const FlatObject& t : objects) {
    const double off = bearing - t.bearing_rad;
    // Along the ray: distance q with q cos(off) = range + s sin(rotation), q sin(off) = s cos(rotation).
    const double denominator = std::cos(off) * std::cos(t.rotation_rad) - std::sin(off) * std::sin(t.rotation_rad);
    const double q = denominator > 1e-9 ? t.range_m * std::cos(t.rotation_rad) / denominator : -1.0;
    const double across = q * std::sin(off) / std::cos(t.rotation_rad);  // left positive
    const double z = m.height_m + q * slope - t.z_min_m;
    if (q <= 0.0 || q >= nearest || std::abs(across) >= 0.5 * t.width_m || z < 0.0 || z >= t.height_m) {
      continue;
    }
    nearest = q;
    const int column = static_cast<int>((0.5 - across / t.width_m) * t.picture.cols);
    const int row = static_cast<int>((1.0 - z / t.height_m) * t.picture.rows);
    grey = t.picture.at<std::uint8_t>(std::min(row, t.picture.rows - 1), std::min(column, t.picture.cols - 1));
  }
  return grey;
}

/// 640x480 with 2x2 samples per pixel, blur and noise.
inline cv::Mat render(const Mirror& m, const std::vector<FlatObject>& objects, double noise_sigma, Rng& rng) {
  constexpr int kSide = 2;
  std::vector<double> table;
  for (int i = 0; i <= 480; ++i) {
    table.push_back(elevation_at(m, 0.5 * i));
  }
  cv::Mat out(480, 640, CV_8UC1, cv::Scalar(0));
  for (int v = 0; v < out.rows; ++v) {
    for (int u = 0; u < out.cols; ++u) {
      double sum = 0.0;
      for (int k = 0; k < kSide * kSide; ++k) {
        const double x = m.u0 - (u + (k % kSide - 0.5) / kSide);
        const double y = m.v0 - (v + (k / kSide - 0.5) / kSide);
        const double radius = std::hypot(x, y);
        if (radius < 30.0 || radius > m.rim) {
          continue;
        }
        const auto i = static_cast<std::size_t>(2.0 * radius);
        const double elevation = table[i] + (2.0 * radius - static_cast<double>(i)) * (table[i + 1] - table[i]);
        sum += shade(m, objects, std::atan2(x, y), elevation);
      }
      out.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(sum / (kSide * kSide));
    }
  }
  cv::GaussianBlur(out, out, cv::Size(0, 0), 0.6);
  for (int v = 0; v < out.rows; ++v) {
    for (int u = 0; u < out.cols; ++u) {
      auto& pixel = out.at<std::uint8_t>(v, u);
      pixel = cv::saturate_cast<std::uint8_t>(pixel + rng.normal(noise_sigma));
    }
  }
  return out;
}

}  // namespace seeker::vision::testing
