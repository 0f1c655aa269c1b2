#include "server/lab/stereo_database/stereo_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/options/world_options.hpp"
#include "server/sim/rearrange.hpp"
#include "server/sim/scene.hpp"
#include "server/sim/stereo_renderer.hpp"

namespace seeker::lab {
namespace {

constexpr double kSpeed_m_s = 0.07;  ///< spec S2.11
constexpr double kRotation_rad_s = 0.23;
constexpr double kClearance_m = 0.35;  ///< of a place to stand at
constexpr double kPosterDepth_m = 0.05;

/// Places free of furniture in the laboratory, with some margin; the start of spec S2.11 is the paper's.
std::vector<Point2> places_of_drive() { return {{4.4, 6.7}, {3.5, 4.6}, {2.1, 4.2}, {2.36, 6.79}}; }

/// Whether the path of the drive is free.
bool path_is_free(const sim::World& world, const sim::RobotModel& model) {
  constexpr double kStep_m = 0.1;
  const sim::Scene scene(world);
  const sim::HeightBand body{0.0, model.body_height_m};
  std::vector<Point2> path = places_of_drive();
  path.insert(path.begin(), world.starts.front().translation());
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point2 leg = path[i] - path[i - 1];
    for (double s = 0.0; s <= 1.0; s += kStep_m / leg.norm()) {
      if (scene.clearance_m(path[i - 1] + s * leg, kClearance_m, body) < kClearance_m) {
        return false;
      }
    }
  }
  return true;
}

/// Takes pictures at poses of the base.
class Eyes {
 public:
  Eyes(const sim::World& world, const sim::RobotModel& model) : world_(world), scene_(world), renderer_(model.stereo) {}

  StereoFrame photograph(const Pose2& world_T_base, Rng& rng) {
    const double exposure = std::max(0.0, 1.0 + rng.normal(world_.lighting.exposure_jitter));
    return renderer_.render(scene_, world_.lighting, world_T_base, exposure, rng);
  }

 private:
  const sim::World& world_;
  sim::Scene scene_;
  sim::StereoRenderer renderer_;
};

/// Rotates on the spot, then drives straight, from place to place.
class Driver {
 public:
  explicit Driver(std::vector<Point2> places) : places_(std::move(places)) {}

  /// Nothing at the end of the path.
  std::optional<Twist2> steer(const Pose2& world_T_base) {
    constexpr double kThere_m = 0.1;
    constexpr double kAligned_rad = 0.03;
    constexpr double kMisaligned_rad = 0.3;
    constexpr double kGain = 0.5;
    while (next_ < places_.size() && (places_[next_] - world_T_base.translation()).norm() < kThere_m) {
      ++next_;
      rotating_ = true;
    }
    if (next_ == places_.size()) {
      return std::nullopt;
    }
    const double error_rad = bearing_to(world_T_base, places_[next_]);
    rotating_ = std::abs(error_rad) > (rotating_ ? kAligned_rad : kMisaligned_rad);
    return rotating_ ? Twist2{0.0, std::copysign(kRotation_rad_s, error_rad)}
                     : Twist2{kSpeed_m_s, std::clamp(kGain * error_rad, -kRotation_rad_s, kRotation_rad_s)};
  }

 private:
  std::vector<Point2> places_;
  std::size_t next_ = 0;
  bool rotating_ = true;
};

}  // namespace

Result<SeeingRobot> SeeingRobot::create(sim::World world, const sim::RobotModel& model,
                                        const vision::StereoFeatureParams& features, const Pose2& start,
                                        std::uint64_t seed) {
  world.starts = {start};
  Result<sim::Simulation> simulation = sim::Simulation::create(std::move(world), model, seed);
  if (!simulation) {
    return tl::unexpected<Error>(simulation.error());
  }
  return SeeingRobot(std::move(*simulation), vision::make_stereo_extractor(model.stereo.geometry, features));
}

