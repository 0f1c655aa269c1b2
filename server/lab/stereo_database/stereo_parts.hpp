/// \file
/// The parts of one seed of the stereo experiment: its parameters, the survey, and a drive with localisation. Used by
/// stereo_run.cpp.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/app/composition/robot_options.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/stereo_database/stereo_run.hpp"
#include "server/lab/stereo_database/stereo_scene.hpp"
#include "server/localize/database_update.hpp"

namespace seeker::lab::stereo {

using Database = std::shared_ptr<const localize::LandmarkDatabase>;
using Frames = std::vector<DriveFrame>;

inline constexpr double kFramePeriod_s = 2.0;  ///< time between the frames of a drive

/// The parameters of a run.
struct Bench {
  sim::RobotModel model;
  vision::StereoFeatureParams features;
  localize::DatabaseParams database;
  localize::LocaliserParams localiser;
  localize::UpdateParams update;
};

/// Parameters of the robot's configuration, or with the paper's values.
[[nodiscard]] Bench bench_of(const StereoSpec& spec, const app::RobotOptions& options);

/// The views of the survey with their recorded poses.
[[nodiscard]] Result<std::vector<localize::Sighting>> survey_views(const Bench& bench, const sim::World& world,
                                                                   Rng& rng);

/// Builds one database, and writes its rows of Table 2 where a table is given.
[[nodiscard]] Result<Database> build(const Bench& bench, const std::vector<localize::Sighting>& views, bool sparse,
                                     bool salient, Table* table2);

/// A drive localised with one database, scored against the truth.
class Localisation {
 public:
  Localisation(const Bench& bench, std::string name, Database database)
      : bench_(bench), database_(std::move(database)) {
    score_.name = std::move(name);
    score_.landmarks = static_cast<int>(database_->size());
    curve_.name = score_.name;
  }

  /// Localises the drive; `update`, where given, is fed with its observations.
  [[nodiscard]] Status run(const Frames& frames, std::uint64_t seed, localize::DatabaseUpdate* update);
  [[nodiscard]] const DatabaseScore& score() const { return score_; }
  [[nodiscard]] ErrorCurve curve() const { return curve_; }

 private:
  [[nodiscard]] Status start(localize::StereoLocaliser& localiser, const Pose2& truth, Rng& rng) const;
  void add(const DriveFrame& frame, const localize::StereoLocaliser& localiser);
  void finish();

  const Bench& bench_;
  Database database_;
  DatabaseScore score_;
  ErrorCurve curve_;
  std::vector<double> steps_ms_;
};

}  // namespace seeker::lab::stereo
