#include "common/core/stereo.hpp"

#include <array>
#include <bit>
#include <cmath>

namespace seeker {

Status validate(const StereoGeometry& geometry) {
  const auto bad = [](const char* what) { return fail(Errc::kInvalidArgument, what); };
  if (geometry.width_px < 1 || geometry.height_px < 1 || geometry.width_px > kMaxImageSide_px ||
      geometry.height_px > kMaxImageSide_px) {
    return bad("stereo width_px and height_px must be in 1..8192");
  }
  if (!(geometry.focal_px > 0.0) || !std::isfinite(geometry.focal_px)) {
    return bad("stereo focal_px must be above zero");
  }
  if (!(geometry.baseline_m > 0.0) || !std::isfinite(geometry.baseline_m)) {
    return bad("stereo baseline_m must be above zero");
  }
  if (!(geometry.centre_u_px >= 0.0 && geometry.centre_u_px < geometry.width_px) ||
      !(geometry.centre_v_px >= 0.0 && geometry.centre_v_px < geometry.height_px)) {
    return bad("stereo centre_u_px and centre_v_px must lie in the picture");
  }
  return {};
}

std::uint64_t calibration_hash(const StereoGeometry& geometry) {
  // FNV-1a over the fields' bits, lowest byte first: the same on every machine.
  constexpr std::uint64_t kOffset = 14695981039346656037ULL;
  constexpr std::uint64_t kPrime = 1099511628211ULL;
  const std::array<std::uint64_t, 6> fields = {
      static_cast<std::uint64_t>(geometry.width_px),      static_cast<std::uint64_t>(geometry.height_px),
      std::bit_cast<std::uint64_t>(geometry.focal_px),    std::bit_cast<std::uint64_t>(geometry.centre_u_px),
      std::bit_cast<std::uint64_t>(geometry.centre_v_px), std::bit_cast<std::uint64_t>(geometry.baseline_m)};
  std::uint64_t hash = kOffset;
  for (const std::uint64_t field : fields) {
    for (unsigned shift = 0; shift < 64U; shift += 8U) {
      hash = (hash ^ ((field >> shift) & 0xFFU)) * kPrime;
    }
  }
  return hash;
}

}  // namespace seeker
