#include "common/core/image.hpp"

namespace seeker {

Image to_grey(const Image& image) {
  if (image.channels() == 1) {
    return image;
  }
  Image grey(image.width_px(), image.height_px(), 1);
  const std::vector<std::uint8_t>& rgb = image.data();
  for (std::size_t i = 0; i < grey.data().size(); ++i) {
    // Fixed-point BT.601: the weights sum to 2^16.
    constexpr unsigned kRed = 19595;
    constexpr unsigned kGreen = 38470;
    constexpr unsigned kBlue = 7471;
    const unsigned sum = kRed * rgb[3 * i] + kGreen * rgb[3 * i + 1] + kBlue * rgb[3 * i + 2];
    grey.data()[i] = static_cast<std::uint8_t>((sum + 32768U) >> 16U);
  }
  return grey;
}

}  // namespace seeker
