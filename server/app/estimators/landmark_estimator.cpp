#include "server/app/estimators/landmark_estimator.hpp"

namespace seeker::app {

LandmarkEstimator::LandmarkEstimator(localize::StereoLocaliser localiser, Database database,
                                     const LandmarkEstimatorParams& params, const LandmarkUpdating& updating, Rng rng)
    : localiser_(std::move(localiser)),
      database_(std::move(database)),
      params_(params),
      library_(updating.library),
      rng_(rng),
      geometry_(updating.geometry),
      update_(updating.geometry, params.update),
      updating_(updating.inline_work, "the database of landmarks could not be updated") {
  localiser_.start_anywhere();
}

Status LandmarkEstimator::on_odometry(const drivers::OdometrySample& sample) {
  if (!samples_.empty() && sample.stamp <= samples_.back().stamp) {
    return fail(Errc::kInvalidArgument, "the odometry's time runs backwards; check the clock of the base");
  }
  if (!samples_.empty() && sample.stamp - samples_.back().stamp > params_.odometry_gap) {
    samples_ = {sample};
    return fail(Errc::kTimeout, "the odometry had a gap; the way driven meanwhile is not known");
  }
  samples_.push_back(sample);
  if (!looking_) {
    catch_up();
  }
  return {};
}

void LandmarkEstimator::catch_up() {
  for (std::size_t next = 1; next < samples_.size(); ++next) {
    const drivers::OdometrySample& from = samples_[next - 1];
    const drivers::OdometrySample& to = samples_[next];
    const double tau_s = to_seconds(to.stamp - from.stamp);
    localiser_.predict(twist_between(from.odom_T_base, to.odom_T_base, tau_s), tau_s);
  }
  samples_ = {samples_.back()};
}

bool LandmarkEstimator::wants_look(RobotTime now) const {
  return !looking_ && !samples_.empty() && (!looked_at_ || now - *looked_at_ >= params_.look_period);
}

void LandmarkEstimator::look_begun(RobotTime stamp) {
  looking_ = true;
  looked_at_ = stamp;
}

void LandmarkEstimator::on_look(const Result<StereoLook>& look) {
  looking_ = false;
  if (look) {
    localiser_.update(look->features.features, rng_);
    learn(*look);
  } else {
    localiser_.miss(look.error().message);
    looked_at_ = samples_.empty() ? looked_at_ : samples_.back().stamp;
  }
  if (!samples_.empty()) {
    catch_up();
  }
}

void LandmarkEstimator::learn(const StereoLook& look) {
  if (params_.update_period == Duration::zero()) {
    return;
  }
  end_update();
  localize::Sighting sighting;
  sighting.stamp = look.stamp;
  sighting.map_T_eye = localiser_.belief().map_T_eye;
  sighting.pose_covariance = localiser_.belief().pose_covariance();
  sighting.eye_height_m = localiser_.params().eye_height_m;
  sighting.features = look.features.features;
  update_.observe(*database_, sighting, localiser_.last());
  updated_at_ = updated_at_.value_or(look.stamp);
  const bool due = look.stamp - *updated_at_ >= params_.update_period || update_.full();
  if (due && !updating_.busy()) {
    begin_update(look.stamp);
  }
}

/// What was gathered goes to the worker whole: to make the poses of a drive agree takes longer than a tick may.
void LandmarkEstimator::begin_update(RobotTime now) {
  updated_at_ = now;
  if (update_.frames() == 0) {
    return;
  }
  const auto gathered = std::make_shared<const localize::DatabaseUpdate>(
      std::exchange(update_, localize::DatabaseUpdate(geometry_, params_.update)));
  updating_.start([library = library_, name = params_.database, gathered, known = database_]() -> Result<Updated> {
    Result<localize::StagedUpdate> staged = gathered->stage(*known);
    if (!staged) {
      return tl::unexpected<Error>(staged.error());
    }
    auto database = std::make_shared<const localize::LandmarkDatabase>(std::move(staged->database));
    // What is not on the disk is not used either: after a restart the robot would know another building.
    const Result<api::LandmarkSummary> kept = library->update(name, *database);
    return kept ? Result<Updated>(Updated{std::move(database), staged->counts})
                : Result<Updated>(tl::unexpected<Error>(kept.error()));
  });
  end_update();  // inline: it is done
}

void LandmarkEstimator::end_update() {
  const std::optional<Result<Updated>> done = updating_.take();
  if (!done) {
    return;
  }
  const Status used = *done ? localiser_.use((*done)->database) : Status(tl::unexpected<Error>(done->error()));
  if (!used) {
    news_.push_back("the database of landmarks stays as it is: " + used.error().message);
    return;
  }
  database_ = (*done)->database;
  const localize::UpdateCounts& counts = (*done)->counts;
  news_.push_back("the database of landmarks is updated: " + std::to_string(counts.before) + " + " +
                  std::to_string(counts.added) + " - " + std::to_string(counts.removed) + " = " +
                  std::to_string(counts.after));
}

Status LandmarkEstimator::place_at(const PoseEstimate& place) {
  return localiser_.start_at(place.map_T_base, place.covariance);
}

PoseEstimate LandmarkEstimator::estimate() const {
  if (samples_.empty()) {
    return localiser_.estimate(RobotTime());
  }
  PoseEstimate estimate = localiser_.estimate(samples_.back().stamp);
  // Motion that the localiser has not been told yet; its noise is added when it has.
  estimate.map_T_base = estimate.map_T_base * (inverse(samples_.front().odom_T_base) * samples_.back().odom_T_base);
  return estimate;
}

}  // namespace seeker::app
