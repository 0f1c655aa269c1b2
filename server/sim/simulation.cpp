#include "server/sim/simulation.hpp"

#include <cmath>
#include <utility>

#include "server/sim/shared_world.hpp"

namespace seeker::sim {

Simulation::Simulation(std::shared_ptr<SharedWorld> shared, std::size_t index)
    : shared_(std::move(shared)), index_(index) {
  SEEKER_ASSERT(shared_ != nullptr && index_ < shared_->size());
}

Result<Simulation> Simulation::create(World world, RobotModel model, std::uint64_t seed, std::size_t start) {
  Result<std::shared_ptr<SharedWorld>> shared =
      SharedWorld::create(std::move(world), {RobotPlace{std::move(model), seed, start}});
  if (!shared) {
    return tl::unexpected<Error>(shared.error());
  }
  return Simulation(std::move(*shared), 0);
}

void Simulation::command(const Twist2& velocity) {
  SEEKER_ASSERT(std::isfinite(velocity.v_m_s) && std::isfinite(velocity.omega_rad_s));
  shared_->robot(index_).command(velocity);
}

void Simulation::advance(Duration period) { shared_->advance(period); }
RobotTime Simulation::now() const { return shared_->now(); }
BaseReading Simulation::odometry() const { return shared_->robot(index_).odometry(now()); }
LaserScan Simulation::scan() { return shared_->robot(index_).scan(now()); }
SonarScan Simulation::sonar() { return shared_->robot(index_).sonar(now()); }
Image Simulation::omni_image() { return shared_->robot(index_).omni_image(now()); }
Image Simulation::tank_image() { return shared_->robot(index_).tank_image(); }
Image Simulation::camera_image() { return model().camera == CameraKind::kTank ? tank_image() : omni_image(); }
StereoFrame Simulation::stereo_pair() { return shared_->robot(index_).stereo_pair(now()); }
GroundTruth Simulation::truth() const { return shared_->robot(index_).truth(); }
const World& Simulation::world() const { return shared_->world(); }
const RobotModel& Simulation::model() const { return shared_->robot(index_).model(); }

}  // namespace seeker::sim
