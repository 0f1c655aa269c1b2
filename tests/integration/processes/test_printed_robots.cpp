// The robots as the papers print them, started by the server and sent exploring by the client. Those of the search, the
// stereo and the line paper have their missions in R12, test_landmark_processes and test_line_processes.

#include "tests/integration/processes/daemon.hpp"

namespace seeker::testing {
namespace {

/// What `seeker explore --json` prints of two minutes of the printed robot, which are too few to end by itself.
std::string explored_by(const std::string& robot, const std::string& strategy) {
  const Daemon daemon({}, fresh_folder(robot), source_file("config/robots/paper/" + robot + ".yaml"));
  std::string output;
  constexpr int kMissionEndedOtherwise = 5;
  EXPECT_EQ(seeker(daemon, {"explore", "--strategy", strategy, "--time-limit", "120", "--json", "-q"}, &output),
            kMissionEndedOtherwise)
      << output;
  EXPECT_NE(output.find("\"outcome\":\"TIME_LIMIT\""), std::string::npos) << output;
  return output;
}

TEST(PrintedRobots, OfActiveSlamDecidesStepByStepAndLeavesATrapAlongTheWalls) {
  const std::string output = explored_by("active-slam-2009", "active");
  EXPECT_NE(output.find("\"rule\":\"one-step\""), std::string::npos) << output;
  EXPECT_NE(output.find("\"rule\":\"wall\""), std::string::npos) << output;
}

TEST(PrintedRobots, OfMapMergingChoosesItsGoalsInTheSpaceTree) {
  const std::string output = explored_by("merging-2013", "topological");
  EXPECT_NE(output.find("\"rule\":\"topological\""), std::string::npos) << output;
}

}  // namespace
}  // namespace seeker::testing
