#include "server/app/missions/localise_behaviour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "common/core/angle.hpp"

namespace seeker::app {
namespace {

/// Chance is only used to try pairs of matches: one seed is as good as another, and the same run is the same again.
constexpr std::uint64_t kSeed = 1;

std::string text_of(const Pose2& pose) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "(%.2f, %.2f) m, heading %.1f degrees", pose.x_m, pose.y_m,
                rad_to_deg(pose.theta_rad));
  return text.data();
}

}  // namespace

Result<std::unique_ptr<Behaviour>> LocaliseBehaviour::create(const LocaliseSettings& settings,
                                                             const api::LocaliseMission& mission,
                                                             const LandmarkLibrary& library,
                                                             const Situation& situation) {
  if (!situation.has_stereo) {
    return fail(Errc::kRefused, "this robot has no stereo camera to localise with");
  }
  const Result<LoadedLandmarks> loaded = library.load(mission.landmarks);
  if (!loaded) {
    return tl::unexpected<Error>(loaded.error());
  }
  Result<localize::StereoLocaliser> core =
      localize::StereoLocaliser::create(settings.geometry, loaded->database, settings.localiser);
  if (!core) {
    return fail_with_context("database '" + mission.landmarks + "'", core.error());
  }
  const std::string& map = loaded->summary.map_name;
  const bool places_robot =
      mission.landmarks == settings.estimator_database || (!map.empty() && map == situation.map_name);
  // A map without a name may be the one of the survey or not: nobody knows.
  return std::unique_ptr<Behaviour>(new LocaliseBehaviour(settings.look, mission, std::move(*core), places_robot,
                                                          places_robot ? "" : map, situation));
}

LocaliseBehaviour::LocaliseBehaviour(const RotateAndLookParams& params, api::LocaliseMission mission,
                                     localize::StereoLocaliser localiser, bool places_robot, std::string other_map,
                                     const Situation& situation)
    : mission_(std::move(mission)),
      localiser_(std::move(localiser)),
      places_robot_(places_robot),
      other_map_(std::move(other_map)),
      sweep_(params),
      rng_(kSeed) {
  localiser_.start_anywhere();
  sweep_.start(situation.odom_T_base, mission_.headings);
}

void LocaliseBehaviour::follow_odometry(const Situation& situation) {
  if (moved_at_ && situation.now > *moved_at_) {
    const Twist2 velocity = twist_between(odom_T_base_, situation.odom_T_base, to_seconds(situation.now - *moved_at_));
    localiser_.predict(velocity, to_seconds(situation.now - *moved_at_));
  }
  moved_at_ = situation.now;
  odom_T_base_ = situation.odom_T_base;
}

Decision LocaliseBehaviour::step(const Situation& situation) {
  follow_odometry(situation);
  Decision decision;
  decision.phase = "look";
  decision.progress = static_cast<double>(sweep_.index()) / static_cast<double>(sweep_.headings());
  if (localiser_.last().quality == LocalisationQuality::kLocalised) {
    found(situation, decision);
    return decision;
  }
  if (!sweep_.active()) {
    decision.end =
        api::MissionEnd{.outcome = api::Outcome::kLost,
                        .cause = "none of " + std::to_string(sweep_.headings()) + " directions showed a place of '" +
                                 mission_.landmarks + "' for certain (at most " + std::to_string(most_inliers_) +
                                 " landmarks agreed): " + last_cause_,
                        .remedy = "drive the robot to where more of the surveyed building is seen, or survey it anew",
                        .unreachable = {}};
    return decision;
  }
  decision.activity = "looking for landmarks of '" + mission_.landmarks + "', direction " +
                      std::to_string(sweep_.index() + 1) + " of " + std::to_string(sweep_.headings());
  sweep_.step(situation.odom_T_base, situation, decision);
  return decision;
}

void LocaliseBehaviour::found(const Situation& situation, Decision& decision) {
  const PoseEstimate place = localiser_.estimate(situation.now);
  const double sigma_m = std::sqrt(place.covariance.topLeftCorner<2, 2>().trace());
  if (places_robot_) {
    decision.place = place;
  }
  decision.end = api::MissionEnd{
      .outcome = api::Outcome::kComplete,
      .cause = "the robot is at " + text_of(place.map_T_base) + " in the frame of '" + mission_.landmarks +
               "': " + std::to_string(localiser_.last().inliers.size()) + " landmarks agree, sigma " +
               std::to_string(static_cast<int>(std::ceil(1000.0 * sigma_m))) + " mm" +
               (places_robot_ ? "" : "; where it is in its own map stays as it was"),
      .remedy = other_map_.empty()
                    ? ""
                    : "the landmarks were surveyed in the map '" + other_map_ +
                          "', which is not in use; 'seeker map load " + other_map_ + "' has the robot drive by it",
      .unreachable = {}};
}

void LocaliseBehaviour::on_look(const Result<StereoLook>& look) {
  if (!look) {
    last_cause_ = look.error().message;
    sweep_.failed();
    return;
  }
  const localize::LocaliserStep& step = localiser_.update(look->features.features, rng_);
  most_inliers_ = std::max(most_inliers_, static_cast<int>(step.inliers.size()));
  last_cause_ = step.cause;
  sweep_.looked();
}

void LocaliseBehaviour::resumed(RobotTime /*now*/) { sweep_.resumed(); }

}  // namespace seeker::app
