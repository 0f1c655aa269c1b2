/// \file
/// The simulated robot behind the driver interfaces, so that the loop uses it like hardware.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "server/drivers/interfaces/drivers.hpp"
#include "server/drivers/interfaces/pacer.hpp"
#include "server/drivers/sim/tick_barrier.hpp"
#include "server/sim/simulation.hpp"

namespace seeker::drivers {

/// Faults of a stereo pair that still arrives.
enum class StereoFault : std::uint8_t {
  kNone,
  kSwapped,    ///< left and right pictures are exchanged
  kBlack,      ///< the left eye is covered
  kSaturated,  ///< the right eye faces a lamp
  kBlurred,    ///< the left lens is fogged
  kHalfSize,   ///< pictures of another size
  kStale,      ///< the right picture belongs to the previous pair
};

/// Faults that can be switched on and off while the robot runs, to test its response.
struct SimFaults {
  bool base_silent = false;
  bool lidar_silent = false;
  bool sonar_silent = false;  ///< there are no sonar scans
  int sonar_nan = -1;         ///< this transducer reads NaN; -1: none
  bool camera_dead = false;   ///< grab() fails
  bool stereo_dead = false;   ///< the stereo camera's grab() fails
  StereoFault stereo = StereoFault::kNone;
};

/// Periods of the devices and the base's own safety.
struct SimDeviceParams {
  Duration base_period = std::chrono::milliseconds(100);
  Duration lidar_period = std::chrono::milliseconds(100);
  Duration sonar_period = std::chrono::milliseconds(100);
  /// The base halts when it received no newer command for this time.
  Duration command_timeout = std::chrono::milliseconds(500);
};

/// Wheels, encoders and battery. Motors are off until set_motors(true).
class SimBase final : public BaseDriver {
 public:
  SimBase(std::shared_ptr<sim::Simulation> simulation, std::shared_ptr<const SimFaults> faults,
          const SimDeviceParams& params);
  [[nodiscard]] Status activate() override;
  void deactivate() override;
  [[nodiscard]] Result<std::optional<OdometrySample>> read() override;
  [[nodiscard]] Status set_velocity(const Twist2& velocity, RobotTime now) override;
  [[nodiscard]] Status set_motors(bool enabled) override;
  [[nodiscard]] Status set_period(Duration period) override {
    params_.base_period = period;
    return {};
  }

  /// Called by the clock before the world advances by `period`: halts the base where the last command becomes too old.
  void before_advance(Duration period);

 private:
  std::shared_ptr<sim::Simulation> simulation_;
  std::shared_ptr<const SimFaults> faults_;
  SimDeviceParams params_;
  bool active_ = false;
  bool motors_ = false;
  bool moving_ = false;  ///< a command is in force
  Pose2 odom_T_activation_;
  std::optional<RobotTime> last_sample_;
  RobotTime last_command_;
};

class SimLidar final : public LidarDriver {
 public:
  SimLidar(std::shared_ptr<sim::Simulation> simulation, std::shared_ptr<const SimFaults> faults,
           const SimDeviceParams& params);
  [[nodiscard]] Status activate() override;
  void deactivate() override;
  [[nodiscard]] Result<std::optional<LaserScan>> read() override;
  [[nodiscard]] Status set_period(Duration period) override {
    period_ = period;
    return {};
  }

 private:
  std::shared_ptr<sim::Simulation> simulation_;
  std::shared_ptr<const SimFaults> faults_;
  Duration period_;
  bool active_ = false;
  std::optional<RobotTime> last_sample_;
};

class SimSonar final : public SonarDriver {
 public:
  SimSonar(std::shared_ptr<sim::Simulation> simulation, std::shared_ptr<const SimFaults> faults,
           const SimDeviceParams& params);
  [[nodiscard]] Status activate() override;
  void deactivate() override;
  [[nodiscard]] Result<std::optional<SonarScan>> read() override;
  [[nodiscard]] Status set_period(Duration period) override {
    period_ = period;
    return {};
  }

