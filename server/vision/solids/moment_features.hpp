/// \file
/// Moment invariants of a region: the 14 inputs of the recogniser of solids (spec S6).
#pragma once

#include <array>

#include <opencv2/core.hpp>

namespace seeker::vision {

inline constexpr std::size_t kHuInvariants = 7;
inline constexpr std::size_t kSolidFeatures = 2 * kHuInvariants;
using SolidFeatures = std::array<double, kSolidFeatures>;

/// The invariants phi_1 .. phi_7 of a one-channel picture's grey values, spec S6. The picture must not be black.
[[nodiscard]] std::array<double, kHuInvariants> hu_invariants(const cv::Mat& weights);

/// The features sgn(phi) log10(|phi| + 1e-12) of the mask, then of the grey values inside it.
[[nodiscard]] SolidFeatures solid_features(const cv::Mat& mask, const cv::Mat& grey);

}  // namespace seeker::vision
