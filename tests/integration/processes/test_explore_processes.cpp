// Explorations over real sockets: to the end, without their client, paused, and over the death of the robot's program.

#include <csignal>
#include <sstream>

#include "tests/integration/processes/watcher.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;

/// Slow enough that something can happen in between, fast enough for a test.
const std::vector<std::string> kSlow{"--set", "sim.speed=15", "--set", "loop.mission.link_grace_s=0.5"};

TEST(ExploreProcesses, DemoWorldIsMappedAndEveryDecisionTold) {
  const Daemon daemon;
  std::string output;
  ASSERT_EQ(seeker(daemon, {"explore", "--strategy", "frontier", "--json", "-q"}, &output), 0) << output;
  std::istringstream lines(output);
  std::vector<std::string> documents;
  for (std::string line; std::getline(lines, line);) {
    documents.push_back(line);
  }
  ASSERT_GT(documents.size(), 3U) << output;
  for (std::size_t k = 0; k + 1 < documents.size(); ++k) {
    const std::string number = "\"decision\":{\"number\":" + std::to_string(k + 1) + ",";
    EXPECT_NE(documents[k].find(number), std::string::npos) << documents[k];
    EXPECT_NE(documents[k].find("\"candidates\":[{\"x_m\":"), std::string::npos) << documents[k];
  }
  EXPECT_NE(documents.back().find("\"outcome\":\"COMPLETE\""), std::string::npos) << documents.back();
}

TEST(ExploreProcesses, RobotWithoutAMapOfSegmentsRefuses) {
  const Daemon daemon({"--set", "estimator=odometry"});
  std::string output;
  EXPECT_EQ(seeker(daemon, {"explore", "--strategy", "frontier"}, &output), 3);
  EXPECT_NE(output.find("estimator=line_slam"), std::string::npos) << output;
}

TEST(ExploreProcesses, ClientKilledOnTheWayLetsItsLinkPolicyDecide) {
  for (const auto& [policy, outcome] :
       {std::pair("stop", api::Outcome::kLinkLost), std::pair("continue", api::Outcome::kComplete)}) {
    const Daemon daemon(kSlow);
    Watcher watcher(daemon);
    ChildProcess client(program("seeker"),
                        {"explore", "--strategy", "frontier", "--link-policy", policy, "--robot", daemon.address()},
                        daemon.folder() / "victim");
    static_cast<void>(watcher.until(under_way));
    client.send(SIGKILL);
    const api::MissionStatus ended = watcher.end();
    EXPECT_EQ(ended.end->outcome, outcome) << policy << ": " << ended.end->cause;
  }
}

TEST(ExploreProcesses, PausedExplorationStandsAndGoesOn) {
  const Daemon daemon(kSlow);
  Watcher watcher(daemon);
  ASSERT_EQ(seeker(daemon, {"explore", "--strategy", "frontier", "--detach"}), 0);
  static_cast<void>(watcher.until(under_way));
  ASSERT_EQ(seeker(daemon, {"pause"}), 0);
  const double paused_m = watcher.status().mission->path_length_m;
  EXPECT_EQ(watcher.status().mission->state, api::MissionState::kPaused);
  ASSERT_EQ(seeker(daemon, {"resume"}), 0);
  static_cast<void>(watcher.until([&](const api::MissionStatus& m) { return m.path_length_m > paused_m + 0.5; }));
  ASSERT_EQ(seeker(daemon, {"stop"}), 0);
  EXPECT_EQ(watcher.end().end->outcome, api::Outcome::kOperator);
}

TEST(ExploreProcesses, ExplorationGoesOnInItsMapAfterTheServerWasKilled) {
  const fs::path folder = fresh_folder("explore_crash");
  const fs::path kept = folder / "state" / "maps" / "checkpoints" / "sim-1" / "look-round.seekermap";
  {
    std::vector<std::string> options = kSlow;
    options.insert(options.end(), {"--set", "loop.map.checkpoint_period_s=10"});
    Daemon daemon(options, folder);
    ASSERT_EQ(seeker(daemon, {"explore", "--strategy", "frontier", "--detach", "--id", "look-round"}), 0);
    ASSERT_TRUE(wait_for_file(kept, seconds(60)));
    daemon.kill();
  }
  {
    Daemon idle({}, folder);
    idle.kill();  // before anybody has resumed it
  }
  const Daemon again({}, folder);
  Watcher watcher(again);
  std::string output;
  ASSERT_EQ(seeker(again, {"resume"}, &output), 0) << output;
  const api::MissionStatus ended = watcher.end();
  EXPECT_EQ(ended.id, "look-round");
  EXPECT_EQ(ended.end->outcome, api::Outcome::kComplete) << ended.end->cause;
  ASSERT_TRUE(watcher.status().line_map);
  EXPECT_GT(watcher.status().pose.map_epoch, 0U) << "the kept map was loaded";
  while (fs::exists(kept)) {
    // The worker removes it; the mission's end does not wait for the disk.
    std::this_thread::yield();
  }
}

}  // namespace
}  // namespace seeker::testing
