/// \file
/// The piece of a picture that another robot sends to the main robot of a fleet, or that lies on its disk: whatever it
/// holds is refused or read within the limits, and what is read travels on unchanged.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/api/fleet.hpp"
#include "common/core/assert.hpp"
#include "server/app/fleet/picture_piece.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seeker;              // NOLINT: a fuzz target is one small program
  constexpr double kBuilding_m = 1e6;  // a pose farther away has no micrometres to be rounded to
  const auto picture = app::decode_picture(std::span(data, size));
  if (!picture) {
    return 0;
  }
  SEEKER_ASSERT(picture->features.size() <= api::kMaxFleetPictureFeatures);
  SEEKER_ASSERT(picture->features.bearings_rad.size() == picture->features.descriptors.size());
  if (std::hypot(picture->node_T_base.x_m, picture->node_T_base.y_m) < kBuilding_m) {
    const auto bytes = app::encode_picture(*picture);
    const auto again = app::decode_picture(bytes);
    SEEKER_ASSERT(again.has_value() && app::encode_picture(*again) == bytes);
  }
  return 0;
}
