/// \file
/// A rectified stereo camera: its geometry, and a pair of pictures taken at one moment.
#pragma once

#include <cstdint>

#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker {

/// Pinhole geometry that both rectified eyes share (spec S2.2). Row v of the left picture shows what row v of the right
/// one shows; disparity = u_left - u_right >= 0. The camera's frame has its origin in the left eye: x left, y up, z
/// forward, as in spec S2.2.
struct StereoGeometry {
  int width_px = 1024;
  int height_px = 768;
  double focal_px = 839.478943;
  double centre_u_px = 512.0;  ///< principal point; (0, 0) is the centre of the first pixel
  double centre_v_px = 384.0;
  double baseline_m = 0.12;

  friend bool operator==(const StereoGeometry&, const StereoGeometry&) = default;
};

/// Refuses numbers that are not finite, pictures without pixels, a principal point outside the picture, and a focal
/// length or baseline that is not positive.
[[nodiscard]] Status validate(const StereoGeometry& geometry);

/// Identifies a calibration, since pictures and landmarks of one calibration must not be used with another. Equal
/// geometries have equal hashes on every machine.
[[nodiscard]] std::uint64_t calibration_hash(const StereoGeometry& geometry);

/// The rectified pictures of both eyes, exposed at the same time.
struct StereoFrame {
  RobotTime stamp;
  Image left;
  Image right;

  friend bool operator==(const StereoFrame&, const StereoFrame&) = default;
};

}  // namespace seeker
