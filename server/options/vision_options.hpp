/// \file
/// YAML fields of camera calibration and recognisers.
#pragma once

#include "common/config/fields.hpp"
#include "server/vision/recogniser_params.hpp"

namespace seeker::vision {

void describe(config::Fields& f, OmniCameraParams& params);
void describe(config::Fields& f, ViewParams& params);
void describe(config::Fields& f, TemplateParams& params);
void describe(config::Fields& f, FeatureParams& params);
void describe(config::Fields& f, RecogniserParams& params);

}  // namespace seeker::vision
