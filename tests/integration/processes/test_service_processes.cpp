// seekerd as the service that a package makes of it.

#include <csignal>

#include <gtest/gtest.h>

#include "common/rpc/wait.hpp"
#include "tests/integration/processes/daemon.hpp"
#include "tests/support/service_manager.hpp"

namespace seeker::testing {
namespace {

TEST(ServiceProcesses, SystemdHearsOfTheStartOfTheLoopAndOfTheEnd) {
  const ServiceManager systemd(seconds(1));
  const Daemon daemon({"--set", "sim.speed=1"});  // so that the mission lasts for seconds
  EXPECT_TRUE(systemd.hears("READY=1", kStart));
  EXPECT_TRUE(systemd.hears("WATCHDOG=1", kStart)) << "while no mission runs";
  EXPECT_EQ(seeker(daemon, {"goto", "1,0", "--detach"}), 0);
  EXPECT_TRUE(systemd.hears("STATUS=armed, mission ", kStart));
  EXPECT_TRUE(systemd.hears("WATCHDOG=1", kStart));
  daemon.process->send(SIGTERM);
  EXPECT_TRUE(systemd.hears("STOPPING=1", kStart));
}

TEST(ServiceProcesses, ALoopThatIsStuckGivesNoSignOfLifeAndItsTickIsCountedAsLate) {
  const ServiceManager systemd(seconds(1));
  const Daemon daemon({"--set", "sim.speed=1"});
  EXPECT_EQ(seeker(daemon, {"goto", "1,0", "--detach"}), 0);
  EXPECT_TRUE(systemd.hears("WATCHDOG=1", kStart));
  daemon.process->send(SIGSTOP);
  static_cast<void>(systemd.reports());  // what was sent before
  EXPECT_EQ(systemd.next(std::chrono::milliseconds(1500)), std::nullopt) << "systemd starts it again by then";
  daemon.process->send(SIGCONT);
  EXPECT_TRUE(systemd.hears("WATCHDOG=1", kStart));
  const auto client = connect(daemon, "observer");
  const Result<api::RobotStatus> status =
      rpc::wait<api::RobotStatus>([&](auto reply) { client->get_status(std::move(reply)); }, kCall);
  ASSERT_TRUE(status) << status.error().message;
  ASSERT_TRUE(status->timing);
  EXPECT_GE(status->timing->late, 1U);
  EXPECT_GE(status->timing->worst, std::chrono::milliseconds(1400));
}

TEST(ServiceProcesses, ARobotStartsDisarmedWhateverItsBase) {
  for (const std::string speed : {"0", "1"}) {
    const ServiceManager systemd;
    const Daemon daemon({"--set", "sim.speed=" + speed});
    EXPECT_TRUE(systemd.hears("STATUS=disarmed, no mission", kStart));
    const auto client = connect(daemon, "operator");
    const Result<api::RobotStatus> status =
        rpc::wait<api::RobotStatus>([&](auto reply) { client->get_status(std::move(reply)); }, kCall);
    ASSERT_TRUE(status) << status.error().message;
    EXPECT_FALSE(status->motors_armed);
    EXPECT_EQ(status->velocity, Twist2{});
  }
}

}  // namespace
}  // namespace seeker::testing
