/// \file
/// YAML fields of cameras.
#pragma once

#include "common/config/fields.hpp"
#include "common/core/stereo.hpp"
#include "server/drivers/camera/cameras.hpp"

namespace seeker {

// Found beside the struct it describes (see config::Fields).
void describe(config::Fields& f, StereoGeometry& geometry);

}  // namespace seeker

namespace seeker::drivers {

void describe(config::Fields& f, CaptureParams& params);
void describe(config::Fields& f, ImageFolderParams& params);
void describe(config::Fields& f, PictureReaderParams& params);
void describe(config::Fields& f, StereoCameraParams& params);

}  // namespace seeker::drivers
