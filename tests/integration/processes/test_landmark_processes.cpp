// A building surveyed with the stereo camera, and a robot that finds its place in it, over real sockets.

#include "common/rpc/wait.hpp"
#include "tests/integration/processes/daemon.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;

/// The laboratory; a survey of one place sees each landmark in two headings only.
std::vector<std::string> laboratory(std::vector<std::string> extra = {}) {
  std::vector<std::string> options{"--set", "sim.world=" + source_file("config/worlds/laboratory.yaml").string(),
                                   "--set", "sim.robot.body_height_m=1.0",
                                   "--set", "stereo.localiser.eye_height_m=0.9",
                                   "--set", "stereo.database.salient_seen=2"};
  options.insert(options.end(), extra.begin(), extra.end());
  return options;
}

TEST(LandmarkProcesses, ARobotThatWasSwitchedOffFindsItsPlaceInTheSurveyedLaboratory) {
  const fs::path folder = fresh_folder("landmarks");
  std::string output;
  {
    const Daemon daemon(laboratory(), folder);
    ASSERT_EQ(seeker(daemon, {"localise", "lab"}, &output), 1) << output;
    EXPECT_NE(output.find("seeker survey"), std::string::npos) << output;
    ASSERT_EQ(seeker(daemon, {"survey", "lab", "--at", "0,0"}, &output), 0) << output;
    EXPECT_NE(output.find("12 looks are kept as 'lab'"), std::string::npos) << output;
    EXPECT_EQ(seeker(daemon, {"survey", "lab"}, &output), 3) << "an existing database is not replaced: " << output;
    EXPECT_EQ(seeker(daemon, {"landmarks", "verify", "lab"}, &output), 0) << output;
    EXPECT_EQ(seeker(daemon, {"landmarks", "export", "lab", folder / "lab.csv"}, &output), 0) << output;
    EXPECT_TRUE(fs::exists(folder / "lab.png"));
  }
  const Daemon daemon(laboratory({"--set", "estimator=landmarks", "--set", "stereo.estimator.database=lab"}), folder);
  ASSERT_EQ(seeker(daemon, {"status"}, &output), 0);
  EXPECT_NE(output.find("UNKNOWN"), std::string::npos) << output;
  ASSERT_EQ(seeker(daemon, {"localise", "lab"}, &output), 0) << output;
  EXPECT_EQ(seeker(daemon, {"landmarks", "delete", "lab", "--yes"}, &output), 3) << "it is in use: " << output;
  const auto client = connect(daemon, "asker");
  const api::RobotStatus status =
      rpc::wait<api::RobotStatus>([&](auto reply) { client->get_status(std::move(reply)); }, kCall).value();
  EXPECT_EQ(status.pose.quality, LocalisationQuality::kLocalised) << status.pose.cause;
  // It stands at its start, the origin of the map that was surveyed; three sigma of a survey of one place.
  EXPECT_LT(status.pose.map_T_base.translation().norm(), 0.15);
}

TEST(LandmarkProcesses, AnEstimatorWithoutItsDatabaseDoesNotStart) {
  const fs::path folder = fresh_folder("no_landmarks");
  ChildProcess process(program("seekerd"),
                       {"--config", source_file("config/robots/stereo.yaml"), "--state", folder, "--port", "0", "--set",
                        "estimator=landmarks", "--set", "stereo.estimator.database=lab"},
                       folder / "log");
  EXPECT_EQ(process.wait(kStart), std::optional<int>(78));
  EXPECT_NE(process.output().find("there is no database of landmarks 'lab'"), std::string::npos) << process.output();
}

}  // namespace
}  // namespace seeker::testing
