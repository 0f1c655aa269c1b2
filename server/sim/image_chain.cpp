#include "server/sim/image_chain.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::sim {
namespace {

constexpr std::size_t kNoiseTable = 1U << 16U;
constexpr std::uint64_t kNoiseSeed = 77003;
constexpr float kWhite = 255.0F;
constexpr float kTonesPerGrey = 4.0F;

/// Weight of a neighbour so that a 3-tap kernel has the variance sigma^2.
float side_weight(double sigma_px) {
  constexpr double kLargest = 0.33;
  return static_cast<float>(std::min(kLargest, sigma_px * sigma_px / 2.0));
}

}  // namespace

ImageChain::ImageChain(const SensorModel& model)
    : width_px_(model.width_px), height_px_(model.height_px), side_weight_(side_weight(model.blur_sigma_px)) {
  Rng rng(kNoiseSeed);
  unit_noise_.resize(kNoiseTable);
  for (float& value : unit_noise_) {
    value = static_cast<float>(rng.normal(1.0));
  }
  for (std::size_t grey = 0; grey < sigma_of_.size(); ++grey) {
    sigma_of_[grey] = static_cast<float>(model.noise_sigma + model.shot_noise * std::sqrt(static_cast<double>(grey)));
  }
  if (model.gamma != 1.0) {
    const auto tones = static_cast<std::size_t>(kWhite * kTonesPerGrey) + 2;
    tone_.reserve(tones);
    for (std::size_t i = 0; i < tones; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(kTonesPerGrey * kWhite);
      tone_.push_back(kWhite * static_cast<float>(std::pow(share, model.gamma)));
    }
  }
  const std::size_t size = static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_);
  rows_.resize(size);
  blurred_.resize(size);
}

void ImageChain::blur(const std::vector<float>& light) {
  const auto width = static_cast<std::size_t>(width_px_);
  const auto height = static_cast<std::size_t>(height_px_);
  const float w = side_weight_;
  const float middle = 1.0F - 2.0F * w;
  for (std::size_t v = 0; v < height; ++v) {
    const float* in = light.data() + v * width;
    float* out = rows_.data() + v * width;
    out[0] = in[0];
    for (std::size_t u = 1; u + 1 < width; ++u) {
      out[u] = middle * in[u] + w * (in[u - 1] + in[u + 1]);
    }
    out[width - 1] = in[width - 1];
  }
  for (std::size_t v = 0; v < height; ++v) {
    const float* above = rows_.data() + (v > 0 ? v - 1 : v) * width;
    const float* in = rows_.data() + v * width;
    const float* below = rows_.data() + (v + 1 < height ? v + 1 : v) * width;
    float* out = blurred_.data() + v * width;
    for (std::size_t u = 0; u < width; ++u) {
      out[u] = middle * in[u] + w * (above[u] + below[u]);
    }
  }
}

float ImageChain::tone(float light) const {
  if (tone_.empty()) {
    return light;
  }
  const float at = std::clamp(light, 0.0F, kWhite) * kTonesPerGrey;
  const auto i = static_cast<std::size_t>(at);
  return tone_[i] + (at - static_cast<float>(i)) * (tone_[i + 1] - tone_[i]);
}

Image ImageChain::expose(const std::vector<float>& light, Rng& rng) {
  blur(light);
  Image image(width_px_, height_px_, 1);
  const auto width = static_cast<std::size_t>(width_px_);
  for (std::size_t v = 0; v < static_cast<std::size_t>(height_px_); ++v) {
    std::size_t at = static_cast<std::size_t>(rng.below(kNoiseTable));
    for (std::size_t u = 0; u < width; ++u) {
      const float value = tone(blurred_[v * width + u]);
      const float sigma = sigma_of_[static_cast<std::size_t>(std::min(value, kWhite))];
      const float grey = value + sigma * unit_noise_[at];
      at = (at + 1) & (kNoiseTable - 1);
      image.data()[v * width + u] = static_cast<std::uint8_t>(std::clamp(grey + 0.5F, 0.0F, kWhite));
    }
  }
  return image;
}

}  // namespace seeker::sim
