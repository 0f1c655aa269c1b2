/// \file
/// YAML fields of the search.
#pragma once

#include "common/config/fields.hpp"
#include "server/options/nav_options.hpp"
#include "server/search/control_table.hpp"
#include "server/search/search_params.hpp"

namespace seeker::search {

void describe(config::Fields& f, ControlTableParams& params);
void describe(config::Fields& f, DriveLawParams& params);
void describe(config::Fields& f, PaperParams& params);
void describe(config::Fields& f, PlanParams& params);
void describe(config::Fields& f, MissionParams& params);
void describe(config::Fields& f, EvidenceParams& params);
void describe(config::Fields& f, HitRate& params);
void describe(config::Fields& f, DetectionParams& params);
void describe(config::Fields& f, SearchParams& params);

}  // namespace seeker::search