Twist2 SeeingRobot::move(const Twist2& wanted) {
  simulation_.command(wanted);
  simulation_.advance(seconds(kEncoderPeriod_s));
  const Pose2 before = std::exchange(odom_T_base_, simulation_.odometry().odom_T_base);
  return twist_between(before, odom_T_base_, kEncoderPeriod_s);
}

std::vector<Twist2> SeeingRobot::rotate(double by_rad) {
  constexpr double kAligned_rad = 0.01;
  constexpr double kGain = 2.0;
  constexpr int kLongest = 600;  // periods
  const double wanted_rad = odom_T_base_.theta_rad + by_rad;
  std::vector<Twist2> velocities;
  for (int i = 0; i < kLongest; ++i) {
    const double error_rad = wrap_angle(wanted_rad - odom_T_base_.theta_rad);
    if (std::abs(error_rad) < kAligned_rad) {
      break;
    }
    velocities.push_back(move({0.0, std::clamp(kGain * error_rad, -kRotation_rad_s, kRotation_rad_s)}));
  }
  velocities.push_back(move({}));
  return velocities;
}

Result<vision::StereoFeatures> SeeingRobot::look() { return extractor_->extract(simulation_.stereo_pair()); }

Result<vision::StereoFeatures> or_empty(Result<vision::StereoFeatures> seen) {
  return seen || seen.error().code != Errc::kInvalidArgument ? seen : vision::StereoFeatures{};
}

Result<sim::World> load_laboratory(const std::filesystem::path& config, std::uint64_t pattern_seed) {
  return options::load_world(config / "worlds" / "laboratory.yaml", {"pattern_seed=" + std::to_string(pattern_seed)});
}

Result<sim::World> move_furniture(const sim::World& world, const sim::RobotModel& model, double share, Rng& rng) {
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    sim::World moved = world;
    if (const Result<std::size_t> objects = sim::move_objects(moved, share, rng); !objects) {
      return tl::unexpected<Error>(objects.error());
    }
    if (path_is_free(moved, model)) {
      return moved;
    }
  }
  return fail(Errc::kUnreachable, "moved furniture blocks the robot's path in every arrangement");
}

std::vector<Pose2> survey_poses(const sim::World& world, const sim::RobotModel& model) {
  constexpr int kHeadings = 12;
  const sim::Scene scene(world);
  const std::array<Point2, 5> wanted = {Point2(2.4, 6.8), Point2(2.2, 3.0), Point2(5.4, 2.6), Point2(8.0, 5.0),
                                        Point2(5.6, 7.4)};
  std::vector<Pose2> poses;
  for (const Point2& place : wanted) {
    // The nearest place with room for a tripod, on growing circles.
    Point2 free = place;
    const sim::HeightBand tripod{0.0, model.stereo.height_m};
    for (int i = 0; i < 400 && scene.clearance_m(free, kClearance_m, tripod) < kClearance_m; ++i) {
      const double radius_m = 0.005 * i;
      free = place + radius_m * Point2(std::cos(0.7 * i), std::sin(0.7 * i));
    }
    for (int k = 0; k < kHeadings; ++k) {
      poses.push_back({free.x(), free.y(), wrap_angle(k * kTwoPi / kHeadings)});
    }
  }
  return poses;
}

std::vector<Pose2> random_poses(const sim::World& world, const sim::RobotModel& model, int count, Rng& rng) {
  const sim::Scene scene(world);
  const sim::HeightBand body{0.0, model.stereo.height_m};
  std::vector<Pose2> poses;
  while (static_cast<int>(poses.size()) < count) {
    const Pose2 pose{rng.uniform(world.min_corner.x(), world.max_corner.x()),
                     rng.uniform(world.min_corner.y(), world.max_corner.y()), rng.uniform(-kPi, kPi)};
    if (scene.clearance_m(pose.translation(), kClearance_m, body) >= kClearance_m) {
      poses.push_back(pose);
    }
  }
  return poses;
}

