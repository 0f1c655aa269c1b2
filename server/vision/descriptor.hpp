/// \file
/// Key points with byte descriptors and their distances, as shared by stereo matching, the landmark database and place
/// recognition (spec S2.1, S2.5).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace seeker::vision {

inline constexpr std::size_t kDescriptorSize = 128;

/// Descriptor of 4x4 cells x 8 bins of gradient directions. A byte is 512 times the value of a descriptor of length 1,
/// at most 255; the paper's SIFT and RootSIFT are both stored in this form.
using Descriptor = std::array<std::uint8_t, kDescriptorSize>;
/// Byte value of 1 in a descriptor of length 1: distances of bytes divided by it are those of spec S2.1.
inline constexpr double kDescriptorUnit = 512.0;

enum class DescriptorKind : std::uint8_t {
  kSift,      ///< unit length, clipped at 0.2: the paper's
  kRootSift,  ///< square root of the L1-normalised SIFT descriptor: L2 between them is the Hellinger distance
};

enum class Metric : std::uint8_t {
  kL1,  ///< spec S2.1, eq (1) as printed
  kL2,
};

/// A distinctive point of a picture.
struct Keypoint {
  float u_px = 0.0F;  ///< sub-pixel; (0, 0) is the centre of the first pixel
  float v_px = 0.0F;
  float scale_px = 0.0F;         ///< sigma of the blur at which it was detected
  float orientation_rad = 0.0F;  ///< main direction of the gradient, counter-clockwise in the picture, (-pi, pi]

  friend bool operator==(const Keypoint&, const Keypoint&) = default;
};

/// Key points with their descriptors: keypoints[i] is described by descriptors[i].
struct FeatureList {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;

  [[nodiscard]] std::size_t size() const { return keypoints.size(); }
};

/// A key point of the left picture that was matched in the right one. One per position.
struct StereoFeature {
  Keypoint left;
  double disparity_px = 0.0;  ///< positive, sub-pixel
  Descriptor descriptor;      ///< descriptor of the left picture

  friend bool operator==(const StereoFeature&, const StereoFeature&) = default;
};

/// The two nearest candidates of one query. Distances are those of bytes: L1 sums, or L2 squared sums.
struct NearestTwo {
  static constexpr std::int32_t kNone = -1;
  static constexpr std::uint32_t kFar = 0xFFFFFFFFU;
  std::int32_t best = kNone;
  std::uint32_t best_distance = kFar;
  std::int32_t second = kNone;
  std::uint32_t second_distance = kFar;

  /// Considers one more candidate; of equal ones the first is kept.
  void offer(std::int32_t candidate, std::uint32_t distance) {
    if (distance < best_distance) {
      second = best;
      second_distance = best_distance;
      best = candidate;
      best_distance = distance;
    } else if (distance < second_distance) {
      second = candidate;
      second_distance = distance;
    }
  }

  friend bool operator==(const NearestTwo&, const NearestTwo&) = default;
};

/// Distance of descriptors as in NearestTwo: the L1 sum, or the L2 squared sum, of bytes.
[[nodiscard]] std::uint32_t descriptor_distance(const Descriptor& a, const Descriptor& b, Metric metric);

/// Exact nearest two of `candidates` for every query. Ties go to the lower index. The widest vector instructions of the
/// processor are used; all give the same results.
[[nodiscard]] std::vector<NearestTwo> nearest_two(std::span<const Descriptor> queries,
                                                  std::span<const Descriptor> candidates, Metric metric);

}  // namespace seeker::vision
