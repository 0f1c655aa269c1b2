#include "server/lab/s2_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "server/lab/s2_scene.hpp"
#include "server/lab/sim_run.hpp"
#include "server/lab/table.hpp"
#include "server/localize/database_update.hpp"
#include "server/localize/landmark_map.hpp"
#include "server/localize/relocaliser.hpp"

namespace seeker::lab {
namespace {

using localize::LandmarkDatabase;
using Database = std::shared_ptr<const LandmarkDatabase>;
using Frames = std::vector<DriveFrame>;

// The survey's tripod stands where it should to a centimetre, and its dial is read to a third of a degree.
constexpr double kTripodSigma_m = 0.01;
constexpr double kDialSigma_rad = deg_to_rad(0.3);
constexpr double kFramePeriod_s = 2.0;
constexpr double kMovedShare = 0.2;
constexpr double kForeignShare = 0.5;  ///< of the furniture that stands elsewhere in a room never surveyed
constexpr int kPlaces = 20;            ///< looked for without a guess; of 200 over ten seeds
constexpr int kForeignViews = 100;     ///< of 1000
constexpr std::uint64_t kForeignTextures = 100'000;
constexpr double kWrongPlace_m = 0.5;

/// What the run is made of.
struct Bench {
  sim::RobotModel model;
  vision::StereoFeatureParams features;
  localize::DatabaseParams database;
  localize::LocaliserParams localiser;
  localize::UpdateParams update;
};

Bench bench_of(const S2Spec& spec, const sim::RobotModel& model) {
  Bench bench;
  bench.model = model;
  if (spec.paper) {
    bench.features = vision::paper_stereo_params();
    bench.database = localize::paper_database_params();
    bench.localiser = localize::paper_localiser_params();
    bench.update = localize::paper_update_params();
  }
  const Pose2& eye = model.stereo.base_T_left_eye;
  bench.localiser.arm = {eye.x_m, eye.y_m, eye.theta_rad};
  bench.localiser.eye_height_m = model.stereo.height_m;
  return bench;
}

SimSpec sim_spec_of(const S2Spec& spec) {
  SimSpec sim;
  sim.robot_file = spec.config / "robots" / "stereo.yaml";
  sim.world_file = spec.config / "worlds" / "laboratory.yaml";
  sim.seed = spec.seed;
  sim.overrides = spec.overrides;
  return sim;
}

/// The views of the survey with poses as they were noted down.
Result<std::vector<localize::Sighting>> survey_views(const Bench& bench, const sim::World& world, Rng& rng) {
  const std::vector<Pose2> truth = survey_poses(world, bench.model);
  std::vector<Pose2> bases;
  bases.reserve(truth.size());
  for (const Pose2& eye : truth) {
    bases.push_back(eye * inverse(bench.model.stereo.base_T_left_eye));
  }
  Result<std::vector<vision::StereoFeatures>> seen = look_from(world, bench.model, bench.features, bases, rng);
  if (!seen) {
    return tl::unexpected<Error>(seen.error());
  }
  std::vector<localize::Sighting> views(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    views[i].map_T_eye = {truth[i].x_m + rng.normal(kTripodSigma_m), truth[i].y_m + rng.normal(kTripodSigma_m),
                          truth[i].theta_rad + rng.normal(kDialSigma_rad)};
    views[i].pose_covariance = Eigen::Vector3d(kTripodSigma_m * kTripodSigma_m, kTripodSigma_m * kTripodSigma_m,
                                               kDialSigma_rad * kDialSigma_rad)
                                   .asDiagonal();
    views[i].eye_height_m = bench.model.stereo.height_m;
    views[i].features = std::move((*seen)[i].features);
  }
  return views;
}

/// Builds one database; its rows of Table 2 where a table is given.
Result<Database> build(const Bench& bench, const std::vector<localize::Sighting>& views, bool sparse, bool salient,
                       Table* table2) {
  localize::DatabaseParams params = bench.database;
  params.sparsity.on = sparse;
  params.salient_seen = salient ? params.salient_seen : 1;
  localize::SurveyBuilder builder(bench.model.stereo.geometry, params);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Result<localize::SightingCounts> counts = builder.add(views[i]);
    if (!counts) {
      return tl::unexpected<Error>(counts.error());
    }
    if (table2 != nullptr) {
      table2->add({std::to_string(i + 1), std::to_string(counts->features), std::to_string(counts->in_range),
                   std::to_string(counts->matched), std::to_string(counts->sparsified),
                   std::to_string(counts->inserted), std::to_string(builder.database().size())});
    }
  }
  return std::make_shared<const LandmarkDatabase>(builder.salient());
}

/// A drive localised with one database, scored against the truth.
class Localisation {
 public:
  Localisation(const Bench& bench, std::string name, Database database)
      : bench_(bench), database_(std::move(database)) {
    score_.name = std::move(name);
    score_.landmarks = static_cast<int>(database_->size());
    curve_.name = score_.name;
  }

