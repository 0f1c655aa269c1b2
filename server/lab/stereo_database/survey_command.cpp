#include "server/lab/stereo_database/survey_command.hpp"

#include <algorithm>

#include "common/config/fields.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/app/landmarks/landmark_library.hpp"
#include "server/drivers/camera/cameras.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/resumable.hpp"
#include "server/localize/survey.hpp"

namespace seeker::lab {

// Not in the unnamed namespace: argument-dependent look-up would not find it from to_json().
void describe(config::Fields& f, SurveyFigures& figures) {
  f.field("pairs", figures.pairs);
  f.field("features", figures.features);
  f.field("matched", figures.matched);
  f.field("sparsified", figures.sparsified);
  f.field("all", figures.all);
  f.field("salient", figures.salient);
  f.field("file", figures.file);
}

namespace {

drivers::StereoCameraParams camera_of(const SurveyOptions& options, const app::StereoSettings& settings) {
  drivers::StereoCameraParams camera = settings.camera.value_or(drivers::StereoCameraParams{});
  camera.source = drivers::StereoSource::kFiles;
  camera.files = {options.folder, options.left, options.right, options.poses};
  camera.calibration = options.calibration;
  camera.repeat_files = false;
  return camera;
}

/// Where the pairs come from, and what is made of them.
struct Survey {
  std::vector<drivers::ImagePair> pairs;
  std::unique_ptr<drivers::StereoDriver> camera;
  app::StereoSettings settings;
};

Result<Survey> open_survey(const SurveyOptions& options) {
  Result<app::RobotOptions> robot = app::load_robot_options(options.robot, options.overrides);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  Survey survey;
  survey.settings = std::move(robot->stereo);
  const drivers::StereoCameraParams params = camera_of(options, survey.settings);
  Result<std::vector<drivers::ImagePair>> pairs = drivers::list_image_pairs(params.files);
  if (!pairs) {
    return tl::unexpected<Error>(pairs.error());
  }
  survey.pairs = std::move(*pairs);
  Result<std::unique_ptr<drivers::StereoDriver>> camera =
      drivers::make_stereo_camera(params, [] { return RobotTime(); });
  if (!camera) {
    return tl::unexpected<Error>(camera.error());
  }
  survey.camera = std::move(*camera);
  if (const Status ok = survey.camera->activate(); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return survey;
}

Status add_pairs(Survey& survey, localize::SurveyBuilder& builder, bool show_progress, SurveyFigures& figures) {
  const auto extractor = vision::make_stereo_extractor(survey.camera->geometry(), survey.settings.features);
  for (const drivers::ImagePair& pair : survey.pairs) {
    const auto in_pair = [&](const Error& error) { return fail_with_context("pair '" + pair.name + "'", error); };
    const Result<StereoFrame> frame = survey.camera->grab();
    if (!frame) {
      return in_pair(frame.error());
    }
    Result<vision::StereoFeatures> features = extractor->extract(*frame);
    if (!features) {
      return in_pair(features.error());
    }
    localize::Sighting sighting;
    sighting.map_T_eye = pair.map_T_eye.value_or(Pose2{});
    sighting.eye_height_m = survey.settings.localiser.eye_height_m;
    sighting.features = std::move(features->features);
    const Result<localize::SightingCounts> counts = builder.add(sighting);
    if (!counts) {
      return in_pair(counts.error());
    }
    ++figures.pairs;
    figures.features += sighting.features.size();
    figures.matched += static_cast<std::uint64_t>(counts->matched);
    figures.sparsified += static_cast<std::uint64_t>(counts->sparsified);
    if (show_progress) {
      print_progress(std::to_string(figures.pairs) + " of " + std::to_string(survey.pairs.size()) + " pairs, " +
                     std::to_string(builder.database().size()) + " landmarks");
    }
  }
  if (show_progress) {
    print_progress("");
  }
  return {};
}

void print(const SurveyFigures& figures, bool json, std::ostream& out) {
  if (json) {
    out << to_json(figures) << '\n';
    return;
  }
  out << figures.pairs << " pairs, " << figures.features << " points with a depth: " << figures.matched << " matched, "
      << figures.sparsified << " sparsified\n"
      << figures.all << " landmarks, " << figures.salient << " of them salient, kept in " << figures.file << '\n';
}

}  // namespace

Status run_survey(const SurveyOptions& options, std::ostream& out) {
  if (options.poses.empty()) {
    return fail(Errc::kInvalidArgument, "a survey needs the poses of its pairs; name their file with --poses");
  }
  app::LandmarkLibrary library({.folder = options.out, .robot_id = "seeker-lab", .software_version = SEEKER_VERSION});
  if (Status ok = library.check_free(options.name, options.replace); !ok) {
    return ok;
  }
  Result<Survey> survey = open_survey(options);
  if (!survey) {
    return tl::unexpected<Error>(survey.error());
  }
  if (Status ok = localize::validate(survey->settings.database); !ok) {
    return fail_with_context("stereo.database", ok.error());
  }
  localize::SurveyBuilder builder(survey->camera->geometry(), survey->settings.database);
  SurveyFigures figures;
  if (Status ok = add_pairs(*survey, builder, options.show_progress, figures); !ok) {
    return ok;
  }
  const localize::LandmarkDatabase salient = builder.salient();
  figures.all = builder.database().size();
  figures.salient = salient.size();
  const auto& landmarks = builder.database().landmarks();
  const auto often = std::count_if(landmarks.begin(), landmarks.end(), [&](const localize::Landmark& landmark) {
    return landmark.seen >= survey->settings.database.salient_seen;
  });
  figures.sparsified += static_cast<std::uint64_t>(often) - salient.size();
  if (salient.empty()) {
    return fail(Errc::kInvalidArgument, "no landmark was seen in " +
                                            std::to_string(survey->settings.database.salient_seen) +
                                            " pairs or more; take pictures nearer to each other");
  }
  if (const auto kept = library.create(options.name, salient, "", options.replace); !kept) {
    return tl::unexpected<Error>(kept.error());
  }
  figures.file = (options.out / (options.name + ".seekerlm")).string();
  print(figures, options.json, out);
  return {};
}

}  // namespace seeker::lab
