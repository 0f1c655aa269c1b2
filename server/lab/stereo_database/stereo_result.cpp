#include "server/lab/stereo_database/stereo_result.hpp"

#include <algorithm>

#include "common/files/files.hpp"
#include "server/lab/experiments/described_json.hpp"

namespace seeker::lab {

void describe(config::Fields& f, DatabaseScore& score) {
  f.field("name", score.name);
  f.field("landmarks", score.landmarks);
  f.field("frames", score.frames);
  f.field("rms_x_m", score.rms_x_m);
  f.field("rms_y_m", score.rms_y_m);
  f.field("rms_m", score.rms_m);
  f.field("rms_rad", score.rms_rad);
  f.field("mean_nees", score.mean_nees);
  f.field("mean_inliers", score.mean_inliers);
  f.field("mean_compared", score.mean_compared);
  f.field("median_step_ms", score.median_step_ms);
  f.field("not_localised", score.not_localised);
  f.field("inside", score.inside);
  f.field("unnoticed", score.unnoticed);
}

void describe(config::Fields& f, StereoResult& result) {
  f.field("schema", result.schema);
  f.field("mode", result.mode);
  f.field("seed", result.seed);
  f.field("settings", result.settings);
  f.field("survey_pictures", result.survey_pictures);
  f.field("survey_before", result.survey_before);
  f.field("survey_after", result.survey_after);
  f.field("survey_reduced", result.survey_reduced);
  f.field("added_features", result.added_features);
  f.field("known_features", result.known_features);
  f.field("thinned_features", result.thinned_features);
  f.field("frames_shown", result.frames_shown);
  f.field("frames_matched", result.frames_matched);
  f.field("frames_unmatched", result.frames_unmatched);
  f.list("scores", result.scores);
  f.field("dynamic", result.dynamic);
  f.field("duplicates", result.duplicates);
  f.field("added", result.added);
  f.field("removed", result.removed);
  f.field("before", result.before);
  f.field("after", result.after);
  f.field("refused", result.refused);
  f.field("places", result.places);
  f.field("places_found", result.places_found);
  f.field("places_wrong", result.places_wrong);
  f.field("at_once", result.at_once);
  f.field("at_once_wrong", result.at_once_wrong);
  f.field("looks", result.looks);
  f.field("looks_refused", result.looks_refused);
  f.field("looks_most", result.looks_most);
  f.field("foreign", result.foreign);
  f.field("foreign_found", result.foreign_found);
  f.field("foreign_empty", result.foreign_empty);
  f.field("relocalise_ms", result.relocalise_ms);
}

Status save(const std::filesystem::path& path, const StereoResult& result) {
  return files::write_file(path, to_json(result));
}

const DatabaseScore* StereoResult::find(std::string_view name) const {
  const auto found =
      std::find_if(scores.begin(), scores.end(), [&](const DatabaseScore& score) { return score.name == name; });
  return found != scores.end() ? &*found : nullptr;
}

}  // namespace seeker::lab