  /// `update` learns from it where one is given.
  Status run(const Frames& frames, std::uint64_t seed, localize::DatabaseUpdate* update);
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

/// Spec S2.9: P0 is diag(0.05^2, 0.05^2, 0.03^2).
Status Localisation::start(localize::StereoLocaliser& localiser, const Pose2& truth, Rng& rng) const {
  constexpr double kSigma_m = 0.05;
  constexpr double kSigma_rad = 0.03;
  const Pose2 guess{truth.x_m + rng.normal(kSigma_m), truth.y_m + rng.normal(kSigma_m),
                    truth.theta_rad + rng.normal(kSigma_rad)};
  return localiser.start_at(
      guess, Eigen::Vector3d(kSigma_m * kSigma_m, kSigma_m * kSigma_m, kSigma_rad * kSigma_rad).asDiagonal());
}

Status Localisation::run(const Frames& frames, std::uint64_t seed, localize::DatabaseUpdate* update) {
  Result<localize::StereoLocaliser> localiser =
      localize::StereoLocaliser::create(bench_.model.stereo.geometry, database_, bench_.localiser);
  if (!localiser) {
    return tl::unexpected<Error>(localiser.error());
  }
  Rng rng(seed);
  if (Status ok = start(*localiser, frames.front().world_T_base, rng); !ok) {
    return ok;
  }
  for (const DriveFrame& frame : frames) {
    for (const Twist2& velocity : frame.velocities) {
      localiser->predict(velocity, kEncoderPeriod_s);
    }
    const auto before = std::chrono::steady_clock::now();
    const localize::LocaliserStep& step = localiser->update(frame.seen.features, rng);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
    steps_ms_.push_back(took.count());
    add(frame, *localiser);
    if (update != nullptr) {
      localize::Sighting sighting;
      sighting.map_T_eye = localiser->belief().map_T_eye;
      sighting.pose_covariance = localiser->belief().pose_covariance();
      sighting.eye_height_m = bench_.localiser.eye_height_m;
      sighting.features = frame.seen.features;
      update->observe(*database_, sighting, step);
    }
  }
  finish();
  return {};
}

void Localisation::add(const DriveFrame& frame, const localize::StereoLocaliser& localiser) {
  const PoseEstimate estimate = localiser.estimate({});
  const Eigen::Vector3d error(estimate.map_T_base.x_m - frame.world_T_base.x_m,
                              estimate.map_T_base.y_m - frame.world_T_base.y_m,
                              wrap_angle(estimate.map_T_base.theta_rad - frame.world_T_base.theta_rad));
  const bool localised = estimate.quality == LocalisationQuality::kLocalised;
  const bool wrong = error.head<2>().norm() > kUnnoticed_m || std::abs(error(2)) > kUnnoticed_rad;
  score_.not_localised += localised ? 0 : 1;
  score_.unnoticed += localised && wrong ? 1 : 0;
  score_.mean_nees += error.dot(estimate.covariance.inverse() * error);
  score_.mean_inliers += static_cast<double>(localiser.last().inliers.size());
  score_.rms_x_m += error(0) * error(0);
  score_.rms_y_m += error(1) * error(1);
  score_.rms_rad += error(2) * error(2);
  curve_.samples.push_back({kFramePeriod_s * score_.frames, error(0), error(1), error(2)});
  ++score_.frames;
}

void Localisation::finish() {
  const auto count = static_cast<double>(score_.frames);
  score_.rms_m = std::sqrt((score_.rms_x_m + score_.rms_y_m) / count);
  score_.rms_x_m = std::sqrt(score_.rms_x_m / count);
  score_.rms_y_m = std::sqrt(score_.rms_y_m / count);
  score_.rms_rad = std::sqrt(score_.rms_rad / count);
  score_.mean_nees /= count;
  score_.mean_inliers /= count;
  const auto middle = steps_ms_.begin() + static_cast<std::ptrdiff_t>(steps_ms_.size() / 2);
  std::nth_element(steps_ms_.begin(), middle, steps_ms_.end());
  score_.median_step_ms = *middle;
}

/// The whole of one seed, step by step.
class S2Run {
 public:
  S2Run(const S2Spec& spec, const Bench& bench, sim::World world)
      : spec_(spec), bench_(bench), world_(std::move(world)), rng_(spec.seed) {}

