// Compiled for AVX2 function by function: the rest of the program still runs on processors without it. Measured in
// tests/bench/bench_stereo.cpp.
#include "server/vision/nearest_kernel.hpp"

#if defined(__x86_64__) && defined(__GNUC__)

#include <algorithm>
#include <utility>

#include <immintrin.h>

#define SEEKER_AVX2 __attribute__((target("avx2")))

namespace seeker::vision {
namespace {

constexpr std::size_t kBytesPerRegister = 32;
constexpr std::size_t kByteRegisters = kDescriptorSize / kBytesPerRegister;      // of one descriptor as bytes
constexpr std::size_t kWordRegisters = 2 * kDescriptorSize / kBytesPerRegister;  // and as 16-bit words
constexpr std::size_t kWordsPerRegister = kBytesPerRegister / 2;
constexpr std::size_t kAtOnce = 4;  ///< candidates

SEEKER_AVX2 inline __m256i load(const void* from) { return _mm256_load_si256(static_cast<const __m256i*>(from)); }

SEEKER_AVX2 inline std::uint32_t least(__m128i four) {
  constexpr int kSwapHalves = 0x4E;
  constexpr int kSwapNeighbours = 0xB1;
  four = _mm_min_epu32(four, _mm_shuffle_epi32(four, kSwapHalves));
  four = _mm_min_epu32(four, _mm_shuffle_epi32(four, kSwapNeighbours));
  return static_cast<std::uint32_t>(_mm_cvtsi128_si32(four));
}

/// Loops over registers are written out by fold expressions: the compiler keeps registers in registers only then.
template <std::size_t... K>
SEEKER_AVX2 inline __m256i sum_of_differences(const __m256i* query, const std::uint8_t* row,
                                              std::index_sequence<K...> /*registers*/) {
  __m256i sum = _mm256_setzero_si256();
  ((sum = _mm256_add_epi64(sum, _mm256_sad_epu8(query[K], load(row + K * kBytesPerRegister)))), ...);
  return sum;
}

SEEKER_AVX2 std::uint32_t l1_distances(const Descriptor& query, const CandidateBlock& block, std::uint32_t* distances) {
  __m256i q[kByteRegisters];
  for (std::size_t k = 0; k < kByteRegisters; ++k) {
    q[k] = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(&query[k * kBytesPerRegister]));
  }
  std::uint32_t smallest = NearestTwo::kFar;
  for (std::size_t i = 0; i < block.size; ++i) {
    const __m256i sum =
        sum_of_differences(q, &block.bytes[i * kDescriptorSize], std::make_index_sequence<kByteRegisters>());
    const __m128i halves = _mm_add_epi64(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
    distances[i] =
        static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm_add_epi64(halves, _mm_unpackhi_epi64(halves, halves))));
    smallest = std::min(smallest, distances[i]);
  }
  return smallest;
}

template <std::size_t... K>
SEEKER_AVX2 inline __m256i product(const __m256i* query, const std::int16_t* row,
                                   std::index_sequence<K...> /*registers*/) {
  __m256i sum = _mm256_setzero_si256();
  ((sum = _mm256_add_epi32(sum, _mm256_madd_epi16(query[K], load(row + K * kWordsPerRegister)))), ...);
  return sum;
}

/// |a - b|^2 = |a|^2 + |b|^2 - 2 a.b : only the product is left to do for every pair.
SEEKER_AVX2 std::uint32_t l2_distances(const Descriptor& query, const CandidateBlock& block, std::uint32_t* distances) {
  constexpr auto kRegisters = std::make_index_sequence<kWordRegisters>();
  __m256i q[kWordRegisters];
  std::uint32_t query_squares = 0;
  for (std::size_t k = 0; k < kWordRegisters; ++k) {
    q[k] = _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(&query[k * kWordsPerRegister])));
  }
  for (const std::uint8_t value : query) {
    query_squares += std::uint32_t{value} * value;
  }
  __m128i smallest = _mm_set1_epi32(-1);
  const __m128i own = _mm_set1_epi32(static_cast<int>(query_squares));
  for (std::size_t i = 0; i < block.size; i += kAtOnce) {
    const std::int16_t* row = &block.words[i * kDescriptorSize];
    // Four sums of eight numbers each are folded into four numbers.
    const __m256i first = _mm256_hadd_epi32(product(q, row, kRegisters), product(q, row + kDescriptorSize, kRegisters));
    const __m256i last = _mm256_hadd_epi32(product(q, row + 2 * kDescriptorSize, kRegisters),
                                           product(q, row + 3 * kDescriptorSize, kRegisters));
    const __m256i folded = _mm256_hadd_epi32(first, last);
    const __m128i products = _mm_add_epi32(_mm256_castsi256_si128(folded), _mm256_extracti128_si256(folded, 1));
    const __m128i squares = _mm_loadu_si128(reinterpret_cast<const __m128i*>(&block.squares[i]));
    const __m128i four = _mm_sub_epi32(_mm_add_epi32(own, squares), _mm_slli_epi32(products, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(distances + i), four);
    smallest = _mm_min_epu32(smallest, four);
  }
  return least(smallest);
}

static_assert(kCandidateBlock % kAtOnce == 0, "a block is read in whole groups");
constexpr NearestKernels kAvx2{"avx2", l1_distances, l2_distances};

}  // namespace

const NearestKernels* avx2_kernels() { return __builtin_cpu_supports("avx2") != 0 ? &kAvx2 : nullptr; }

}  // namespace seeker::vision

#else

namespace seeker::vision {

const NearestKernels* avx2_kernels() { return nullptr; }

}  // namespace seeker::vision

#endif
