#include "server/lab/stereo_database/stereo_parts.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "server/localize/survey_adjustment.hpp"

namespace seeker::lab::stereo {
namespace {

// The survey's tripod stands where it should to a centimetre, and its dial is read to a third of a degree.
constexpr double kTripodSigma_m = 0.01;
constexpr double kDialSigma_rad = deg_to_rad(0.3);

/// Time that the processor has spent on this thread: other programs do not count.
double thread_ms() {
  constexpr double kPerSecond = 1e3;
  constexpr double kPerNanosecond = 1e-6;
  std::timespec now{};
  static_cast<void>(::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now));
  return kPerSecond * static_cast<double>(now.tv_sec) + kPerNanosecond * static_cast<double>(now.tv_nsec);
}

}  // namespace

Bench bench_of(const app::RobotOptions& options) {
  const sim::RobotModel& model = options.sim.robot;
  Bench bench{model, options.stereo.features, options.stereo.database, options.stereo.localiser,
              options.stereo.estimator.update};
  const Pose2& eye = model.stereo.base_T_left_eye;
  bench.localiser.arm = {eye.x_m, eye.y_m, eye.theta_rad};
  bench.localiser.eye_height_m = model.stereo.height_m;
  return bench;
}

SurveyPictures photograph_survey(const sim::World& world, const sim::RobotModel& model, Rng& rng) {
  SurveyPictures pictures;
  pictures.world_T_eyes = survey_poses(world, model);
  std::vector<Pose2> bases;
  bases.reserve(pictures.world_T_eyes.size());
  for (const Pose2& eye : pictures.world_T_eyes) {
    bases.push_back(eye * inverse(model.stereo.base_T_left_eye));
  }
  pictures.pairs = photograph_from(world, model, bases, rng);
  return pictures;
}

Result<std::vector<localize::Sighting>> survey_views(const Bench& bench, const std::vector<Pose2>& world_T_eyes,
                                                     const std::vector<vision::StereoFeatures>& seen, Rng& rng) {
  std::vector<localize::Sighting> views(world_T_eyes.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Pose2& truth = world_T_eyes[i];
    views[i].map_T_eye = {truth.x_m + rng.normal(kTripodSigma_m), truth.y_m + rng.normal(kTripodSigma_m),
                          truth.theta_rad + rng.normal(kDialSigma_rad)};
    views[i].pose_covariance = Eigen::Vector3d(kTripodSigma_m * kTripodSigma_m, kTripodSigma_m * kTripodSigma_m,
                                               kDialSigma_rad * kDialSigma_rad)
                                   .asDiagonal();
    views[i].eye_height_m = bench.model.stereo.height_m;
    views[i].features = seen[i].features;
  }
  const auto adjusted = localize::adjust_poses(bench.model.stereo.geometry, bench.database, views);
  if (!adjusted) {
    return tl::unexpected<Error>(adjusted.error());
  }
  return views;
}

Result<Built> build(const Bench& bench, const std::vector<localize::Sighting>& views, bool sparse, bool salient) {
  localize::DatabaseParams params = bench.database;
  params.sparsity.on = sparse;
  params.salient_seen = salient ? params.salient_seen : 1;
  localize::SurveyBuilder builder(bench.model.stereo.geometry, params);
  Built built;
  for (const localize::Sighting& view : views) {
    const Result<localize::SightingCounts> counts = builder.add(view);
    if (!counts) {
      return tl::unexpected<Error>(counts.error());
    }
    built.counts.push_back(*counts);
    built.sizes.push_back(builder.database().size());
    built.fates.push_back({builder.fates(), builder.landmarks()});
  }
  built.database = std::make_shared<const localize::LandmarkDatabase>(builder.salient());
  return built;
}

double share_inside(const localize::LandmarkDatabase& database, const sim::World& world) {
  constexpr double kSlack_m = 0.1;
  const auto inside = [&](const localize::Landmark& landmark) {
    const Point2 p = landmark.p_map.head<2>();
    return ((p - world.min_corner).array() >= -kSlack_m).all() && ((p - world.max_corner).array() <= kSlack_m).all();
  };
  const auto& landmarks = database.landmarks();
  return static_cast<double>(std::count_if(landmarks.begin(), landmarks.end(), inside)) /
         static_cast<double>(std::max<std::size_t>(1, landmarks.size()));
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
    const double before_ms = thread_ms();
    const localize::LocaliserStep& step = localiser->update(frame.seen.features, rng);
    steps_ms_.push_back(thread_ms() - before_ms);
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
  std::vector<std::size_t>& matched = matched_.emplace_back();
  for (const localize::FrameMatch& match : localiser.last().inliers) {
    matched.push_back(match.feature);
  }
  curve_.samples.push_back({frame_period_s_ * score_.frames, error(0), error(1), error(2)});
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
