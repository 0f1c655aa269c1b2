#include "server/drivers/sim/sim_devices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace seeker::drivers {
namespace {

/// True, and remembers the moment, when a device's period has passed since its last sample.
bool due(std::optional<RobotTime>& last_sample, RobotTime now, Duration period) {
  if (last_sample && now - *last_sample < period) {
    return false;
  }
  last_sample = now;
  return true;
}

tl::unexpected<Error> not_active(const char* device) {
  return fail(Errc::kNotReady, std::string("the simulated ") + device + " is not active; activate it first");
}

constexpr const char* kStereoDead = "the simulated stereo camera does not answer; check its cable";
constexpr std::uint8_t kWhite = 255;

Image half_size(const Image& image) {
  Image half(image.width_px() / 2, image.height_px() / 2, 1);
  for (int v = 0; v < half.height_px(); ++v) {
    for (int u = 0; u < half.width_px(); ++u) {
      *half.at(u, v) = *image.at(2 * u, 2 * v);
    }
  }
  return half;
}

/// Mean over a square around each pixel, cut at the border: by sums along rows, then along columns.
Image blurred(const Image& image) {
  constexpr int kRadius_px = 12;
  Image out = image;
  const auto pass = [&](int length, int count, const auto& at) {
    std::vector<int> sums(static_cast<std::size_t>(length) + 1, 0);
    for (int line = 0; line < count; ++line) {
      for (int i = 0; i < length; ++i) {
        sums[static_cast<std::size_t>(i) + 1] = sums[static_cast<std::size_t>(i)] + *at(i, line);
      }
      for (int i = 0; i < length; ++i) {
        const int low = std::max(0, i - kRadius_px);
        const int high = std::min(length, i + kRadius_px + 1);
        const int sum = sums[static_cast<std::size_t>(high)] - sums[static_cast<std::size_t>(low)];
        *at(i, line) = static_cast<std::uint8_t>(sum / (high - low));
      }
    }
  };
  pass(image.width_px(), image.height_px(), [&out](int u, int v) { return out.at(u, v); });
  pass(image.height_px(), image.width_px(), [&out](int v, int u) { return out.at(u, v); });
  return out;
}

void spoil(StereoFrame& frame, StereoFault fault, const Image& last_right) {
  switch (fault) {
    case StereoFault::kNone: return;
    case StereoFault::kSwapped: std::swap(frame.left, frame.right); return;
    case StereoFault::kBlack: std::fill(frame.left.data().begin(), frame.left.data().end(), std::uint8_t{0}); return;
    case StereoFault::kSaturated: std::fill(frame.right.data().begin(), frame.right.data().end(), kWhite); return;
    case StereoFault::kBlurred: frame.left = blurred(frame.left); return;
    case StereoFault::kHalfSize:
      frame.left = half_size(frame.left);
      frame.right = half_size(frame.right);
      return;
    case StereoFault::kStale:
      if (!last_right.empty()) {
        frame.right = last_right;
      }
      return;
  }
}

}  // namespace

SimBase::SimBase(std::shared_ptr<sim::Simulation> simulation, std::shared_ptr<const SimFaults> faults,
                 const SimDeviceParams& params)
    : simulation_(std::move(simulation)), faults_(std::move(faults)), params_(params) {}

Status SimBase::activate() {
  active_ = true;
  motors_ = false;
  moving_ = false;
  last_sample_.reset();
  simulation_->command({});
  odom_T_activation_ = simulation_->odometry().odom_T_base;
  return {};
}

void SimBase::deactivate() {
  simulation_->command({});
  active_ = false;
  motors_ = false;
  moving_ = false;
}

