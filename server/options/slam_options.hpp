/// \file
/// YAML fields of pose tracking.
#pragma once

#include "common/config/fields.hpp"
#include "server/slam/scan_map_tracker.hpp"
#include "server/slam/sp_params.hpp"

namespace seeker::slam {

void describe(config::Fields& f, OdometryParams& params);
void describe(config::Fields& f, NormalParams& params);
void describe(config::Fields& f, MatchParams& params);
void describe(config::Fields& f, LocalCloudParams& params);
void describe(config::Fields& f, ScanMapParams& params);
void describe(config::Fields& f, SpAssociationParams& params);
void describe(config::Fields& f, SpFeatureParams& params);
void describe(config::Fields& f, SpExistenceParams& params);
void describe(config::Fields& f, SpMapParams& params);

}  // namespace seeker::slam
