/// \file
/// From light to grey values: blur of the lens, noise of the sensor, rounding to 8 bits.
#pragma once

#include <array>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/rng.hpp"

namespace seeker::sim {

/// A grey sensor behind its lens.
struct SensorModel {
  int width_px = 0;
  int height_px = 0;
  double noise_sigma = 2.0;    ///< grey values
  double shot_noise = 0.0;     ///< grey values per sqrt(grey value)
  double blur_sigma_px = 0.5;  ///< standard deviation of the blur of lens and pixel
  double gamma = 1.0;          ///< grey = 255 (light / 255)^gamma
};

class ImageChain {
 public:
  explicit ImageChain(const SensorModel& model);

  /// `light` holds grey values (0 black, 255 white and above: clipped) row by row, in the size of the model.
  [[nodiscard]] Image expose(const std::vector<float>& light, Rng& rng);

 private:
  void blur(const std::vector<float>& light);
  [[nodiscard]] float tone(float light) const;

  int width_px_;
  int height_px_;
  float side_weight_;                  ///< weight of each neighbour in the 3-tap blur
  std::array<float, 256> sigma_of_{};  ///< standard deviation of the noise for each grey value
  std::vector<float> tone_;            ///< grey value for each quarter of a light value; empty when gamma is 1
  /// Standard normal numbers, reused because drawing new ones would take longer than the picture.
  std::vector<float> unit_noise_;
  std::vector<float> rows_;
  std::vector<float> blurred_;
};

}  // namespace seeker::sim
