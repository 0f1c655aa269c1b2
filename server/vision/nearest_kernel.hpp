/// \file
/// The bodies of nearest_two(): one plain, others for processors with wider registers. All give identical numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/vision/descriptor.hpp"

namespace seeker::vision {

/// Candidates that are worked on at once: in both forms they fit into the nearest cache.
inline constexpr std::size_t kCandidateBlock = 64;
inline constexpr std::size_t kRegisterBytes = 32;  ///< of the widest register, for alignment

/// Up to kCandidateBlock candidates as kernels read them; rows beyond `size` are zero.
struct CandidateBlock {
  alignas(kRegisterBytes) std::array<std::uint8_t, kCandidateBlock * kDescriptorSize> bytes{};
  alignas(kRegisterBytes) std::array<std::int16_t, kCandidateBlock * kDescriptorSize> words{};
  std::array<std::uint32_t, kCandidateBlock> squares{};  ///< sums of squared bytes
  std::size_t size = 0;
};

/// Writes the distance of `query` to every row of `block`, and maybe to the empty ones behind. Returns the least of all
/// that it wrote: of most blocks no other is ever read.
using DistanceKernel = std::uint32_t (*)(const Descriptor& query, const CandidateBlock& block,
                                         std::uint32_t* distances);

struct NearestKernels {
  const char* name;
  DistanceKernel l1;
  DistanceKernel l2;
};

/// What this processor can run, widest first; the last one is the plain reference.
[[nodiscard]] const std::vector<NearestKernels>& nearest_kernels();

/// nearest_two() with a chosen body.
[[nodiscard]] std::vector<NearestTwo> nearest_two_with(const NearestKernels& kernels,
                                                       std::span<const Descriptor> queries,
                                                       std::span<const Descriptor> candidates, Metric metric);

/// Bodies for AVX2, or nothing where the processor or the compiler's target has none.
[[nodiscard]] const NearestKernels* avx2_kernels();

}  // namespace seeker::vision
