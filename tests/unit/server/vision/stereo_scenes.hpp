/// \file
/// Stereo pairs whose disparities are known, drawn by the tests themselves.
#pragma once

#include <vector>

#include <opencv2/imgproc.hpp>

#include "common/core/rng.hpp"
#include "common/core/stereo.hpp"
#include "scenes.hpp"
#include "server/vision/picture.hpp"

namespace seeker::vision::testing {

inline StereoGeometry small_camera() {
  StereoGeometry geometry;
  geometry.width_px = 480;
  geometry.height_px = 360;
  geometry.focal_px = 400.0;
  geometry.centre_u_px = 239.5;
  geometry.centre_v_px = 179.5;
  return geometry;
}

/// Noise of many sizes with dark and light patches. At a contrast of 1 it is as rich in key points as foliage.
inline cv::Mat rich_texture(int width, int height, Rng& rng, double contrast = 1.0) {
  cv::Mat sum(height, width, CV_32FC1, cv::Scalar(128.0));
  for (int cell = 64; cell >= 2; cell /= 2) {
    cv::Mat grid(height / cell + 4, width / cell + 4, CV_32FC1);
    for (int v = 0; v < grid.rows; ++v) {
      for (int u = 0; u < grid.cols; ++u) {
        grid.at<float>(v, u) = static_cast<float>(rng.normal(4.0 + 2.2 * std::sqrt(cell)));
      }
    }
    cv::Mat layer;
    cv::resize(grid, layer, grid.size() * cell, 0.0, 0.0, cv::INTER_CUBIC);
    sum += layer(cv::Rect(cell, cell, width, height));
  }
  for (int i = 0; i < width * height / 4000; ++i) {
    const cv::Rect patch(static_cast<int>(rng.below(static_cast<std::uint64_t>(width))),
                         static_cast<int>(rng.below(static_cast<std::uint64_t>(height))),
                         3 + static_cast<int>(rng.below(25)), 3 + static_cast<int>(rng.below(25)));
    cv::rectangle(sum, patch, cv::Scalar(rng.uniform(40.0, 215.0)), cv::FILLED);
  }
  cv::Mat out;
  sum.convertTo(out, CV_8U, contrast, 128.0 * (1.0 - contrast));
  cv::GaussianBlur(out, out, cv::Size(), 0.7);
  return out;
}

/// `disparities_px[i]` holds in the i-th of as many horizontal bands; noise of `noise_sigma` in both eyes, apart.
inline StereoFrame banded_pair(const StereoGeometry& geometry, const std::vector<double>& disparities_px, Rng& rng,
                               double noise_sigma = 2.0, double contrast = 1.0) {
  constexpr int kMargin_px = 8;
  const int reach = 2 * kMargin_px + 256;
  const cv::Mat texture = rich_texture(geometry.width_px + reach, geometry.height_px, rng, contrast);
  const auto eye = [&](bool right) {
    cv::Mat picture(geometry.height_px, geometry.width_px, CV_8UC1);
    for (std::size_t band = 0; band < disparities_px.size(); ++band) {
      const auto edge = [&](std::size_t i) {
        return static_cast<int>(i) * picture.rows / static_cast<int>(disparities_px.size());
      };
      const cv::Range rows(edge(band), edge(band + 1));
      const double shift = kMargin_px + (right ? disparities_px[band] : 0.0);
      const cv::Matx23d map(1.0, 0.0, shift, 0.0, 1.0, 0.0);
      cv::Mat part;
      cv::warpAffine(texture.rowRange(rows), part, map, cv::Size(picture.cols, rows.size()),
                     cv::INTER_LANCZOS4 | cv::WARP_INVERSE_MAP);
      part.copyTo(picture.rowRange(rows));
    }
    degrade(picture, 0.0, noise_sigma, rng);
    return to_image(picture);
  };
  StereoFrame frame;
  frame.left = eye(false);
  frame.right = eye(true);
  return frame;
}

/// The disparity of the band in which row `v_px` is.
inline double band_disparity(const StereoGeometry& geometry, const std::vector<double>& disparities_px, double v_px) {
  const auto band = static_cast<std::size_t>(v_px / geometry.height_px * static_cast<double>(disparities_px.size()));
  return disparities_px[std::min(band, disparities_px.size() - 1)];
}

}  // namespace seeker::vision::testing