  Status survey_and_drive();
  Status change_and_update();
  Status relocalise();
  S2Record take() { return std::move(record_); }

 private:
  Status localise(const std::string& name, const Database& database, const Frames& frames,
                  localize::DatabaseUpdate* update);
  void note_frames(const Frames& frames);
  Status look_for(const sim::World& world, int views, int& found, int* wrong);

  const S2Spec& spec_;
  const Bench& bench_;
  sim::World world_;
  Rng rng_;
  Database salient_;
  S2Record record_;
  std::vector<double> relocalise_ms_;
};

Status S2Run::localise(const std::string& name, const Database& database, const Frames& frames,
                       localize::DatabaseUpdate* update) {
  Localisation localisation(bench_, name, database);
  if (Status ok = localisation.run(frames, spec_.seed, update); !ok) {
    return ok;
  }
  record_.result.scores.push_back(localisation.score());
  record_.curves.push_back(localisation.curve());
  DatabasePlan plan{name, {}};
  for (const localize::Landmark& landmark : database->landmarks()) {
    plan.landmarks.emplace_back(landmark.p_map.head<2>());
  }
  record_.plans.push_back(std::move(plan));
  return {};
}

void S2Run::note_frames(const Frames& frames) {
  Table table(
      {"frame", "left_keypoints", "right_keypoints", "matches_before_constraints", "matches_after_constraints"});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const vision::StereoFeatures& seen = frames[i].seen;
    table.add({std::to_string(i + 1), std::to_string(seen.left_keypoints), std::to_string(seen.right_keypoints),
               std::to_string(seen.matches_before_constraints), std::to_string(seen.features.size())});
    record_.way.push_back(frames[i].world_T_base.translation());
  }
  record_.table1_csv = table.csv();
}

Status S2Run::survey_and_drive() {
  Rng rng = rng_.fork("survey");
  const auto views = survey_views(bench_, world_, rng);
  if (!views) {
    return tl::unexpected<Error>(views.error());
  }
  const auto frames = drive_around(world_, bench_.model, bench_.features, spec_.seed, kFramePeriod_s);
  if (!frames) {
    return tl::unexpected<Error>(frames.error());
  }
  note_frames(*frames);
  Table table2({"view", "features", "in_range", "matched", "sparsified", "inserted", "landmarks"});
  struct Kind {
    const char* name;
    bool sparse;
    bool salient;
  };
  for (const Kind& kind : {Kind{"all", false, false}, Kind{"sparse", true, false}, Kind{"salient", true, true}}) {
    const auto database = build(bench_, *views, kind.sparse, kind.salient, kind.salient ? &table2 : nullptr);
    if (!database) {
      return tl::unexpected<Error>(database.error());
    }
    salient_ = *database;
    if (Status ok = localise(kind.name, *database, *frames, nullptr); !ok) {
      return ok;
    }
  }
  record_.table2_csv = table2.csv();
  return {};
}

Status S2Run::change_and_update() {
  Rng rng = rng_.fork("furniture");
  const Result<sim::World> moved = move_furniture(world_, bench_.model, kMovedShare, rng);
  if (!moved) {
    return tl::unexpected<Error>(moved.error());
  }
  const auto learning = drive_around(*moved, bench_.model, bench_.features, spec_.seed + 1000, kFramePeriod_s);
  const auto scoring = drive_around(*moved, bench_.model, bench_.features, spec_.seed + 2000, kFramePeriod_s);
  for (const auto* frames : {&learning, &scoring}) {
    if (!*frames) {
      return tl::unexpected<Error>(frames->error());
    }
  }
  localize::DatabaseUpdate update(bench_.model.stereo.geometry, bench_.update);
  if (Status ok = localise("changed", salient_, *learning, &update); !ok) {
    return ok;
  }
  if (Status ok = localise("outdated", salient_, *scoring, nullptr); !ok) {
    return ok;
  }
  const Result<localize::StagedUpdate> staged = update.stage(*salient_);
  S2Result& result = record_.result;
  result.before = static_cast<int>(salient_->size());
  if (!staged) {
    result.refused = staged.error().message;
    return {};
  }
  const localize::UpdateCounts& counts = staged->counts;
  result.dynamic = counts.dynamic;
  result.duplicates = counts.duplicates;
  result.added = counts.added;
  result.removed = counts.removed;
  result.after = static_cast<int>(counts.after);
  return localise("updated", std::make_shared<const LandmarkDatabase>(staged->database), *scoring, nullptr);
}

/// Single views of a room, without a guess.
Status S2Run::look_for(const sim::World& world, int views, int& found, int* wrong) {
  Rng rng = rng_.fork(wrong != nullptr ? "places" : "foreign");
  const std::vector<Pose2> poses = random_poses(world, bench_.model, views, rng);
  const auto seen = look_from(world, bench_.model, bench_.features, poses, rng);
  if (!seen) {
    return tl::unexpected<Error>(seen.error());
  }
  const localize::LandmarkMap map(salient_, bench_.localiser.landmark_sigma_floor_m);
  const StereoGeometry& geometry = bench_.model.stereo.geometry;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto before = std::chrono::steady_clock::now();
    const auto lifted = localize::lift(geometry, (*seen)[i].features, bench_.localiser);
    const localize::RelocaliseAnswer answer =
        localize::relocalise(geometry, map, (*seen)[i].features, lifted, bench_.localiser, rng);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
    relocalise_ms_.push_back(took.count());
    if (answer.verdict != localize::RelocaliseVerdict::kFound) {
      continue;
    }
    ++found;
    const Pose2 place = localize::base_from_eye(answer.belief.map_T_eye, bench_.localiser.arm);
    if (wrong != nullptr && distance_m(place, poses[i]) > kWrongPlace_m) {
      ++*wrong;
    }
  }
  return {};
}

