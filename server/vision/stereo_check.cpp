#include "server/vision/stereo_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace seeker::vision {
namespace {

constexpr std::uint8_t kDark = 16;  // grey levels: the sensor's floor and its noise
constexpr std::uint8_t kBright = 250;
constexpr double kMaxDarkShare = 0.98;
constexpr double kMaxBrightShare = 0.5;
constexpr double kMinTileContrast = 20.0;  // squared grey levels; a bare wall with noise of 2 has below 5
constexpr std::size_t kMinTiles = 20;      // with contrast: fewer say nothing about the lens
constexpr double kSharpestShare = 0.1;
constexpr double kMinSharpness = 0.11;
constexpr double kMinSharpnessToOther = 0.5;
constexpr double kSurelySharp = 0.17;
constexpr int kTile_px = 16;  // the coarsest cell; every third tile of every second row of tiles is measured
constexpr int kLevels = 5;    // cells of 1, 2, 4, 8, 16 px

constexpr int kMinPairs = 40;            // fewer say nothing about the rig
constexpr double kMinShareOnRows = 0.4;  // measured: 0.6 and more on calibrated pairs, below 0.2 at an offset of 3 px
constexpr double kSwappedShare = 0.75;

using Energies = std::array<double, kLevels>;

/// Mean of the squared means of the tile's cells, coarser cells made of finer ones.
Energies energies_of(const Image& grey, int left, int top) {
  Energies energies{};
  std::array<double, kTile_px * kTile_px> mean{};
  for (int v = 0; v < kTile_px; ++v) {
    for (int u = 0; u < kTile_px; ++u) {
      mean[static_cast<std::size_t>(v * kTile_px + u)] = *grey.at(left + u, top + v);
    }
  }
  int side = kTile_px;
  for (std::size_t level = 0; level < energies.size(); ++level) {
    const auto cells = static_cast<std::size_t>(side * side);
    double squares = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
      squares += mean[i] * mean[i];
    }
    energies[level] = squares / static_cast<double>(cells);
    const int half = side / 2;
    for (int v = 0; v < half; ++v) {
      for (int u = 0; u < half; ++u) {
        const auto at = [&](int dv, int du) {
          return mean[static_cast<std::size_t>((2 * v + dv) * side + 2 * u + du)];
        };
        mean[static_cast<std::size_t>(v * half + u)] = 0.25 * (at(0, 0) + at(0, 1) + at(1, 0) + at(1, 1));
      }
    }
    side = half;
  }
  return energies;
}

/// Structures of 2 to 4 px, less the noise's share, in those of 2 to 16 px; nothing where there is hardly any. An edge
/// that lies between two cells is all in the coarse ones, however sharp: one tile alone says little.
std::optional<double> fine_share(const Energies& energies) {
  // What cells of one size say more than those of twice the size. White noise falls to a quarter from level to level.
  const auto detail = [&](std::size_t level) { return energies[level] - energies[level + 1]; };
  const double fine = std::max(0.0, detail(1) - 0.25 * detail(0));
  const double all = fine + detail(2) + detail(3);
  return all < kMinTileContrast ? std::nullopt : std::optional(fine / all);
}

/// What only the sharpest of the tiles exceed; nothing where too few were judged.
std::optional<double> sharpness_of(std::vector<double>& shares) {
  if (shares.size() < kMinTiles) {
    return std::nullopt;
  }
  const auto rank = static_cast<std::ptrdiff_t>((1.0 - kSharpestShare) * static_cast<double>(shares.size()));
  std::nth_element(shares.begin(), shares.begin() + rank, shares.end());
  return shares[static_cast<std::size_t>(rank)];
}

std::string remedy(PictureFault fault) {
  switch (fault) {
    case PictureFault::kBlack: return "is black: take off the lens cap, switch on the light or lengthen the exposure";
    case PictureFault::kSaturated: return "is saturated: shorten the exposure or rotate away from the light";
    default: return "is blurred: clean and focus the lens, or drive slower than its exposure allows";
  }
}

tl::unexpected<Error> picture_error(const char* eye, const std::string& what) {
  return fail(Errc::kInvalidArgument, std::string("the picture of the ") + eye + " eye " + what);
}

Status check_size(const Image& picture, const StereoGeometry& geometry, const char* eye) {
  if (picture.width_px() == geometry.width_px && picture.height_px() == geometry.height_px) {
    return {};
  }
  return picture_error(eye, "has " + std::to_string(picture.width_px()) + "x" + std::to_string(picture.height_px()) +
                                " pixels but the calibration is for " + std::to_string(geometry.width_px) + "x" +
                                std::to_string(geometry.height_px) +
                                ": set the camera to that size, or calibrate it at the new one");
}

}  // namespace

