/// \file
/// Implementations of nearest_two(): a plain one, and others for processors with wider registers. All give identical
/// results.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/vision/descriptor.hpp"

namespace seeker::vision {

/// Number of candidates that are processed at once: in both forms they fit into the first-level cache.
inline constexpr std::size_t kCandidateBlock = 64;
inline constexpr std::size_t kRegisterBytes = 32;  ///< size of the widest register, for alignment

/// Up to kCandidateBlock candidates in the layout of the kernels; rows beyond `size` are zero.
struct CandidateBlock {
  alignas(kRegisterBytes) std::array<std::uint8_t, kCandidateBlock * kDescriptorSize> bytes{};
  alignas(kRegisterBytes) std::array<std::int16_t, kCandidateBlock * kDescriptorSize> words{};
  std::array<std::uint32_t, kCandidateBlock> squares{};  ///< sums of squared bytes
  std::size_t size = 0;
};

/// Writes the distance of `query` to every row of `block`, and possibly to the empty ones behind. Returns the least of
/// all written distances: for most blocks the others are never read.
using DistanceKernel = std::uint32_t (*)(const Descriptor& query, const CandidateBlock& block,
                                         std::uint32_t* distances);

struct NearestKernels {
  const char* name;
  DistanceKernel l1;
  DistanceKernel l2;
};

/// The implementations that this processor supports, widest first; the last one is the plain reference.
[[nodiscard]] const std::vector<NearestKernels>& nearest_kernels();

/// As nearest_two(), with a chosen implementation.
[[nodiscard]] std::vector<NearestTwo> nearest_two_with(const NearestKernels& kernels,
                                                       std::span<const Descriptor> queries,
                                                       std::span<const Descriptor> candidates, Metric metric);

/// The implementation for AVX2; null where the processor or the compiler's target does not support it.
[[nodiscard]] const NearestKernels* avx2_kernels();

}  // namespace seeker::vision
