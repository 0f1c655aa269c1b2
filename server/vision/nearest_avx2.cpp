// Compiled for AVX2 function by function: the rest of the program still runs on processors without it. Measured in
// tests/bench/bench_stereo.cpp.
#include "server/vision/nearest_kernel.hpp"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#define SEEKER_AVX2 __attribute__((target("avx2")))

namespace seeker::vision {
namespace {

constexpr std::size_t kBytesPerRegister = 32;
constexpr std::size_t kByteRegisters = kDescriptorSize / kBytesPerRegister;      // of one descriptor as bytes
constexpr std::size_t kWordRegisters = 2 * kDescriptorSize / kBytesPerRegister;  // and as 16-bit words
constexpr std::size_t kWordsPerRegister = kBytesPerRegister / 2;
constexpr std::size_t kAtOnce = 4;  ///< candidates whose sums are folded together

SEEKER_AVX2 inline __m256i load(const void* from) { return _mm256_load_si256(static_cast<const __m256i*>(from)); }

SEEKER_AVX2 void l1_distances(const Descriptor& query, const CandidateBlock& block, std::uint32_t* distances) {
  __m256i q[kByteRegisters];
  for (std::size_t k = 0; k < kByteRegisters; ++k) {
    q[k] = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(&query[k * kBytesPerRegister]));
  }
  for (std::size_t i = 0; i < block.size; ++i) {
    const std::uint8_t* row = &block.bytes[i * kDescriptorSize];
    __m256i sum = _mm256_sad_epu8(q[0], load(row));
    for (std::size_t k = 1; k < kByteRegisters; ++k) {
      sum = _mm256_add_epi64(sum, _mm256_sad_epu8(q[k], load(row + k * kBytesPerRegister)));
    }
    const __m128i halves = _mm_add_epi64(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
    distances[i] =
        static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm_add_epi64(halves, _mm_unpackhi_epi64(halves, halves))));
  }
}

/// Sums of the eight numbers of each of kAtOnce registers.
SEEKER_AVX2 inline __m128i fold(const __m256i* sums) {
  const __m256i pairs = _mm256_hadd_epi32(_mm256_hadd_epi32(sums[0], sums[1]), _mm256_hadd_epi32(sums[2], sums[3]));
  return _mm_add_epi32(_mm256_castsi256_si128(pairs), _mm256_extracti128_si256(pairs, 1));
}

/// |a - b|^2 = |a|^2 + |b|^2 - 2 a.b : only the product is left to do for every pair.
SEEKER_AVX2 void l2_distances(const Descriptor& query, const CandidateBlock& block, std::uint32_t* distances) {
  __m256i q[kWordRegisters];
  std::uint32_t query_squares = 0;
  for (std::size_t k = 0; k < kWordRegisters; ++k) {
    q[k] = _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(&query[k * kWordsPerRegister])));
  }
  for (const std::uint8_t value : query) {
    query_squares += std::uint32_t{value} * value;
  }
  const __m128i own = _mm_set1_epi32(static_cast<int>(query_squares));
  for (std::size_t i = 0; i < block.size; i += kAtOnce) {
    const std::int16_t* row = &block.words[i * kDescriptorSize];
    __m256i sums[kAtOnce];
    for (std::size_t c = 0; c < kAtOnce; ++c) {
      sums[c] = _mm256_madd_epi16(q[0], load(row + c * kDescriptorSize));
    }
    for (std::size_t k = 1; k < kWordRegisters; ++k) {
      for (std::size_t c = 0; c < kAtOnce; ++c) {
        const __m256i words = load(row + c * kDescriptorSize + k * kWordsPerRegister);
        sums[c] = _mm256_add_epi32(sums[c], _mm256_madd_epi16(q[k], words));
      }
    }
    const __m128i squares = _mm_loadu_si128(reinterpret_cast<const __m128i*>(&block.squares[i]));
    const __m128i total = _mm_sub_epi32(_mm_add_epi32(own, squares), _mm_slli_epi32(fold(sums), 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(distances + i), total);
  }
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