Status S2Run::relocalise() {
  S2Result& result = record_.result;
  result.places = kPlaces;
  if (Status ok = look_for(world_, kPlaces, result.places_found, &result.places_wrong); !ok) {
    return ok;
  }
  const Result<sim::World> textures = load_laboratory(spec_.config, kForeignTextures + spec_.seed);
  if (!textures) {
    return tl::unexpected<Error>(textures.error());
  }
  Rng rng = rng_.fork("foreign room");
  const Result<sim::World> foreign = move_furniture(*textures, bench_.model, kForeignShare, rng);
  if (!foreign) {
    return tl::unexpected<Error>(foreign.error());
  }
  result.foreign = kForeignViews;
  if (Status ok = look_for(*foreign, kForeignViews, result.foreign_found, nullptr); !ok) {
    return ok;
  }
  const auto middle = relocalise_ms_.begin() + static_cast<std::ptrdiff_t>(relocalise_ms_.size() / 2);
  std::nth_element(relocalise_ms_.begin(), middle, relocalise_ms_.end());
  result.relocalise_ms = *middle;
  return {};
}

}  // namespace

Result<std::string> settings_of(const S2Spec& spec) {
  const SimSpec sim = sim_spec_of(spec);
  Result<app::RobotOptions> options = sim_options(sim);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  TextHash hash;
  if (const Status ok = add_settings(hash, std::move(*options), sim); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  hash.add(spec.paper ? "paper" : "default");
  return hash.hex();
}

Result<S2Record> run_s2(const S2Spec& spec) {
  const Result<app::RobotOptions> options = sim_options(sim_spec_of(spec));
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  Result<sim::World> world = load_laboratory(spec.config, spec.seed);
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  const Bench bench = bench_of(spec, options->sim.robot);
  S2Run run(spec, bench, std::move(*world));
  for (const auto step : {&S2Run::survey_and_drive, &S2Run::change_and_update, &S2Run::relocalise}) {
    if (Status ok = (run.*step)(); !ok) {
      return tl::unexpected<Error>(ok.error());
    }
  }
  S2Record record = run.take();
  record.result.seed = spec.seed;
  record.result.mode = spec.paper ? "paper" : "default";
  return record;
}

}  // namespace seeker::lab