std::vector<StereoFrame> photograph_from(const sim::World& world, const sim::RobotModel& model,
                                         const std::vector<Pose2>& world_T_bases, Rng& rng) {
  Eyes eyes(world, model);
  std::vector<StereoFrame> pairs;
  pairs.reserve(world_T_bases.size());
  for (const Pose2& pose : world_T_bases) {
    pairs.push_back(eyes.photograph(pose, rng));
  }
  return pairs;
}

Result<std::vector<vision::StereoFeatures>> features_of(const std::vector<StereoFrame>& pairs,
                                                        const sim::RobotModel& model,
                                                        const vision::StereoFeatureParams& params) {
  const auto extractor = vision::make_stereo_extractor(model.stereo.geometry, params);
  std::vector<vision::StereoFeatures> seen;
  seen.reserve(pairs.size());
  for (const StereoFrame& pair : pairs) {
    Result<vision::StereoFeatures> one = or_empty(extractor->extract(pair));
    if (!one) {
      return tl::unexpected<Error>(one.error());
    }
    seen.push_back(std::move(*one));
  }
  return seen;
}

Result<std::vector<vision::StereoFeatures>> look_from(const sim::World& world, const sim::RobotModel& model,
                                                      const vision::StereoFeatureParams& features,
                                                      const std::vector<Pose2>& world_T_bases, Rng& rng) {
  Eyes eyes(world, model);
  const auto extractor = vision::make_stereo_extractor(model.stereo.geometry, features);
  std::vector<vision::StereoFeatures> seen;
  seen.reserve(world_T_bases.size());
  for (const Pose2& pose : world_T_bases) {
    Result<vision::StereoFeatures> one = or_empty(extractor->extract(eyes.photograph(pose, rng)));
    if (!one) {
      return tl::unexpected<Error>(one.error());
    }
    seen.push_back(std::move(*one));
  }
  return seen;
}

Result<std::vector<DriveFrame>> photograph_drive(const sim::World& world, const sim::RobotModel& model,
                                                 std::uint64_t seed, double period_s) {
  constexpr double kLongest_s = 600.0;
  Result<SeeingRobot> robot = SeeingRobot::create(world, model, {}, world.starts.front(), seed);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  Driver driver(places_of_drive());
  std::vector<DriveFrame> frames;
  std::vector<Twist2> velocities;
  double next_frame_s = 0.0;
  while (robot->time_s() < kLongest_s) {
    const Pose2 truth = robot->world_T_base();
    const auto wanted = driver.steer(truth);
    if (robot->time_s() >= next_frame_s || !wanted) {
      frames.push_back({truth, std::exchange(velocities, {}), robot->photograph(), {}});
      next_frame_s += period_s;
    }
    if (!wanted) {
      return frames;
    }
    velocities.push_back(robot->move(*wanted));
  }
  return fail(Errc::kTimeout, "the drive does not end: an object blocks its path");
}

std::vector<std::size_t> kept_frames(std::size_t frames) {
  return {frames / 8, 3 * frames / 8, 5 * frames / 8, 7 * frames / 8};
}

Result<std::vector<DriveFrame>> drive_around(const sim::World& world, const sim::RobotModel& model,
                                             const vision::StereoFeatureParams& features, std::uint64_t seed,
                                             double period_s) {
  Result<std::vector<DriveFrame>> frames = photograph_drive(world, model, seed, period_s);
  if (!frames) {
    return frames;
  }
  const auto extractor = vision::make_stereo_extractor(model.stereo.geometry, features);
  const std::vector<std::size_t> kept = kept_frames(frames->size());
  for (std::size_t i = 0; i < frames->size(); ++i) {
    DriveFrame& frame = (*frames)[i];
    Result<vision::StereoFeatures> seen = or_empty(extractor->extract(frame.pair));
    if (!seen) {
      return tl::unexpected<Error>(seen.error());
    }
    frame.seen = std::move(*seen);
    if (std::find(kept.begin(), kept.end(), i) == kept.end()) {
      frame.pair = {};
    }
  }
  return frames;
}

}  // namespace seeker::lab