Result<std::optional<OdometrySample>> SimBase::read() {
  if (!active_) {
    return not_active("base");
  }
  const RobotTime now = simulation_->now();
  if (faults_->base_silent || !due(last_sample_, now, params_.base_period)) {
    return std::nullopt;
  }
  const sim::BaseReading reading = simulation_->odometry();
  OdometrySample sample;
  sample.stamp = now;
  sample.odom_T_base = inverse(odom_T_activation_) * reading.odom_T_base;
  sample.velocity = reading.velocity;
  sample.battery_v = reading.battery_v;
  sample.motors_enabled = motors_;
  sample.stalled = reading.stalled;
  sample.bumped = reading.bumped;
  return sample;
}

Status SimBase::set_velocity(const Twist2& velocity, RobotTime now) {
  if (!active_) {
    return not_active("base");
  }
  if (!std::isfinite(velocity.v_m_s) || !std::isfinite(velocity.omega_rad_s)) {
    return fail(Errc::kInvalidArgument, "the velocity command is not a number");
  }
  if (!motors_) {
    if (velocity == Twist2{}) {
      return {};
    }
    return fail(Errc::kRefused, "the motors of the base are off; enable them first");
  }
  simulation_->command(velocity);
  last_command_ = now;
  moving_ = true;
  return {};
}

Status SimBase::set_motors(bool enabled) {
  if (!active_) {
    return not_active("base");
  }
  motors_ = enabled;
  if (!enabled) {
    simulation_->command({});
    moving_ = false;
  }
  return {};
}

void SimBase::before_advance(Duration period) {
  if (moving_ && simulation_->now() + period - last_command_ > params_.command_timeout) {
    simulation_->command({});
    moving_ = false;
  }
}

SimLidar::SimLidar(std::shared_ptr<sim::Simulation> simulation, std::shared_ptr<const SimFaults> faults,
                   const SimDeviceParams& params)
    : simulation_(std::move(simulation)), faults_(std::move(faults)), period_(params.lidar_period) {}

Status SimLidar::activate() {
  active_ = true;
  last_sample_.reset();
  return {};
}

void SimLidar::deactivate() { active_ = false; }

Result<std::optional<LaserScan>> SimLidar::read() {
  if (!active_) {
    return not_active("lidar");
  }
  if (faults_->lidar_silent || !due(last_sample_, simulation_->now(), period_)) {
    return std::nullopt;
  }
  return simulation_->scan();
}

SimSonar::SimSonar(std::shared_ptr<sim::Simulation> simulation, std::shared_ptr<const SimFaults> faults,
                   const SimDeviceParams& params)
    : simulation_(std::move(simulation)), faults_(std::move(faults)), period_(params.sonar_period) {}

Status SimSonar::activate() {
  active_ = true;
  last_sample_.reset();
  return {};
}

void SimSonar::deactivate() { active_ = false; }

Result<std::optional<SonarScan>> SimSonar::read() {
  if (!active_) {
    return not_active("sonar");
  }
  if (faults_->sonar_silent || !due(last_sample_, simulation_->now(), period_)) {
    return std::nullopt;
  }
  SonarScan scan = simulation_->sonar();
  if (faults_->sonar_nan >= 0 && static_cast<std::size_t>(faults_->sonar_nan) < scan.readings.size()) {
    scan.readings[static_cast<std::size_t>(faults_->sonar_nan)].range_m = std::numeric_limits<float>::quiet_NaN();
  }
  return scan;
}

SimCamera::SimCamera(std::shared_ptr<sim::Simulation> simulation, std::shared_ptr<const SimFaults> faults)
    : simulation_(std::move(simulation)), faults_(std::move(faults)) {}

Status SimCamera::activate() {
  if (faults_->camera_dead) {
    return fail(Errc::kIo, "the simulated camera does not answer; check its cable");
  }
  active_ = true;
  return {};
}

void SimCamera::deactivate() { active_ = false; }

Result<CameraFrame> SimCamera::grab() {
  if (!active_) {
    return not_active("camera");
  }
  if (faults_->camera_dead) {
    return fail(Errc::kIo, "the simulated camera does not answer; check its cable");
  }
  return CameraFrame{simulation_->now(), simulation_->camera_image()};
}

