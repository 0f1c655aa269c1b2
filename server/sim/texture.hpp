/// \file
/// Pictures on surfaces: a noise picture of which every wall shows its own part, and the targets' pictures; both with
/// mip levels, because a far wall must not be sampled texel by texel (vision.md 4.5).
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/image.hpp"

namespace seeker::sim {

/// Square multi-octave noise in [-1, 1] with wrap-around and mip levels.
class NoiseTexture {
 public:
  static constexpr int kSide_texels = 1024;
  static constexpr int kLevels = 7;
  static constexpr double kCoarsest_texels = 16.0;  ///< size of the coarsest blotch

  /// The one texture of the program: made once, the same in every run.
  [[nodiscard]] static const NoiseTexture& instance();

  /// Value at texel coordinates of level 0, read from a level in [0, kLevels).
  [[nodiscard]] float at(double u_texel, double v_texel, int level) const;

 private:
  NoiseTexture();
  std::vector<std::vector<float>> levels_;
};

/// Mip level whose texels are about as large as `footprint` texels of level 0.
[[nodiscard]] int mip_level(double footprint_texels, int levels);

/// A target's picture as grey levels 0..1 with mip levels.
class PictureTexture {
 public:
  /// Makes the levels of a picture that is not empty.
  explicit PictureTexture(const Image& picture);

  [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }
  [[nodiscard]] int width_px() const { return levels_.front().width; }
  /// Bilinear value at s in [0, 1] from the left and t in [0, 1] from the top.
  [[nodiscard]] float at(double s, double t, int level) const;

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<float> values;
  };
  [[nodiscard]] static Level halve(const Level& fine);
  std::vector<Level> levels_;
};

}  // namespace seeker::sim
