#include "server/app/missions/target_values.hpp"

namespace seeker::app {
namespace {

vision::TargetKind to_vision(api::RecogniserKind kind) {
  switch (kind) {
    case api::RecogniserKind::kTemplate: return vision::TargetKind::kTemplate;
    case api::RecogniserKind::kFeatures: return vision::TargetKind::kFeature;
    case api::RecogniserKind::kSolid: return vision::TargetKind::kSolid;
  }
  return vision::TargetKind::kTemplate;
}

api::RangeSource to_api(search::RangeSource source) {
  switch (source) {
    case search::RangeSource::kNone: return api::RangeSource::kNone;
    case search::RangeSource::kSonar: return api::RangeSource::kSonar;
    case search::RangeSource::kLidar: return api::RangeSource::kLidar;
    case search::RangeSource::kTriangulation: return api::RangeSource::kTriangulation;
    case search::RangeSource::kFloor: return api::RangeSource::kFloor;
  }
  return api::RangeSource::kNone;
}

}  // namespace

std::vector<vision::TargetModel> target_models(const std::vector<api::TargetSpec>& targets) {
  std::vector<vision::TargetModel> models;
  models.reserve(targets.size());
  for (const api::TargetSpec& target : targets) {
    models.push_back({.name = target.name,
                      .picture = target.picture,
                      .width_m = target.width_m,
                      .height_m = target.height_m,
                      .kind = to_vision(target.recogniser),
                      .solid = target.solid});
  }
  return models;
}

std::vector<search::SearchTarget> search_targets(const std::vector<api::TargetSpec>& targets) {
  std::vector<search::SearchTarget> out;
  out.reserve(targets.size());
  for (const api::TargetSpec& target : targets) {
    out.push_back({target.name, target.width_m, target.height_m, target.depth_m});
  }
  return out;
}

api::Detection to_api(const search::Detection& detection, const std::vector<search::SearchTarget>& targets) {
  api::Detection out;
  out.id = detection.id;
  out.target = targets[static_cast<std::size_t>(detection.target)].name;
  out.stamp = detection.stamp;
  out.u_px = detection.u_px;
  out.v_px = detection.v_px;
  out.score = detection.score;
  out.map_T_base = detection.map_T_base;
  out.bearing_base_rad = detection.bearing_base_rad;
  out.bearing_map_rad = detection.bearing_map_rad;
  out.position = detection.position_map;
  out.position_covariance = detection.position_covariance;
  out.range_source = to_api(detection.range_source);
  out.sightings = detection.sightings;
  return out;
}

}  // namespace seeker::app