SimStereo::SimStereo(std::shared_ptr<sim::Simulation> simulation, std::shared_ptr<const SimFaults> faults)
    : simulation_(std::move(simulation)), faults_(std::move(faults)) {}

Status SimStereo::activate() {
  if (faults_->stereo_dead) {
    return fail(Errc::kIo, kStereoDead);
  }
  active_ = true;
  return {};
}

void SimStereo::deactivate() { active_ = false; }

Result<StereoFrame> SimStereo::grab() {
  if (!active_) {
    return not_active("stereo camera");
  }
  if (faults_->stereo_dead) {
    return fail(Errc::kIo, kStereoDead);
  }
  StereoFrame frame = simulation_->stereo_pair();
  const Image right = frame.right;
  spoil(frame, faults_->stereo, last_right_);
  last_right_ = right;
  return frame;
}

const StereoGeometry& SimStereo::geometry() const { return simulation_->model().stereo.geometry; }

LockstepClock::LockstepClock(std::shared_ptr<sim::Simulation> simulation, SimBase* base, WorldSeat seat, double speed)
    : simulation_(std::move(simulation)), base_(base), seat_(std::move(seat)), pacer_(speed) {}

LockstepClock::~LockstepClock() { seat_.barrier->let_go(seat_.robot); }

RobotTime LockstepClock::now() const { return simulation_->now(); }

void LockstepClock::hold() { seat_.barrier->hold(seat_.robot); }

void LockstepClock::let_go() {
  simulation_->command({});  // nobody watches its time-out meanwhile
  seat_.barrier->let_go(seat_.robot);
  pacer_.rest();
}

Status LockstepClock::advance(Duration period) {
  if (period <= Duration::zero()) {
    return fail(Errc::kInvalidArgument, "the lockstep clock advances by a period above 0");
  }
  base_->before_advance(period);
  seat_.barrier->advance(seat_.robot, period);
  pacer_.start(period);
  return {};
}

Result<SharedDevices> make_shared_devices(sim::World world, std::vector<sim::RobotPlace> places, double speed,
                                          const SimDeviceParams& params) {
  if (!std::isfinite(speed) || speed < 0.0) {
    return fail(Errc::kInvalidArgument, "the speed of the simulated clock must be 0 (as fast as possible) or more");
  }
  Result<std::shared_ptr<sim::SharedWorld>> created = sim::SharedWorld::create(std::move(world), std::move(places));
  if (!created) {
    return tl::unexpected<Error>(created.error());
  }
  SharedDevices shared;
  shared.world = *created;
  shared.barrier = std::make_shared<TickBarrier>(*created);
  shared.robots.reserve(shared.world->size());
  for (std::size_t i = 0; i < shared.world->size(); ++i) {
    SimDevices devices;
    devices.simulation = std::make_shared<sim::Simulation>(shared.world, i);
    devices.faults = std::make_shared<SimFaults>();
    devices.base = std::make_unique<SimBase>(devices.simulation, devices.faults, params);
    devices.lidar = std::make_unique<SimLidar>(devices.simulation, devices.faults, params);
    devices.sonar = std::make_unique<SimSonar>(devices.simulation, devices.faults, params);
    devices.camera = std::make_unique<SimCamera>(devices.simulation, devices.faults);
    devices.stereo = std::make_unique<SimStereo>(devices.simulation, devices.faults);
    devices.clock =
        std::make_unique<LockstepClock>(devices.simulation, devices.base.get(), WorldSeat{shared.barrier, i}, speed);
    shared.robots.push_back(std::move(devices));
  }
  return shared;
}

Result<SimDevices> make_sim_devices(sim::World world, sim::RobotModel model, std::uint64_t seed, double speed,
                                    const SimDeviceParams& params, std::size_t start) {
  Result<SharedDevices> shared =
      make_shared_devices(std::move(world), {sim::RobotPlace{std::move(model), seed, start}}, speed, params);
  if (!shared) {
    return tl::unexpected<Error>(shared.error());
  }
  return std::move(shared->robots.front());
}

}  // namespace seeker::drivers
