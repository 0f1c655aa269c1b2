/// \file
/// Checks for faults of a pair of pictures that make stereo impossible.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "common/core/image.hpp"
#include "common/core/stereo.hpp"
#include "server/vision/feature_match.hpp"

namespace seeker::vision {

enum class PictureFault : std::uint8_t { kNone, kBlack, kSaturated, kBlurred };

enum class PairFault : std::uint8_t { kNone, kSwapped, kRowsDisagree };

/// Brightness and sharpness of a picture, measured on a sixth of its pixels.
struct PictureQuality {
  double dark_share = 0.0;    ///< share of the pixels too dark to hold information
  double bright_share = 0.0;  ///< share of the pixels at the upper end
  /// Of the tiles with contrast, all but the sharpest tenth have less than this share of their structures of 2 to 16 px
  /// in those of 2 to 4 px. No value where too few tiles have contrast (a bare wall).
  std::optional<double> sharpness;
};

/// Measures the quality of `grey`, which has one channel.
[[nodiscard]] PictureQuality measure_quality(const Image& grey);
/// The fault of a picture. A picture is blurred only when all of it is; a sharp picture of smooth objects has some
/// sharp detail. Sharp photographs of rooms, corridors and plants and rendered rooms have a sharpness from 0.114 on,
/// with a median of 0.4; blurred by a Gaussian of 6 px (with noise of 2 grey levels) most have less than 0.11, by one
/// of 8 px nearly all. A picture counts as blurred below 0.11, or below 0.17 and less than half as sharp as the other
/// eye's. A picture without contrast does not count as blurred.
[[nodiscard]] PictureFault fault_of(const PictureQuality& picture, const PictureQuality& other_eye);

/// Fails with kInvalidArgument naming the eye, the cause and the remedy, also for pictures whose size is not the
/// geometry's. Pictures without pixels are refused.
[[nodiscard]] Status check_pictures(const StereoFrame& frame, const StereoGeometry& geometry);

/// Judges pairs that match by descriptor alone: how many are on one row, and which eye shows nearer objects farther
/// right. Too few pairs are no fault.
[[nodiscard]] PairFault fault_of_pair(const FeatureList& left, const FeatureList& right,
                                      std::span<const FeatureMatch> matches, double row_gate_px);
/// The number of pairs that are less than row_gate_px apart in height.
[[nodiscard]] int count_on_rows(const FeatureList& left, const FeatureList& right,
                                std::span<const FeatureMatch> matches, double row_gate_px);
/// Fails with kInvalidArgument, cause and remedy for a fault.
[[nodiscard]] Status check_pair(PairFault fault);

}  // namespace seeker::vision
