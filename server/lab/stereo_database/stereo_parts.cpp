#include "server/lab/stereo_database/stereo_parts.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "server/localize/survey_adjustment.hpp"

namespace seeker::lab::stereo {
namespace {

// The survey's tripod stands where it should to a centimetre, and its dial is read to a third of a degree.
constexpr double kTripodSigma_m = 0.01;
constexpr double kDialSigma_rad = deg_to_rad(0.3);

}  // namespace

Bench bench_of(const StereoSpec& spec, const app::RobotOptions& options) {
  const sim::RobotModel& model = options.sim.robot;
  Bench bench{model, options.stereo.features, options.stereo.database, options.stereo.localiser,
              options.stereo.estimator.update};
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
  const auto adjusted = localize::adjust_poses(bench.model.stereo.geometry, bench.database, views);
  if (!adjusted) {
    return tl::unexpected<Error>(adjusted.error());
  }
  return views;
}

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
  auto database = std::make_shared<const localize::LandmarkDatabase>(builder.salient());
  if (table2 != nullptr) {
    table2->add({"end", "", "", "", "", "", std::to_string(database->size())});  // seen seldom, or too close together
  }
  return database;
}

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
  const Eigen::Vector3d error = offset_of(estimate.map_T_base, frame.world_T_base);
  const bool localised = estimate.quality == LocalisationQuality::kLocalised;
  const bool wrong = error.head<2>().norm() > kUnnoticed_m || std::abs(error(2)) > kUnnoticed_rad;
  score_.not_localised += localised ? 0 : 1;
  score_.unnoticed += localised && wrong ? 1 : 0;
  score_.mean_nees += error.dot(estimate.covariance.inverse() * error);
  score_.mean_inliers += static_cast<double>(localiser.last().inliers.size());
  score_.mean_compared += localiser.last().in_range * static_cast<double>(localiser.last().expected.size());
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
  score_.mean_compared /= count;
  const auto middle = steps_ms_.begin() + static_cast<std::ptrdiff_t>(steps_ms_.size() / 2);
  std::nth_element(steps_ms_.begin(), middle, steps_ms_.end());
  score_.median_step_ms = *middle;
}

}  // namespace seeker::lab::stereo
