/// \file
/// YAML fields of line detection.
#pragma once

#include "common/config/fields.hpp"
#include "server/lines/fast_extractor.hpp"
#include "server/lines/observation.hpp"
#include "server/lines/paper_extractor.hpp"

namespace seeker::lines {

void describe(config::Fields& f, NoiseParams& params);
void describe(config::Fields& f, FastParams& params);
void describe(config::Fields& f, ObservationParams& params);
void describe(config::Fields& f, LineThresholds& params);
void describe(config::Fields& f, PaperParams& params);

}  // namespace seeker::lines
