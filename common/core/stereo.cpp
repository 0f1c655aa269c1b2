#include "common/core/stereo.hpp"

#include <cmath>

#include "common/core/hash.hpp"

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
  Fnv1a hash;
  hash.add(static_cast<std::uint64_t>(geometry.width_px));
  hash.add(static_cast<std::uint64_t>(geometry.height_px));
  for (const double field : {geometry.focal_px, geometry.centre_u_px, geometry.centre_v_px, geometry.baseline_m}) {
    hash.add(field);
  }
  return hash.value();
}

}  // namespace seeker
