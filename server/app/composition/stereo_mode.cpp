#include "server/app/composition/stereo_mode.hpp"

namespace seeker::app {
namespace {

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

}  // namespace

void describe_mode(config::Fields& f, StereoSettings& settings) {
  const StereoMode before = settings.mode;
  f.choice("mode", settings.mode,
           config::Choices<StereoMode>{{"default", StereoMode::kDefault}, {"paper", StereoMode::kPaper}});
  if (f.reading() && settings.mode != before) {
    take_mode(settings);
  }
}

}  // namespace seeker::app
