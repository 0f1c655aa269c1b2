/// \file
/// YAML fields of stereo features, the database of landmarks and its localiser.
#pragma once

#include "common/config/fields.hpp"
#include "server/localize/database_update.hpp"
#include "server/localize/localiser_params.hpp"
#include "server/localize/survey.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::vision {

void describe(config::Fields& f, DetectorParams& params);
void describe(config::Fields& f, StereoMatchParams& params);
void describe(config::Fields& f, StereoFeatureParams& params);

}  // namespace seeker::vision

namespace seeker::localize {

void describe(config::Fields& f, DatabaseParams& params);
void describe(config::Fields& f, LocaliserParams& params);
void describe(config::Fields& f, UpdateParams& params);

}  // namespace seeker::localize
