/// \file
/// From light to grey values: blur of the lens, noise of the sensor, 8 bits.
#pragma once

#include <array>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/rng.hpp"
#include "server/sim/robot_model.hpp"

namespace seeker::sim {

class ImageChain {
 public:
  explicit ImageChain(const OmniModel& model);

  /// `light` holds grey values (0 black, 255 white and above: clipped) row by row, in the size of the model.
  [[nodiscard]] Image expose(const std::vector<float>& light, Rng& rng);

 private:
  void blur(const std::vector<float>& light);

  int width_px_;
  int height_px_;
  float side_weight_;                  ///< of each neighbour in the 3-tap blur
  std::array<float, 256> sigma_of_{};  ///< noise of each grey value
  std::vector<float> unit_noise_;  ///< standard normal numbers: drawing each afresh would take longer than the picture
  std::vector<float> rows_;
  std::vector<float> blurred_;
};

}  // namespace seeker::sim