PictureQuality measure_quality(const Image& grey) {
  std::vector<double> fine_shares;
  int tiles = 0;
  std::array<int, 256> histogram{};
  for (int top = 0; top + kTile_px <= grey.height_px(); top += 2 * kTile_px) {
    for (int left = 0; left + kTile_px <= grey.width_px(); left += 3 * kTile_px) {
      if (const auto share = fine_share(energies_of(grey, left, top))) {
        fine_shares.push_back(*share);
      }
      ++tiles;
      for (int v = top; v < top + kTile_px; ++v) {
        for (int u = left; u < left + kTile_px; ++u) {
          ++histogram[*grey.at(u, v)];
        }
      }
    }
  }
  PictureQuality quality;
  if (tiles == 0) {
    return quality;
  }
  const double pixels = static_cast<double>(tiles) * kTile_px * kTile_px;
  const auto share = [&](int first, int last) {
    double sum = 0.0;
    for (int i = first; i <= last; ++i) {
      sum += histogram[static_cast<std::size_t>(i)];
    }
    return sum / pixels;
  };
  quality.dark_share = share(0, kDark);
  quality.bright_share = share(kBright, 255);
  quality.sharpness = sharpness_of(fine_shares);
  return quality;
}

PictureFault fault_of(const PictureQuality& picture, const PictureQuality& other_eye) {
  if (picture.dark_share > kMaxDarkShare) {
    return PictureFault::kBlack;
  }
  if (picture.bright_share > kMaxBrightShare) {
    return PictureFault::kSaturated;
  }
  if (!picture.sharpness) {
    return PictureFault::kNone;
  }
  const bool against_other = *picture.sharpness < kSurelySharp && other_eye.sharpness &&
                             *picture.sharpness < kMinSharpnessToOther * *other_eye.sharpness;
  return *picture.sharpness < kMinSharpness || against_other ? PictureFault::kBlurred : PictureFault::kNone;
}

Status check_pictures(const StereoFrame& frame, const StereoGeometry& geometry) {
  if (Status left = check_size(frame.left, geometry, "left"); !left) {
    return left;
  }
  if (Status right = check_size(frame.right, geometry, "right"); !right) {
    return right;
  }
  const PictureQuality left = measure_quality(to_grey(frame.left));
  const PictureQuality right = measure_quality(to_grey(frame.right));
  if (const PictureFault fault = fault_of(left, right); fault != PictureFault::kNone) {
    return picture_error("left", remedy(fault));
  }
  if (const PictureFault fault = fault_of(right, left); fault != PictureFault::kNone) {
    return picture_error("right", remedy(fault));
  }
  return {};
}

int count_on_rows(const FeatureList& left, const FeatureList& right, std::span<const FeatureMatch> matches,
                  double row_gate_px) {
  return static_cast<int>(std::count_if(matches.begin(), matches.end(), [&](const FeatureMatch& m) {
    const float offset = left.keypoints[static_cast<std::size_t>(m.first)].v_px -
                         right.keypoints[static_cast<std::size_t>(m.second)].v_px;
    return std::abs(static_cast<double>(offset)) < row_gate_px;
  }));
}

PairFault fault_of_pair(const FeatureList& left, const FeatureList& right, std::span<const FeatureMatch> matches,
                        double row_gate_px) {
  if (matches.size() < kMinPairs) {
    return PairFault::kNone;
  }
  if (count_on_rows(left, right, matches, row_gate_px) < kMinShareOnRows * static_cast<double>(matches.size())) {
    return PairFault::kRowsDisagree;
  }
  const auto behind = std::count_if(matches.begin(), matches.end(), [&](const FeatureMatch& m) {
    return left.keypoints[static_cast<std::size_t>(m.first)].u_px <
           right.keypoints[static_cast<std::size_t>(m.second)].u_px;
  });
  return static_cast<double>(behind) > kSwappedShare * static_cast<double>(matches.size()) ? PairFault::kSwapped
                                                                                           : PairFault::kNone;
}

Status check_pair(PairFault fault) {
  switch (fault) {
    case PairFault::kSwapped:
      return fail(Errc::kInvalidArgument,
                  "the right eye sees what the left one should (disparities are negative): swap the two cameras' "
                  "devices in the robot file");
    case PairFault::kRowsDisagree:
      return fail(Errc::kInvalidArgument,
                  "what both eyes see does not lie on one row: the pictures are not of one moment, or the calibration "
                  "is not this camera's; synchronise the eyes or calibrate again");
    default: return {};
  }
}

}  // namespace seeker::vision
