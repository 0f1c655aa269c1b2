#include "tests/support/net/impairment.hpp"

namespace seeker::testing {
namespace {

Duration random_ms(Rng& rng, double most_ms) { return seconds(rng.uniform(0.0, most_ms) / 1000.0); }

/// Evenly over the orders of magnitude: within hello, within an answer, within a long stream.
std::size_t random_bytes(Rng& rng) {
  constexpr std::size_t kDecades = 5;
  std::size_t most = 10;
  for (std::size_t k = rng.below(kDecades); k > 0; --k) {
    most *= 10;
  }
  return rng.below(most);
}

}  // namespace

std::string_view to_string(Trouble trouble) {
  switch (trouble) {
    case Trouble::kDelay: return "delay";
    case Trouble::kJitter: return "jitter";
    case Trouble::kDrop: return "drop";
    case Trouble::kCut: return "cut";
    case Trouble::kReorder: return "reorder";
    case Trouble::kHalfOpen: return "half-open";
    case Trouble::kPieces: return "pieces";
    case Trouble::kBandwidth: return "bandwidth";
    case Trouble::kStall: return "stall";
  }
  return "unknown";
}

Impairment random_impairment(Trouble trouble, Rng& rng) {
  constexpr double kMostDelay_ms = 60.0;
  constexpr double kFewestBytes_per_s = 2e4;
  constexpr double kMostBytes_per_s = 2e5;
  Impairment bad;
  switch (trouble) {
    case Trouble::kDelay: bad.delay = random_ms(rng, kMostDelay_ms); break;
    case Trouble::kJitter: bad.jitter = random_ms(rng, kMostDelay_ms); break;
    case Trouble::kDrop: bad.drop = rng.uniform(0.3, 0.9); break;
    case Trouble::kCut: bad.cut_at = random_bytes(rng); break;
    case Trouble::kReorder: bad.reorder = rng.uniform(0.3, 0.9); break;
    case Trouble::kHalfOpen: bad.half_open_at = random_bytes(rng); break;
    case Trouble::kPieces: bad.piece = 1 + rng.below(3); break;
    case Trouble::kBandwidth: bad.bytes_per_s = rng.uniform(kFewestBytes_per_s, kMostBytes_per_s); break;
    case Trouble::kStall: bad.stalled = true; break;
  }
  return bad;
}

}  // namespace seeker::testing
