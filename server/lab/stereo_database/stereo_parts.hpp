/// \file
/// The parts of one seed of the stereo experiment: its parameters, the survey, and a drive with localisation. Used by
/// stereo_run.cpp.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/app/composition/robot_options.hpp"
#include "server/lab/stereo_database/stereo_run.hpp"
#include "server/lab/stereo_database/stereo_scene.hpp"
#include "server/localize/database_update.hpp"

namespace seeker::lab::stereo {

using Database = std::shared_ptr<const localize::LandmarkDatabase>;
using Frames = std::vector<DriveFrame>;

/// Time between the frames of a drive: 2 s, in the smallest form 4 s.
[[nodiscard]] inline double frame_period_s(const StereoSpec& spec) { return spec.smallest ? 4.0 : 2.0; }

/// The parameters of a run.
struct Bench {
  sim::RobotModel model;
  vision::StereoFeatureParams features;
  localize::DatabaseParams database;
  localize::LocaliserParams localiser;
  localize::UpdateParams update;
};

/// Parameters of a robot's configuration; the camera is mounted as that of its model.
[[nodiscard]] Bench bench_of(const app::RobotOptions& options);

/// The pictures of a survey, and the true poses of the left eye.
struct SurveyPictures {
  std::vector<Pose2> world_T_eyes;
  std::vector<StereoFrame> pairs;
};
[[nodiscard]] SurveyPictures photograph_survey(const sim::World& world, const sim::RobotModel& model, Rng& rng);

/// The views of the survey with their recorded poses, adjusted where the parameters say so.
[[nodiscard]] Result<std::vector<localize::Sighting>> survey_views(const Bench& bench,
                                                                   const std::vector<Pose2>& world_T_eyes,
                                                                   const std::vector<vision::StereoFeatures>& seen,
                                                                   Rng& rng);

/// What became of the features of one view: their fates, and their landmarks (SurveyBuilder::landmarks()).
struct ViewFates {
  std::vector<localize::FeatureFate> fates;
  std::vector<localize::LandmarkId> landmarks;
};

/// A database with what the building of it says of the views.
struct Built {
  Database database;
  std::vector<localize::SightingCounts> counts;  ///< of each view
  std::vector<std::size_t> sizes;                ///< number of landmarks after each view
  std::vector<ViewFates> fates;
};
[[nodiscard]] Result<Built> build(const Bench& bench, const std::vector<localize::Sighting>& views, bool sparse,
                                  bool salient);

/// Share of the landmarks that lie within the room, up to 0.1 m.
[[nodiscard]] double share_inside(const localize::LandmarkDatabase& database, const sim::World& world);

/// A drive localised with one database, scored against the truth.
class Localisation {
 public:
  Localisation(const Bench& bench, std::string name, Database database, double frame_period_s)
      : bench_(bench), database_(std::move(database)), frame_period_s_(frame_period_s) {
    score_.name = std::move(name);
    score_.landmarks = static_cast<int>(database_->size());
    curve_.name = score_.name;
  }

  /// Localises the drive; `update`, where given, is fed with its observations.
  [[nodiscard]] Status run(const Frames& frames, std::uint64_t seed, localize::DatabaseUpdate* update);
  [[nodiscard]] const DatabaseScore& score() const { return score_; }
  [[nodiscard]] ErrorCurve curve() const { return curve_; }
  /// Indices of the features of each frame that corrected the pose.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& matched() const { return matched_; }

 private:
  [[nodiscard]] Status start(localize::StereoLocaliser& localiser, const Pose2& truth, Rng& rng) const;
  void add(const DriveFrame& frame, const localize::StereoLocaliser& localiser);
  void finish();

  const Bench& bench_;
  Database database_;
  double frame_period_s_;
  DatabaseScore score_;
  ErrorCurve curve_;
  std::vector<double> steps_ms_;
  std::vector<std::vector<std::size_t>> matched_;
};

}  // namespace seeker::lab::stereo
