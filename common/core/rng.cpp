#include "common/core/rng.hpp"

#include <cmath>

#include "common/core/hash.hpp"

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
  // The purpose, mixed with one draw of this stream.
  Fnv1a hash;
  hash.add(purpose);
  return Rng(hash.value() ^ engine_());
}

}  // namespace seeker