 private:
  std::shared_ptr<sim::Simulation> simulation_;
  std::shared_ptr<const SimFaults> faults_;
  Duration period_;
  bool active_ = false;
  std::optional<RobotTime> last_sample_;
};

/// The camera that the model has.
class SimCamera final : public CameraDriver {
 public:
  SimCamera(std::shared_ptr<sim::Simulation> simulation, std::shared_ptr<const SimFaults> faults);
  [[nodiscard]] Status activate() override;
  void deactivate() override;
  [[nodiscard]] Result<CameraFrame> grab() override;

 private:
  std::shared_ptr<sim::Simulation> simulation_;
  std::shared_ptr<const SimFaults> faults_;
  bool active_ = false;
};

/// The stereo camera.
class SimStereo final : public StereoDriver {
 public:
  SimStereo(std::shared_ptr<sim::Simulation> simulation, std::shared_ptr<const SimFaults> faults);
  [[nodiscard]] Status activate() override;
  void deactivate() override;
  [[nodiscard]] Result<StereoFrame> grab() override;
  [[nodiscard]] const StereoGeometry& geometry() const override;

 private:
  std::shared_ptr<sim::Simulation> simulation_;
  std::shared_ptr<const SimFaults> faults_;
  bool active_ = false;
  Image last_right_;
};

/// A robot of a shared world.
struct WorldSeat {
  std::shared_ptr<TickBarrier> barrier;
  std::size_t robot = 0;
};

/// Robot time of the simulated world. Speed 0: as fast as possible; otherwise paced by the wall clock.
class LockstepClock final : public Clock {
 public:
  /// `base` must outlive the clock.
  LockstepClock(std::shared_ptr<sim::Simulation> simulation, SimBase* base, WorldSeat seat, double speed);
  ~LockstepClock() override;
  [[nodiscard]] RobotTime now() const override;
  [[nodiscard]] Status advance(Duration period) override;
  void hold() override;
  void let_go() override;
  [[nodiscard]] Result<bool> await(Duration limit) override { return pacer_.await(limit); }
  [[nodiscard]] bool lockstep() const override { return true; }
  [[nodiscard]] double speed() const override { return pacer_.speed(); }
  [[nodiscard]] std::optional<TickTiming> timing() const override { return pacer_.timing(); }

 private:
  std::shared_ptr<sim::Simulation> simulation_;
  SimBase* base_;
  WorldSeat seat_;
  Pacer pacer_;
};

/// A complete simulated robot. The clock refers to the base: destroy or keep them together.
struct SimDevices {
  std::shared_ptr<sim::Simulation> simulation;
  std::shared_ptr<SimFaults> faults;  ///< changed at run time from the loop's thread
  std::unique_ptr<SimBase> base;
  std::unique_ptr<SimLidar> lidar;
  std::unique_ptr<SimSonar> sonar;
  std::unique_ptr<SimCamera> camera;
  std::unique_ptr<SimStereo> stereo;
  std::unique_ptr<LockstepClock> clock;
};

/// Fails as Simulation::create does, or for a speed that is negative or not finite.
[[nodiscard]] Result<SimDevices> make_sim_devices(sim::World world, sim::RobotModel model, std::uint64_t seed,
                                                  double speed, const SimDeviceParams& params = {},
                                                  std::size_t start = 0);

/// The devices of all robots of a world, in their order, on one tick barrier.
struct SharedDevices {
  std::shared_ptr<sim::SharedWorld> world;
  std::shared_ptr<TickBarrier> barrier;
  std::vector<SimDevices> robots;
};

/// Fails as SharedWorld::create does, or for a speed that is negative or not finite.
[[nodiscard]] Result<SharedDevices> make_shared_devices(sim::World world, std::vector<sim::RobotPlace> places,
                                                        double speed, const SimDeviceParams& params = {});

}  // namespace seeker::drivers
