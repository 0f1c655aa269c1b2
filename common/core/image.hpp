/// \file
/// Pixels as values: what travels between camera, renderer, recogniser, file and wire.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/core/assert.hpp"
#include "common/core/time.hpp"

namespace seeker {

/// Largest width or height accepted from any device, file or peer.
inline constexpr int kMaxImageSide_px = 8192;

/// 8-bit image, row-major, row 0 at the top, channels interleaved: 1 = grey, 3 = red, green, blue.
class Image {
 public:
  Image() = default;
  Image(int width_px, int height_px, int channels, std::uint8_t fill = 0)
      : width_px_(width_px),
        height_px_(height_px),
        channels_(channels),
        data_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
                  static_cast<std::size_t>(channels),
              fill) {
    SEEKER_ASSERT(width_px >= 0 && height_px >= 0 && (channels == 1 || channels == 3));
  }

  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }
  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] bool empty() const { return data_.empty(); }
  [[nodiscard]] const std::vector<std::uint8_t>& data() const { return data_; }
  [[nodiscard]] std::vector<std::uint8_t>& data() { return data_; }

  /// First channel of the pixel in column u, row v.
  [[nodiscard]] std::uint8_t* at(int u, int v) { return &data_[offset(u, v)]; }
  [[nodiscard]] const std::uint8_t* at(int u, int v) const { return &data_[offset(u, v)]; }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  [[nodiscard]] std::size_t offset(int u, int v) const {
    SEEKER_ASSERT(u >= 0 && u < width_px_ && v >= 0 && v < height_px_);
    return (static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px_) + static_cast<std::size_t>(u)) *
           static_cast<std::size_t>(channels_);
  }

  int width_px_ = 0;
  int height_px_ = 0;
  int channels_ = 1;
  std::vector<std::uint8_t> data_;
};

/// The same picture with one channel (ITU-R BT.601 weights); a grey image is returned unchanged.
[[nodiscard]] Image to_grey(const Image& image);

/// A picture with the moment it was exposed.
struct CameraFrame {
  RobotTime stamp;
  Image image;

  friend bool operator==(const CameraFrame&, const CameraFrame&) = default;
};

}  // namespace seeker
