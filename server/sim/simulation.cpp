#include "server/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/sim/body_motion.hpp"
#include "server/sim/omni_renderer.hpp"
#include "server/sim/range_sensors.hpp"
#include "server/sim/scene.hpp"
#include "server/sim/stereo_renderer.hpp"

namespace seeker::sim {
namespace {

constexpr Duration kMaxStep = std::chrono::milliseconds(10);
constexpr double kSecondsPerHour = 3600.0;

}  // namespace

struct Simulation::State {
  State(World w, RobotModel m, std::uint64_t seed, const Pose2& start)
      : world(std::move(w)),
        model(std::move(m)),
        scene(world),
        body(start),
        world_T_start(start),
        root(seed),
        odometry_rng(root.fork("odometry")),
        lidar_rng(root.fork("lidar")),
        sonar_rng(root.fork("sonar")),
        camera_rng(root.fork("omni")),
        stereo_rng(root.fork("stereo")) {
    if (world.people_walk) {
      for (std::size_t i = 0; i < world.people.size(); ++i) {
        walkers.emplace_back(world.people[i], i);
      }
    }
    publish_people();
  }

  void publish_people() {
    std::vector<Disc> discs;
    for (const Walker& walker : walkers) {
      discs.push_back(walker.disc());
    }
    scene.set_people(std::move(discs));
  }

  void step(Duration period) {
    const double dt_s = to_seconds(period);
    if (!walkers.empty()) {
      for (Walker& walker : walkers) {
        walker.step(body.world_T_base().translation(), model.radius_m, dt_s);
      }
      publish_people();
    }
    const Twist2 happened = body.step(wanted, model, scene, dt_s);
    encoders.step(happened, dt_s, model, odometry_rng);
    now += period;
  }

  /// Of one picture: the lamps swing, and the camera does not set itself the same twice.
  double exposure(Rng& rng) const {
    const Lighting& light = world.lighting;
    const double swing = std::sin(kTwoPi * to_seconds(now) / light.flicker_period_s);
    return std::max(0.0, 1.0 + light.flicker * swing + rng.normal(light.exposure_jitter));
  }

  World world;
  RobotModel model;
  Scene scene;
  BodyMotion body;
  Encoders encoders;
  std::vector<Walker> walkers;
  Pose2 world_T_start;
  Twist2 wanted;
  RobotTime now;
  Rng root;
  Rng odometry_rng;
  Rng lidar_rng;
  Rng sonar_rng;
  Rng camera_rng;
  Rng stereo_rng;
  std::unique_ptr<OmniRenderer> omni;  ///< made with the first picture: its tables are large
  std::unique_ptr<StereoRenderer> stereo;
};

Simulation::Simulation(std::unique_ptr<State> state) : state_(std::move(state)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Result<Simulation> Simulation::create(World world, RobotModel model, std::uint64_t seed, std::size_t start) {
  if (const Status valid = validate(world); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  if (const Status valid = validate(model); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  if (start >= world.starts.size()) {
    return fail(Errc::kInvalidArgument, "world '" + world.name + "' has " + std::to_string(world.starts.size()) +
                                            " start poses; number " + std::to_string(start) + " is not one of them");
  }
  const Pose2 world_T_start = world.starts[start];
  auto state = std::make_unique<State>(std::move(world), std::move(model), seed, world_T_start);
  const double reach_m = state->model.radius_m;
  if (state->scene.clearance_m(world_T_start.translation(), 2.0 * reach_m, body_band(state->model)) < reach_m) {
    return fail(Errc::kInvalidArgument, "world '" + state->world.name + "': start " + std::to_string(start) +
                                            " leaves no room for a robot of radius " + std::to_string(reach_m) +
                                            " m; move it away from walls and furniture");
  }
  return Simulation(std::move(state));
}

void Simulation::command(const Twist2& velocity) {
  SEEKER_ASSERT(std::isfinite(velocity.v_m_s) && std::isfinite(velocity.omega_rad_s));
  state_->wanted = velocity;
}

void Simulation::advance(Duration period) {
  while (period > Duration::zero()) {
    const Duration step = std::min(period, kMaxStep);
    state_->step(step);
    period -= step;
  }
}

RobotTime Simulation::now() const { return state_->now; }

BaseReading Simulation::odometry() const {
  const State& s = *state_;
  const double hours = to_seconds(s.now) / kSecondsPerHour;
  return {s.encoders.odom_T_base(), s.encoders.velocity(), s.model.battery_v - hours * s.model.battery_drain_v_per_h,
          s.body.blocked(), s.body.touching()};
}

LaserScan Simulation::scan() {
  return sweep(state_->model.lidar, state_->scene, state_->body.world_T_base(), state_->now, state_->lidar_rng);
}

SonarScan Simulation::sonar() {
  return ping(state_->model.sonar, state_->scene, state_->body.world_T_base(), state_->now, state_->sonar_rng);
}

Image Simulation::omni_image() {
  State& s = *state_;
  if (!s.omni) {
    s.omni = std::make_unique<OmniRenderer>(s.model);
  }
  const double exposure = s.exposure(s.camera_rng);
  return s.omni->render(s.scene, s.world.lighting, s.body.world_T_base(), exposure, s.camera_rng);
}

StereoFrame Simulation::stereo_pair() {
  State& s = *state_;
  if (!s.stereo) {
    s.stereo = std::make_unique<StereoRenderer>(s.model.stereo);
  }
  const double exposure = s.exposure(s.stereo_rng);
  StereoFrame frame = s.stereo->render(s.scene, s.world.lighting, s.body.world_T_base(), exposure, s.stereo_rng);
  frame.stamp = s.now;
  return frame;
}

GroundTruth Simulation::truth() const {
  const State& s = *state_;
  GroundTruth truth{s.body.world_T_base(),
                    s.world_T_start,
                    s.body.velocity(),
                    s.body.contacts(),
                    s.body.path_length_m(),
                    s.body.min_clearance_m(),
                    {}};
  for (const Target& target : s.world.targets) {
    truth.targets.push_back({target.name, target.world_T_target});
  }
  return truth;
}

const World& Simulation::world() const { return state_->world; }
const RobotModel& Simulation::model() const { return state_->model; }

}  // namespace seeker::sim
