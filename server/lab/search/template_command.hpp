/// \file
/// Command `seeker-lab template`: the recogniser on photographs, with a picture of every stage (Fig 4 of the search
/// paper).
#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

#include "common/core/result.hpp"
#include "server/vision/recogniser_params.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::lab {

struct TemplateOptions {
  std::vector<std::filesystem::path> targets;  ///< PNG files; the file name is the name of the target
  std::filesystem::path scene;                 ///< PNG file
  std::filesystem::path out;                   ///< folder for the stages, created where missing; empty: no pictures
  vision::TargetKind kind = vision::TargetKind::kTemplate;
  double width_m = 0.30;            ///< width of the real targets; their height follows from the pictures
  vision::RecogniserParams params;  ///< params.view.omni set: the scene is an omnidirectional picture
};

/// Runs the recogniser, writes `NN_stage.png` for every stage into `out`, and prints one JSON object (sightings, counts
/// of the stages, files) to `json`. Errors: those of the files, of make_recogniser() and of Recogniser::recognise();
/// the message names the file.
[[nodiscard]] Status run_template(const TemplateOptions& options, std::ostream& json);

}  // namespace seeker::lab
