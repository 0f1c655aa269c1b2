#include "server/lab/stereo_database/stereo_places.hpp"

#include <chrono>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/localize/landmark_map.hpp"
#include "server/localize/relocaliser.hpp"

namespace seeker::lab::stereo {
namespace {

bool is_wrong(const Pose2& reported, const Pose2& truth) {
  return distance_m(reported, truth) > kWrongPlace_m ||
         std::abs(wrap_angle(reported.theta_rad - truth.theta_rad)) > kWrongPlace_rad;
}

/// The whole database is asked for the place of one view.
class OneView {
 public:
  OneView(const Bench& bench, const Database& database) : bench_(bench), map_(database, bench.localiser) {}

  /// Of the base; nothing where no place is certain.
  std::optional<Pose2> ask(const vision::StereoFeatures& seen, Rng& rng) {
    const StereoGeometry& geometry = bench_.model.stereo.geometry;
    const auto before = std::chrono::steady_clock::now();
    const auto lifted = localize::lift(geometry, seen.features, bench_.localiser);
    const localize::RelocaliseAnswer answer =
        localize::relocalise(geometry, map_, seen.features, lifted, bench_.localiser, rng);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
    took_ms_ = took.count();
    if (answer.verdict != localize::RelocaliseVerdict::kFound) {
      return std::nullopt;
    }
    return localize::base_from_eye(answer.belief.map_T_eye, bench_.localiser.arm);
  }
  [[nodiscard]] double took_ms() const { return took_ms_; }

 private:
  const Bench& bench_;
  localize::LandmarkMap map_;
  double took_ms_ = 0.0;
};

/// One observation as in the mission: rejected pictures give the localiser no information.
Status look(SeeingRobot& robot, localize::StereoLocaliser& localiser, OneView& one_view, Awakening& out, Rng& rng) {
  Result<vision::StereoFeatures> seen = robot.look();
  ++out.looks;
  if (!seen && seen.error().code != Errc::kInvalidArgument) {
    return tl::unexpected<Error>(seen.error());
  }
  if (!seen) {
    ++out.refused;
    return {};
  }
  if (out.looks == 1) {
    const auto place = one_view.ask(*seen, rng);
    out.at_once = place.has_value();
    out.at_once_wrong = place && is_wrong(*place, robot.world_T_base());
    out.relocalise_ms = one_view.took_ms();
  }
  out.found = localiser.update(seen->features, rng).quality == LocalisationQuality::kLocalised;
  out.wrong = out.found && is_wrong(localiser.estimate({}).map_T_base, robot.world_T_base());
  return {};
}

}  // namespace

Result<Awakening> wake_up(const Bench& bench, const Database& database, const sim::World& world,
                          const Pose2& world_T_base, std::uint64_t seed) {
  Result<SeeingRobot> robot = SeeingRobot::create(world, bench.model, bench.features, world_T_base, seed);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  Result<localize::StereoLocaliser> localiser =
      localize::StereoLocaliser::create(bench.model.stereo.geometry, database, bench.localiser);
  if (!localiser) {
    return tl::unexpected<Error>(localiser.error());
  }
  OneView one_view(bench, database);
  Rng rng(seed);
  Awakening out;
  while (true) {
    if (Status ok = look(*robot, *localiser, one_view, out, rng); !ok) {
      return tl::unexpected<Error>(ok.error());
    }
    if (out.found || out.looks == kPlaceHeadings) {
      return out;
    }
    for (const Twist2& velocity : robot->rotate(kTwoPi / kPlaceHeadings)) {
      localiser->predict(velocity, kEncoderPeriod_s);
    }
  }
}

Result<ForeignViews> observe_foreign(const Bench& bench, const Database& database, const sim::World& world, int views,
                                     Rng& rng) {
  const std::vector<Pose2> poses = random_poses(world, bench.model, views, rng);
  const auto seen = look_from(world, bench.model, bench.features, poses, rng);
  if (!seen) {
    return tl::unexpected<Error>(seen.error());
  }
  OneView one_view(bench, database);
  ForeignViews out;
  for (const vision::StereoFeatures& view : *seen) {
    out.found += one_view.ask(view, rng) ? 1 : 0;
    out.empty += view.features.empty() ? 1 : 0;
    out.relocalise_ms.push_back(one_view.took_ms());
  }
  return out;
}

}  // namespace seeker::lab::stereo
