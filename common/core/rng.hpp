/// \file
/// The random generator of all code. It is always passed as an argument and always seeded; the program that chooses the
/// seed prints it.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace seeker {

/// Deterministic stream of random numbers. The distributions are our own arithmetic on the raw 64 bits, so
/// that a seed means the same numbers with every standard library.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1).
  [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in [0, n); n > 0. The bias of the modulus is below 2^-40 for any n used here.
  [[nodiscard]] std::uint64_t below(std::uint64_t n) { return engine_() % n; }
  /// Gaussian of mean zero (polar method); sigma >= 0.
  [[nodiscard]] double normal(double sigma);
  [[nodiscard]] std::uint64_t bits() { return engine_(); }

  /// An independent stream for one purpose: adding a draw to one sensor does not shift the others.
  [[nodiscard]] Rng fork(std::string_view purpose);

 private:
  std::mt19937_64 engine_;
};

}  // namespace seeker
