/// \file
/// YAML fields of cameras.
#pragma once

#include "common/config/fields.hpp"
#include "common/core/stereo.hpp"

namespace seeker {

// Found beside the struct it describes (see config::Fields).
void describe(config::Fields& f, StereoGeometry& geometry);

}  // namespace seeker
