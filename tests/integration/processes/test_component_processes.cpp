// Components of a running robot, changed over real sockets.

#include "tests/integration/processes/daemon.hpp"

namespace seeker::testing {
namespace {

TEST(ComponentProcesses, SettingsChangeInARunningSearchAndTheEstimatorBetweenMissions) {
  const Daemon daemon({"--set", "sim.speed=1"});
  std::string output;
  const std::string target = source_file("config/targets/cross.yaml");
  ASSERT_EQ(seeker(daemon, {"search", "--target", target, "--detach", "--on-found", "continue"}, &output), 0) << output;
  EXPECT_EQ(seeker(daemon, {"components", "exchange", "pose", "scan_match"}, &output), 3) << output;
  EXPECT_NE(output.find("a mission is running"), std::string::npos) << output;
  EXPECT_EQ(seeker(daemon, {"components", "set", "lidar", "period_s=0.5"}, &output), 0) << output;
  EXPECT_EQ(seeker(daemon, {"components", "set", "recogniser", "templates.accept_ncc=0.8"}, &output), 0) << output;
  EXPECT_EQ(seeker(daemon, {"components", "set", "safety", "max_v_m_s=fast"}, &output), 2) << output;
  EXPECT_NE(output.find("loop.safety.max_v_m_s: expected a number, got 'fast'"), std::string::npos) << output;
  EXPECT_EQ(seeker(daemon, {"components", "get", "lidar", "--json"}, &output), 0);
  EXPECT_NE(output.find(R"("key":"period_s","value":"0.5","path":"sim.devices.lidar_period_s","effect":"NOW")"),
            std::string::npos)
      << output;
  EXPECT_EQ(seeker(daemon, {"status"}, &output), 0);
  EXPECT_NE(output.find("RUNNING"), std::string::npos) << output;
  EXPECT_EQ(seeker(daemon, {"stop"}, &output), 0);
  while (seeker(daemon, {"components", "exchange", "pose", "scan_match"}, &output) != 0) {
    ASSERT_NE(output.find("the robot moves"), std::string::npos) << output;
  }
  EXPECT_NE(output.find("scan_match"), std::string::npos) << output;
  EXPECT_NE(output.find("to pose.scan"), std::string::npos) << output;
  EXPECT_EQ(seeker(daemon, {"goto", "0,0"}, &output), 0) << output;
}

TEST(ComponentProcesses, AComponentThatDoesNotStartLeavesTheRestRunning) {
  const Daemon daemon({"--set", "search.solids.model=no-such-model.yaml"});
  std::string output;
  EXPECT_EQ(seeker(daemon, {"components"}, &output), 0);
  EXPECT_NE(output.find("ERROR"), std::string::npos) << output;
  EXPECT_EQ(seeker(daemon, {"goto", "0.5,0"}, &output), 0) << output;
}

}  // namespace
}  // namespace seeker::testing
