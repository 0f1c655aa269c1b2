#include "server/app/daemon/service_notifier.hpp"

#include <atomic>
#include <future>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/app/composition/robot_assembly.hpp"
#include "server/app/robot/robot.hpp"
#include "tests/support/data.hpp"
#include "tests/support/service_manager.hpp"

namespace seeker::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::ServiceManager;

const std::function<std::string()> kIdle = [] { return std::string("idle"); };

TEST(ServiceNotifier, TellsThatItIsReadyAndThatItStops) {
  const ServiceManager systemd;
  const ServiceNotifier notifier;
  notifier.ready();
  notifier.stopping();
  EXPECT_THAT(systemd.reports(), ElementsAre("READY=1", "STOPPING=1\nSTATUS=stopping"));
}

TEST(ServiceNotifier, SignsOfLifeComeAtHalfOfTheWatchdogsTime) {
  const ServiceManager systemd(seconds(10));
  ServiceNotifier notifier;
  const ServiceNotifier::WallTime start;
  notifier.passed(start, kIdle);
  EXPECT_THAT(systemd.reports(), ElementsAre("WATCHDOG=1", "STATUS=idle"));
  notifier.passed(start + milliseconds(4999), kIdle);
  EXPECT_THAT(systemd.reports(), IsEmpty()) << "too early, and the state is as before";
  notifier.passed(start + milliseconds(5000), kIdle);
  EXPECT_THAT(systemd.reports(), ElementsAre("WATCHDOG=1"));
}

TEST(ServiceNotifier, AServiceManagerWithoutWatchdogHearsOfTheStateOnly) {
  const ServiceManager systemd;
  ServiceNotifier notifier;
  const ServiceNotifier::WallTime start;
  notifier.passed(start, kIdle);
  notifier.passed(start + milliseconds(999), [] { return std::string("too early"); });
  notifier.passed(start + seconds(1), [] { return std::string("busy"); });
  EXPECT_THAT(systemd.reports(), ElementsAre("STATUS=idle", "STATUS=busy"));
}

TEST(ServiceNotifier, WithoutServiceManagerTheStateIsNotEvenMade) {
  ServiceNotifier notifier;
  notifier.ready();
  notifier.passed({}, []() -> std::string { throw std::logic_error("nobody asked for it"); });
}

TEST(ServiceState, NamesMotorsMissionAndFaultsInOneLine) {
  api::RobotStatus status;
  EXPECT_EQ(service_state(status), "disarmed, no mission");
  status.motors_armed = true;
  status.mission.emplace();
  status.mission->id = "round";
  status.mission->phase = "cover";
  status.faults.emplace_back().message = "the laser\nis silent";
  EXPECT_EQ(service_state(status), "armed, mission 'round' RUNNING: cover, 1 faults, the first: the laser is silent");
  status.mission->end.emplace();
  status.estop = true;
  status.faults.clear();
  EXPECT_EQ(service_state(status), "emergency stop, no mission");
}

/// A laser whose next reading does not return before a test lets it.
class StuckLidar final : public drivers::LidarDriver {
 public:
  explicit StuckLidar(std::shared_ptr<drivers::LidarDriver> real) : real_(std::move(real)) {}
  Status activate() override { return real_->activate(); }
  void deactivate() override { real_->deactivate(); }
  Result<std::optional<LaserScan>> read() override {
    if (stuck.exchange(false)) {
      entered.set_value();
      freed.get_future().wait();
    }
    return real_->read();
  }

  std::atomic<bool> stuck{false};
  std::promise<void> entered;
  std::promise<void> freed;

 private:
  std::shared_ptr<drivers::LidarDriver> real_;
};

TEST(ServiceWatchdog, IsFedByTheLoopAndNotWhileTheLoopIsStuck) {
  constexpr milliseconds kWatchdog{20};
  constexpr seconds kPatience{60};
  const ServiceManager systemd(kWatchdog);
  // At the speed of life the loop runs without a mission.
  const RobotOptions options =
      load_robot_options(testing::source_file("config/robots/sim.yaml"), {"sim.speed=1"}).value();
  LoopParts parts = assemble(options).value().parts;
  const auto lidar = std::make_shared<StuckLidar>(parts.devices.lidar);
  parts.devices.lidar = lidar;
  ServiceNotifier notifier;
  Robot robot({}, options.loop, std::move(parts));
  robot.loop().hooks().on_pass = [&](WallTime now) { notifier.passed(now, kIdle); };
  robot.start();
  EXPECT_TRUE(systemd.hears("WATCHDOG=1", kPatience));
  EXPECT_TRUE(systemd.hears("WATCHDOG=1", kPatience));
  lidar->stuck = true;
  ASSERT_EQ(lidar->entered.get_future().wait_for(kPatience), std::future_status::ready);
  static_cast<void>(systemd.reports());
  EXPECT_EQ(systemd.next(20 * kWatchdog), std::nullopt) << "nobody else may speak for the loop";
  lidar->freed.set_value();
  EXPECT_TRUE(systemd.hears("WATCHDOG=1", kPatience));
  robot.stop();
}

}  // namespace
}  // namespace seeker::app
