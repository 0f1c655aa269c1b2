/// \file
/// YAML fields of pose tracking, smoothing and place recognition.
#pragma once

#include "common/config/fields.hpp"
#include "server/slam/loop_detector.hpp"
#include "server/slam/pose_graph.hpp"
#include "server/slam/scan_map_tracker.hpp"
#include "server/slam/sp_params.hpp"

namespace seeker::slam {

void describe(config::Fields& f, OdometryParams& params);
void describe(config::Fields& f, NormalParams& params);
void describe(config::Fields& f, MatchParams& params);
void describe(config::Fields& f, LocalCloudParams& params);
void describe(config::Fields& f, ScanMapParams& params);
void describe(config::Fields& f, PoseGraphParams& params);
void describe(config::Fields& f, ConsistencyParams& params);
void describe(config::Fields& f, PyramidParams& params);
void describe(config::Fields& f, FreeSpaceParams& params);
void describe(config::Fields& f, PlaceMapParams& params);
void describe(config::Fields& f, GlobalSearchParams& params);
void describe(config::Fields& f, AgreementParams& params);
void describe(config::Fields& f, JudgeParams& params);
void describe(config::Fields& f, KeptPlaceParams& params);
void describe(config::Fields& f, PlaceParams& params);
void describe(config::Fields& f, LoopParams& params);
void describe(config::Fields& f, SpAssociationParams& params);
void describe(config::Fields& f, SpFeatureParams& params);
void describe(config::Fields& f, SpExistenceParams& params);
void describe(config::Fields& f, SpMapParams& params);

}  // namespace seeker::slam
