#include "server/vision/binarise.hpp"

#include <algorithm>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace seeker::vision {
namespace {

constexpr int kLevels = 256;

int percentile(const Histogram& counts, double share) {
  const long total = std::accumulate(counts.begin(), counts.end(), 0L);
  const double wanted = share * static_cast<double>(total);
  double sum = 0.0;
  for (int level = 0; level < kLevels; ++level) {
    sum += counts[static_cast<std::size_t>(level)];
    if (sum > wanted) {
      return level;
    }
  }
  return kLevels - 1;
}

cv::Mat threshold_classes(const cv::Mat& grey, int threshold) {
  cv::Mat classes;
  cv::threshold(grey, classes, threshold, kLightClass, cv::THRESH_BINARY);
  return classes;
}

cv::Mat local_classes(const cv::Mat& grey, const TemplateParams& params) {
  cv::Mat mean;
  const cv::Size block(params.adaptive_block_px, params.adaptive_block_px);
  cv::boxFilter(grey, mean, -1, block, cv::Point(-1, -1), true, cv::BORDER_REPLICATE);
  const int offset = cvRound(params.adaptive_offset);
  cv::Mat classes(grey.size(), CV_8UC1);
  for (int row = 0; row < grey.rows; ++row) {
    const auto* value = grey.ptr<std::uint8_t>(row);
    const auto* level = mean.ptr<std::uint8_t>(row);
    auto* out = classes.ptr<std::uint8_t>(row);
    for (int column = 0; column < grey.cols; ++column) {
      const int difference = value[column] - level[column];
      const std::uint8_t not_dark = difference > offset ? kLightClass : kNoClass;
      out[column] = difference < -offset ? kDarkClass : not_dark;
    }
  }
  return classes;
}

}  // namespace

Histogram histogram(const cv::Mat& grey) {
  // Four tables, since equal neighbours would wait for each other's counter (bench_vision).
  std::array<Histogram, 4> parts{};
  for (int row = 0; row < grey.rows; ++row) {
    const auto* value = grey.ptr<std::uint8_t>(row);
    for (int column = 0; column < grey.cols; ++column) {
      ++parts[static_cast<std::size_t>(column) & 3U][value[column]];
    }
  }
  Histogram sum{};
  for (std::size_t level = 0; level < sum.size(); ++level) {
    sum[level] = parts[0][level] + parts[1][level] + parts[2][level] + parts[3][level];
  }
  return sum;
}

std::optional<int> otsu_threshold(const Histogram& counts, int low, int high) {
  double total = 0.0;
  double moment = 0.0;
  for (int level = low; level <= high; ++level) {
    total += counts[static_cast<std::size_t>(level)];
    moment += static_cast<double>(level) * counts[static_cast<std::size_t>(level)];
  }
  std::optional<int> best;
  double best_variance = 0.0;
  double below = 0.0;
  double below_moment = 0.0;
  for (int level = low; level < high; ++level) {
    below += counts[static_cast<std::size_t>(level)];
    below_moment += static_cast<double>(level) * counts[static_cast<std::size_t>(level)];
    const double above = total - below;
    if (below <= 0.0 || above <= 0.0) {
      continue;
    }
    const double gap = below_moment / below - (moment - below_moment) / above;
    const double variance = below * above * gap * gap;
    if (variance > best_variance) {
      best_variance = variance;
      best = level;
    }
  }
  return best;
}

std::array<std::uint8_t, 256> stretch_table(const Histogram& counts, double low, double high) {
  const int low_level = percentile(counts, low);
  const int high_level = percentile(counts, high);
  std::array<std::uint8_t, 256> table{};
  for (int level = 0; level < kLevels; ++level) {
    const int stretched =
        high_level > low_level ? (level - low_level) * (kLevels - 1) / (high_level - low_level) : level;
    table[static_cast<std::size_t>(level)] = static_cast<std::uint8_t>(std::clamp(stretched, 0, kLevels - 1));
  }
  return table;
}

Preprocessed preprocess(const cv::Mat& grey, const TemplateParams& params) {
  Preprocessed out;
  cv::GaussianBlur(grey, out.smoothed, cv::Size(5, 5), 0.0, 0.0, cv::BORDER_REPLICATE);
  std::array<std::uint8_t, 256> table = stretch_table(histogram(out.smoothed), params.stretch_low, params.stretch_high);
  cv::LUT(out.smoothed, cv::Mat(1, kLevels, CV_8UC1, table.data()), out.stretched);
  cv::medianBlur(out.stretched, out.denoised, 3);
  return out;
}

std::vector<Binarisation> binarise(const cv::Mat& denoised, const TemplateParams& params) {
  std::vector<Binarisation> out;
  const Histogram counts = histogram(denoised);
  const std::optional<int> otsu = otsu_threshold(counts, 0, kLevels - 1);
  if (!otsu) {
    return out;
  }
  out.push_back({"otsu", threshold_classes(denoised, *otsu)});
  if (!params.extra_binarisations) {
    return out;
  }
  if (const auto dark = otsu_threshold(counts, 0, *otsu)) {
    out.push_back({"otsu_dark", threshold_classes(denoised, *dark)});
  }
  if (const auto light = otsu_threshold(counts, *otsu + 1, kLevels - 1)) {
    out.push_back({"otsu_light", threshold_classes(denoised, *light)});
  }
  out.push_back({"local_mean", local_classes(denoised, params)});
  return out;
}

}  // namespace seeker::vision
