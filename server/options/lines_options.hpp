/// \file
/// YAML fields of line detection.
#pragma once

#include "common/config/fields.hpp"
#include "server/lines/make_extractor.hpp"
#include "server/lines/observation.hpp"

namespace seeker::lines {

void describe(config::Fields& f, NoiseParams& params);
void describe(config::Fields& f, FastParams& params);
void describe(config::Fields& f, ObservationParams& params);
void describe(config::Fields& f, LineThresholds& params);
void describe(config::Fields& f, PaperParams& params);
void describe(config::Fields& f, RegressionParams& params);
void describe(config::Fields& f, SplitParams& params);
/// The section `lines` of a robot file.
void describe(config::Fields& f, ExtractorParams& params);

}  // namespace seeker::lines
