#include "server/lab/search/run_picture.hpp"

#include "common/core/angle.hpp"
#include "common/image/map_picture.hpp"
#include "server/lab/experiments/table.hpp"

namespace seeker::lab {
namespace {

std::vector<std::pair<std::string, std::string>> facts_of(const RunResult& result) {
  std::vector<std::pair<std::string, std::string>> facts = {
      {"world", result.world},
      {"strategy", result.strategy},
      {"seed", std::to_string(result.seed)},
      {"outcome", result.outcome},
      {"robot time", fixed(result.robot_time_s, 0) + " s"},
      {"path", fixed(result.path_length_m, 1) + " m"},
      {"cells searched", std::to_string(result.cells_searched)},
      {"floor covered", fixed(100.0 * result.covered_share, 1) + " %"},
      {"gaps", std::to_string(result.gaps)},
      {"contacts", std::to_string(result.contacts)}};
  if (result.last_find) {
    facts.emplace_back("bearing error", fixed(result.last_find->bearing_error_deg, 1) + " deg");
    if (result.last_find->position_error_m) {
      facts.emplace_back("position error", fixed(*result.last_find->position_error_m, 2) + " m");
    }
  }
  return facts;
}

}  // namespace

Result<Image> draw_run(const RunRecord& record) {
  image::MapScene scene;
  scene.title = "search of " + record.result.world;
  scene.facts = facts_of(record.result);
  scene.occupancy = record.occupancy;
  if (record.grid) {
    scene.evidence = record.grid->evidence.probability;
    for (const api::Gap& gap : record.grid->evidence.gaps) {
      scene.gaps.push_back({gap.centre, gap.area_m2, gap.reason});
    }
    scene.cell_size_m = record.grid->lists.cell_size_m;
    scene.searched = record.grid->lists.searched;
    scene.unsearched = record.grid->lists.unsearched;
    scene.unreachable = record.grid->lists.unreachable;
  }
  scene.trajectory = record.trajectory;
  if (!record.trajectory.empty()) {
    scene.robot = record.trajectory.back();
  }
  scene.robot_radius_m = record.robot_radius_m;
  for (const api::Detection& detection : record.detections) {
    scene.detections.push_back({.name = detection.target,
                                .position = detection.position,
                                .covariance = detection.position_covariance,
                                .seen_from = detection.map_T_base.translation(),
                                .bearing_map_rad = detection.bearing_map_rad});
  }
  return image::draw_map(scene);
}

}  // namespace seeker::lab
