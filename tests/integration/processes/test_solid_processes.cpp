// What stands in front of a camera in turbid water, asked over real sockets.

#include "tests/integration/processes/daemon.hpp"

namespace seeker::testing {
namespace {

TEST(SolidProcesses, RecogniseTellsWhatIsInFrontOfTheCamera) {
  const Daemon daemon({}, fresh_folder("tank"), source_file("config/robots/tank.yaml"));
  std::string output;
  EXPECT_EQ(seeker(daemon, {"recognise", "--solid", "sphere", "--solid", "ellipsoid", "--json"}, &output), 0) << output;
  EXPECT_NE(output.find("\"outcome\":\"TARGET_FOUND\""), std::string::npos) << output;
  EXPECT_NE(output.find("\"target\":\"ellipsoid\""), std::string::npos) << output;
  EXPECT_EQ(output.find("\"target\":\"sphere\""), std::string::npos) << output;
  EXPECT_EQ(seeker(daemon, {"camera", "grab", "--camera", "tank", "--out", daemon.folder() / "view.png"}, &output), 0)
      << output;
}

TEST(SolidProcesses, ARobotWithoutAModelRefusesSolidsWithTheRemedy) {
  const Daemon daemon;
  std::string output;
  EXPECT_EQ(seeker(daemon, {"recognise", "--solid", "sphere"}, &output), 3) << output;
  EXPECT_NE(output.find("seeker-lab train-solids"), std::string::npos) << output;
}

}  // namespace
}  // namespace seeker::testing
