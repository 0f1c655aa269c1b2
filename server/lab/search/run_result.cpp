#include "server/lab/search/run_result.hpp"

#include "common/files/files.hpp"
#include "server/lab/experiments/described_json.hpp"

namespace seeker::lab {

void describe(config::Fields& f, FindScore& score) {
  f.field("target", score.target);
  f.field("robot_time_s", score.robot_time_s);
  f.field("bearing_map_deg", score.bearing_map_deg);
  f.field("bearing_error_deg", score.bearing_error_deg);
  f.field("u_px", score.u_px);
  f.field("v_px", score.v_px);
  f.field("score", score.score);
  f.field("range_m", score.range_m);
  f.field("range_source", score.range_source);
  f.optional_field("position_error_m", score.position_error_m);
  f.optional_field("aligned_error_m", score.aligned_error_m);
  f.field("position_sigma_m", score.position_sigma_m);
  f.field("cells_searched", score.cells_searched);
}

void describe(config::Fields& f, RunResult& result) {
  f.field("schema", result.schema);
  f.field("world", result.world);
  f.field("strategy", result.strategy);
  f.field("seed", result.seed);
  f.field("settings", result.settings);
  f.field("found", result.found);
  f.field("false_finds", result.false_finds);
  f.field("outcome", result.outcome);
  f.field("cause", result.cause);
  f.field("robot_time_s", result.robot_time_s);
  f.field("wall_time_s", result.wall_time_s);
  f.field("path_length_m", result.path_length_m);
  f.field("target_path_m", result.target_path_m);
  f.field("cells_searched", result.cells_searched);
  f.field("cells_unsearched", result.cells_unsearched);
  f.field("cells_unreachable", result.cells_unreachable);
  f.field("cells_visited", result.cells_visited);
  f.field("cells_repeated", result.cells_repeated);
  f.field("reachable_area_m2", result.reachable_area_m2);
  f.field("covered_share", result.covered_share);
  f.field("true_reachable_area_m2", result.true_reachable_area_m2);
  f.field("covered_true_share", result.covered_true_share);
  f.field("mean_probability", result.mean_probability);
  f.field("gaps", result.gaps);
  f.field("contacts", result.contacts);
  f.field("min_clearance_m", result.min_clearance_m);
  f.field("localisation_error_m", result.localisation_error_m);
  f.field("localisation_error_deg", result.localisation_error_deg);
  f.field("max_localisation_error_m", result.max_localisation_error_m);
  f.optional_section("first_find", result.first_find);
  f.optional_section("last_find", result.last_find);
  f.field("events", result.events);
  f.field("event_hash", result.event_hash);
}

Status save(const std::filesystem::path& path, const RunResult& result) {
  return files::write_file(path, to_json(result));
}

}  // namespace seeker::lab
