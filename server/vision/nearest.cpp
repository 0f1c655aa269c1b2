#include <algorithm>
#include <cstdlib>

#include "server/vision/nearest_kernel.hpp"

namespace seeker::vision {
namespace {

std::uint32_t sum_of_differences(const std::uint8_t* a, const std::uint8_t* b) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < kDescriptorSize; ++i) {
    sum += static_cast<std::uint32_t>(std::abs(int{a[i]} - int{b[i]}));
  }
  return sum;
}

std::uint32_t sum_of_squares(const std::uint8_t* a, const std::uint8_t* b) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < kDescriptorSize; ++i) {
    const int difference = int{a[i]} - int{b[i]};
    sum += static_cast<std::uint32_t>(difference * difference);
  }
  return sum;
}

template <std::uint32_t (*kDistance)(const std::uint8_t*, const std::uint8_t*)>
std::uint32_t plain_distances(const Descriptor& query, const CandidateBlock& block, std::uint32_t* distances) {
  std::uint32_t least = NearestTwo::kFar;
  for (std::size_t i = 0; i < block.size; ++i) {
    distances[i] = kDistance(query.data(), &block.bytes[i * kDescriptorSize]);
    least = std::min(least, distances[i]);
  }
  return least;
}

void fill(CandidateBlock& block, std::span<const Descriptor> candidates) {
  block.size = candidates.size();
  for (std::size_t i = 0; i < block.size; ++i) {
    const auto first = static_cast<std::ptrdiff_t>(i * kDescriptorSize);
    std::copy(candidates[i].begin(), candidates[i].end(), block.bytes.begin() + first);
    std::copy(candidates[i].begin(), candidates[i].end(), block.words.begin() + first);
    block.squares[i] = 0;
    for (const std::uint8_t value : candidates[i]) {
      block.squares[i] += std::uint32_t{value} * value;
    }
  }
}

}  // namespace

const std::vector<NearestKernels>& nearest_kernels() {
  static const std::vector<NearestKernels> kKernels = [] {
    std::vector<NearestKernels> found;
    if (const NearestKernels* avx2 = avx2_kernels()) {
      found.push_back(*avx2);
    }
    found.push_back({"plain", plain_distances<sum_of_differences>, plain_distances<sum_of_squares>});
    return found;
  }();
  return kKernels;
}

std::vector<NearestTwo> nearest_two_with(const NearestKernels& kernels, std::span<const Descriptor> queries,
                                         std::span<const Descriptor> candidates, Metric metric) {
  const DistanceKernel measure = metric == Metric::kL1 ? kernels.l1 : kernels.l2;
  std::vector<NearestTwo> nearest(queries.size());
  CandidateBlock block;
  std::array<std::uint32_t, kCandidateBlock> distances{};
  for (std::size_t first = 0; first < candidates.size(); first += kCandidateBlock) {
    fill(block, candidates.subspan(first, std::min(kCandidateBlock, candidates.size() - first)));
    for (std::size_t q = 0; q < queries.size(); ++q) {
      const bool any = measure(queries[q], block, distances.data()) < nearest[q].second_distance;
      for (std::size_t i = 0; any && i < block.size; ++i) {
        nearest[q].offer(static_cast<std::int32_t>(first + i), distances[i]);
      }
    }
  }
  return nearest;
}

std::vector<NearestTwo> nearest_two(std::span<const Descriptor> queries, std::span<const Descriptor> candidates,
                                    Metric metric) {
  return nearest_two_with(nearest_kernels().front(), queries, candidates, metric);
}

std::uint32_t descriptor_distance(const Descriptor& a, const Descriptor& b, Metric metric) {
  return metric == Metric::kL1 ? sum_of_differences(a.data(), b.data()) : sum_of_squares(a.data(), b.data());
}

}  // namespace seeker::vision
