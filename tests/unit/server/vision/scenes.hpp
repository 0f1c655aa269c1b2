/// \file
/// Scenes drawn by the tests themselves. Nothing here shares projection code with the recognisers.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "common/core/angle.hpp"
#include "common/core/image.hpp"
#include "common/core/rng.hpp"
#include "server/vision/picture.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::vision::testing {

inline constexpr int kSymbols = 4;

/// A light symbol on very dark ground with a thick dark border.
inline cv::Mat sign(int symbol, int width = 96, int height = 96) {
  cv::Mat picture(height, width, CV_8UC1, cv::Scalar(22));
  const auto at = [&](double x, double y) { return cv::Point(cvRound(x * width), cvRound(y * height)); };
  const cv::Scalar light(232);
  const int thick = std::max(2, width / 9);
  switch (symbol % kSymbols) {
    case 0:  // an arrow up
      cv::fillConvexPoly(picture, std::vector<cv::Point>{at(.5, .2), at(.8, .52), at(.2, .52)}, light);
      cv::rectangle(picture, at(.4, .5), at(.6, .8), light, cv::FILLED);
      break;
    case 1:  // a ring with a dot
      cv::circle(picture, at(.5, .5), width / 4, light, thick);
      cv::circle(picture, at(.5, .5), thick, light, cv::FILLED);
      break;
    case 2:  // an L
      cv::rectangle(picture, at(.25, .2), at(.42, .8), light, cv::FILLED);
      cv::rectangle(picture, at(.25, .63), at(.78, .8), light, cv::FILLED);
      break;
    default:  // a Z
      cv::rectangle(picture, at(.22, .22), at(.78, .36), light, cv::FILLED);
      cv::rectangle(picture, at(.22, .64), at(.78, .78), light, cv::FILLED);
      cv::line(picture, at(.7, .3), at(.3, .7), light, thick);
      break;
  }
  return picture;
}

inline TargetModel model_of(const std::string& name, const cv::Mat& picture, TargetKind kind = TargetKind::kTemplate) {
  return {name, to_image(picture), 0.30, 0.30 * picture.rows / picture.cols, kind};
}

/// Boxes and discs of middle greys over a slow gradient.
inline cv::Mat cluttered_ground(int width, int height, int objects, Rng& rng) {
  cv::Mat ground(height, width, CV_8UC1);
  const double slope = rng.uniform(-40.0, 40.0);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      ground.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(150.0 + slope * (1.0 * u / width - 0.5));
    }
  }
  for (int i = 0; i < objects; ++i) {
    const cv::Point corner(static_cast<int>(rng.below(static_cast<std::uint64_t>(width))),
                           static_cast<int>(rng.below(static_cast<std::uint64_t>(height))));
    const cv::Size size(12 + static_cast<int>(rng.below(70)), 12 + static_cast<int>(rng.below(70)));
    const cv::Scalar grey(rng.uniform(60.0, 225.0));
    if (rng.uniform() < 0.6) {
      cv::rectangle(ground, cv::Rect(corner, size), grey, cv::FILLED);
    } else {
      cv::circle(ground, corner, size.width / 2, grey, cv::FILLED);
    }
  }
  return ground;
}

inline cv::Mat plain_ground(int width, int height, int level) { return {height, width, CV_8UC1, cv::Scalar(level)}; }

/// Where `mask` is empty or set, the resized picture replaces the scene.
inline void paste(cv::Mat& scene, const cv::Mat& picture, const cv::Rect& box, const cv::Mat& mask = {}) {
  cv::Mat scaled;
  const int method = box.width < picture.cols ? cv::INTER_AREA : cv::INTER_LINEAR;
  cv::resize(picture, scaled, box.size(), 0.0, 0.0, method);
  if (mask.empty()) {
    scaled.copyTo(scene(box));
    return;
  }
  cv::Mat scaled_mask;
  cv::resize(mask, scaled_mask, box.size(), 0.0, 0.0, cv::INTER_AREA);
  scaled.copyTo(scene(box), scaled_mask > 127);
}

/// Lens and sensor.
inline void degrade(cv::Mat& scene, double blur_sigma_px, double noise_sigma, Rng& rng) {
  if (blur_sigma_px > 0.0) {
    cv::GaussianBlur(scene, scene, cv::Size(0, 0), blur_sigma_px);
  }
  for (int v = 0; v < scene.rows; ++v) {
    for (int u = 0; u < scene.cols; ++u) {
      auto& pixel = scene.at<std::uint8_t>(v, u);
      pixel = cv::saturate_cast<std::uint8_t>(pixel + rng.normal(noise_sigma));
    }
  }
}

/// Whether a sighting of `target` has its centre within a quarter of the box around the box's centre.
inline bool hits(const Sighting& s, int target, const cv::Rect& box) {
  return s.target == target && std::abs(s.u_px - (box.x + 0.5 * (box.width - 1))) <= 0.25 * box.width &&
         std::abs(s.v_px - (box.y + 0.5 * (box.height - 1))) <= 0.25 * box.height;
}

/// Counts of an experiment.
struct Tally {
  int shown = 0;
  int found = 0;
  int false_positives = 0;

  [[nodiscard]] double recall() const { return shown == 0 ? 0.0 : static_cast<double>(found) / shown; }
};

/// One scene with one target: found, and everything else that was reported.
inline void count(const RecognitionReport& report, int target, const cv::Rect& box, Tally& tally) {
  ++tally.shown;
  int right = 0;
  for (const Sighting& s : report.sightings) {
    right += hits(s, target, box) ? 1 : 0;
  }
  tally.found += right > 0 ? 1 : 0;
  tally.false_positives += static_cast<int>(report.sightings.size()) - right;
}

}  // namespace seeker::vision::testing
