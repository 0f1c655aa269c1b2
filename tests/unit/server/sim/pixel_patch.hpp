/// \file
/// Pixels of a picture that are alike.
#pragma once

#include <algorithm>

#include "common/core/image.hpp"

namespace seeker::sim::testing {

struct PixelPatch {
  int pixels = 0;
  double u_px = 0.0;  ///< their mean; 0 without any
  double v_px = 0.0;
};

/// All pixels of one channel whose level is as wanted.
template <class Wanted>
PixelPatch patch_of(const Image& image, Wanted&& wanted) {
  PixelPatch patch;
  for (int v = 0; v < image.height_px(); ++v) {
    for (int u = 0; u < image.width_px(); ++u) {
      if (wanted(*image.at(u, v))) {
        ++patch.pixels;
        patch.u_px += u;
        patch.v_px += v;
      }
    }
  }
  patch.u_px /= std::max(1, patch.pixels);
  patch.v_px /= std::max(1, patch.pixels);
  return patch;
}

}  // namespace seeker::sim::testing
