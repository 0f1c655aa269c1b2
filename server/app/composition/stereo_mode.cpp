#include "server/app/composition/stereo_mode.hpp"

namespace seeker::app {

void take_mode(StereoSettings& settings) {
  const bool paper = settings.mode == StereoMode::kPaper;
  const vision::StereoFeatureParams features = paper ? vision::paper_stereo_params() : vision::StereoFeatureParams{};
  settings.features.match = features.match;
  settings.features.detector.kind = features.detector.kind;
  settings.database = paper ? localize::paper_database_params() : localize::DatabaseParams{};
  localize::LocaliserParams localiser = paper ? localize::paper_localiser_params() : localize::LocaliserParams{};
  localiser.arm = settings.localiser.arm;
  localiser.eye_height_m = settings.localiser.eye_height_m;
  settings.localiser = localiser;
  settings.estimator.update = paper ? localize::paper_update_params() : localize::UpdateParams{};
}

}  // namespace seeker::app
