/// \file
/// Stage 1 of spec S3.4: smoothing, contrast stretch, denoising, binarisation.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "server/vision/recogniser_params.hpp"

namespace seeker::vision {

using Histogram = std::array<int, 256>;

[[nodiscard]] Histogram histogram(const cv::Mat& grey);

/// Otsu's threshold over the grey levels [low, high]: the level t for which the classes [low, t] and [t + 1, high]
/// differ most. No value where fewer than two levels occur.
[[nodiscard]] std::optional<int> otsu_threshold(const Histogram& counts, int low, int high);

/// Look-up table that maps the given percentiles to 0 and 255. The identity where both are the same level.
[[nodiscard]] std::array<std::uint8_t, 256> stretch_table(const Histogram& counts, double low, double high);

/// The picture after each step.
struct Preprocessed {
  cv::Mat smoothed;   ///< 5x5 Gaussian
  cv::Mat stretched;  ///< contrast stretched
  cv::Mat denoised;   ///< 3x3 median
};

[[nodiscard]] Preprocessed preprocess(const cv::Mat& grey, const TemplateParams& params);

inline constexpr std::uint8_t kDarkClass = 0;
inline constexpr std::uint8_t kNoClass = 128;
inline constexpr std::uint8_t kLightClass = 255;

/// A picture of the three classes above. Regions of the dark and of the light class are grown alike, so that neither
/// dark-on-light nor light-on-dark is preferred.
struct Binarisation {
  std::string name;
  cv::Mat classes;
};

/// Otsu's binarisation first. With `extra_binarisations` also Otsu's within the dark and within the light class, which
/// separates a very dark target from dark furniture behind it, and the local mean, which follows uneven light. Empty
/// where the picture has one grey level.
[[nodiscard]] std::vector<Binarisation> binarise(const cv::Mat& denoised, const TemplateParams& params);

}  // namespace seeker::vision
