#include "common/core/rng.hpp"

#include <cmath>

namespace seeker {

double Rng::normal(double sigma) {
  for (;;) {
    const double u = uniform(-1.0, 1.0);
    const double v = uniform(-1.0, 1.0);
    const double s = u * u + v * v;
    if (s > 0.0 && s < 1.0) {
      return sigma * u * std::sqrt(-2.0 * std::log(s) / s);
    }
  }
}

Rng Rng::fork(std::string_view purpose) {
  // FNV-1a over the purpose, mixed with one draw of this stream.
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : purpose) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  return Rng(hash ^ engine_());
}

}  // namespace seeker
