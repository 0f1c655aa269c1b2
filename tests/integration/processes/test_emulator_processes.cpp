// One world hosted for two robots, each with its own server, over real sockets.

#include <csignal>

#include "tests/integration/processes/emulator.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;

TEST(EmulatorProcesses, TwoRobotsDriveInOneWorldAndOneComesBackAfterItsDeath) {
  const Emulator emulator;
  const fs::path folder = fresh_folder("robot1");
  const Daemon first(emulator.robot(0));
  std::string output;
  {
    Daemon second(emulator.robot(1), folder);
    // Robot 1 stands by: the world goes on without it.
    EXPECT_EQ(seeker(first, {"goto", "1.5,0"}, &output), 0) << output;
    EXPECT_EQ(seeker(second, {"goto", "0.8,0"}, &output), 0) << output;
    ASSERT_EQ(seeker(second, {"goto", "--detach", "4,0"}, &output), 0) << output;
    second.kill();
  }
  EXPECT_EQ(seeker(first, {"goto", "0.5,0"}, &output), 0) << output;
  const Daemon again(emulator.robot(1), folder);
  EXPECT_EQ(seeker(again, {"goto", "0.5,0"}, &output), 0) << output;

  const auto paths = emulator.paths();
  ASSERT_EQ(paths.size(), 2U);
  const Point2 start_of_first(1.0, 1.0);
  EXPECT_LT((paths.at(0).back() - start_of_first - Point2(0.5, 0.0)).norm(), 0.25);
  // Robot 1 looks to the south (-90 deg): 0.8 m before its death, some on the way to 4 m, and 0.5 m after it.
  EXPECT_LT(paths.at(1).back().y(), 11.0 - 1.0);
  EXPECT_NEAR(paths.at(1).back().x(), 19.0, 0.4);
}

TEST(EmulatorProcesses, ARobotThatIsToldToEndInAMissionDoesSoInOrderAndOffersTheMissionAgain) {
  const Emulator emulator(fresh_folder("slow"), source_file("config/worlds/corridor.yaml"),
                          source_file("config/robots/sim.yaml"), 1, 1.0);
  const fs::path folder = fresh_folder("told");
  std::string output;
  {
    Daemon robot(emulator.robot(0), folder);
    ASSERT_EQ(seeker(robot, {"goto", "--detach", "6,0"}, &output), 0) << output;
    robot.process->send(SIGTERM);
    EXPECT_EQ(robot.process->wait(seconds(30)), 0) << robot.process->output();
    EXPECT_NE(robot.process->output().find("motion first"), std::string::npos) << robot.process->output();
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder / "state")) {
    EXPECT_NE(entry.path().extension(), ".db-wal") << entry.path();
  }
  const Daemon again(emulator.robot(0), folder);
  ASSERT_EQ(seeker(again, {"status"}, &output), 0) << output;
  EXPECT_NE(output.find("'seeker resume' goes on with it"), std::string::npos) << output;
  EXPECT_NE(again.process->output().find("was cut off when the program ended"), std::string::npos);
}

TEST(EmulatorProcesses, AWorldThatDiesIsAFaultOfARobotThatStandsBy) {
  std::string output;
  Emulator emulator;
  const Daemon robot(emulator.robot(0));
  emulator.process->kill();
  while (output.find("cannot be reached") == std::string::npos) {
    ASSERT_EQ(seeker(robot, {"status"}, &output), 0) << output;
  }
  EXPECT_NE(seeker(robot, {"goto", "1,1"}, &output), 0);
  EXPECT_NE(output.find("seeker-emulator runs"), std::string::npos) << output;
  ASSERT_EQ(seeker(robot, {"components"}, &output), 0) << output;
  EXPECT_NE(output.find("ERROR"), std::string::npos) << output;
}

TEST(EmulatorProcesses, ARobotWithoutAWorldSaysWhatToStart) {
  const fs::path folder = fresh_folder("nobody");
  ChildProcess robot(program("seekerd"),
                     {"--config", source_file("config/robots/sim.yaml"), "--set", "driver=emulator", "--set",
                      "emulator.address=127.0.0.1:1", "--port", "0", "--state", folder / "state"},
                     folder / "log");
  EXPECT_EQ(robot.wait(seconds(30)), 1) << "it may be there at the next start";
  EXPECT_NE(robot.output().find("start seeker-emulator there"), std::string::npos) << robot.output();
}

}  // namespace
}  // namespace seeker::testing
