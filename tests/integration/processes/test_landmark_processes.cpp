// A building surveyed with the stereo camera, and a robot that finds its place in it, over real sockets.

#include <algorithm>

#include "common/core/angle.hpp"
#include "common/image/png.hpp"
#include "common/rpc/wait.hpp"
#include "server/options/world_options.hpp"
#include "server/sim/simulation.hpp"
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
    ASSERT_EQ(seeker(daemon, {"localise", "lab"}, &output), 0) << output;
    EXPECT_EQ(output.find("surveyed in"), std::string::npos) << "the map of the survey is still in use: " << output;
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

TEST(LandmarkProcesses, ThePrintedRobotSurveysAndLocalisesByWhatItSurveyed) {
  const fs::path folder = fresh_folder("printed");
  const fs::path printed = source_file("config/robots/paper/stereo-2017.yaml");
  // A survey of one place sees each landmark in two headings only.
  const std::vector<std::string> one_place{"--set", "stereo.database.salient_seen=2"};
  std::string output;
  {
    const Daemon daemon(one_place, folder, printed);
    ASSERT_EQ(seeker(daemon, {"survey", "lab", "--at", "0,0"}, &output), 0) << output;
    EXPECT_NE(output.find("12 looks are kept as 'lab'"), std::string::npos) << output;
    const auto client = connect(daemon, "asker");
    const auto landmarks = rpc::wait<std::vector<api::LandmarkPoint>>(
        [&](auto reply) { client->get_landmarks("lab", std::move(reply)); }, kCall);
    ASSERT_TRUE(landmarks) << landmarks.error().message;
    EXPECT_GT(landmarks->size(), 100U);
    // Nothing nearer than 5.04 m before the eye is measured; the mean of two that were taken for one may lie anywhere.
    const auto near = std::count_if(landmarks->begin(), landmarks->end(),
                                    [](const api::LandmarkPoint& landmark) { return landmark.p.norm() < 4.8; });
    EXPECT_LT(near, static_cast<std::ptrdiff_t>(landmarks->size() / 10));
  }
  std::vector<std::string> by_landmarks = one_place;
  by_landmarks.insert(by_landmarks.end(), {"--set", "estimator=landmarks", "--set", "stereo.estimator.database=lab"});
  const Daemon daemon(by_landmarks, folder, printed);
  ASSERT_EQ(seeker(daemon, {"status"}, &output), 0);
  EXPECT_NE(output.find("UNKNOWN"), std::string::npos) << output;
  ASSERT_EQ(seeker(daemon, {"localise", "lab"}, &output), 0) << output;
  const auto client = connect(daemon, "asker");
  const api::RobotStatus status =
      rpc::wait<api::RobotStatus>([&](auto reply) { client->get_status(std::move(reply)); }, kCall).value();
  EXPECT_EQ(status.pose.quality, LocalisationQuality::kLocalised) << status.pose.cause;
  EXPECT_LT(status.pose.map_T_base.translation().norm(), 0.15);
}

/// What the simulated camera sees at the start in 12 directions, as files.
void write_pictures(const fs::path& folder) {
  sim::World world = options::load_world(source_file("config/worlds/laboratory.yaml")).value();
  sim::RobotModel robot;
  robot.body_height_m = 1.0;
  const Pose2 start = world.starts.front();
  constexpr int kHeadings = 12;
  fs::create_directories(folder);
  for (int k = 0; k < kHeadings; ++k) {
    world.starts = {start * Pose2{0.0, 0.0, 2.0 * kPi * k / kHeadings}};
    const StereoFrame pair = sim::Simulation::create(world, robot, 1).value().stereo_pair();
    const std::string name = std::to_string(100 + k);
    ASSERT_TRUE(image::write_png(folder / (name + "_left.png"), pair.left));
    ASSERT_TRUE(image::write_png(folder / (name + "_right.png"), pair.right));
  }
}

TEST(LandmarkProcesses, RecordedPicturesArePlayedThroughTheCameraDriver) {
  const fs::path folder = fresh_folder("played");
  ASSERT_NO_FATAL_FAILURE(write_pictures(folder / "pictures"));
  const Daemon daemon(laboratory({"--set", "stereo.camera.source=files", "--set",
                                  "stereo.camera.files.folder=" + (folder / "pictures").string(), "--set",
                                  "stereo.camera.repeat_files=true"}),
                      folder);
  std::string output;
  ASSERT_EQ(seeker(daemon, {"survey", "lab", "--at", "0,0"}, &output), 0) << output;
  EXPECT_NE(output.find("12 looks are kept as 'lab'"), std::string::npos) << output;
  // The pictures begin again with the first heading, whatever the robot's own is now.
  ASSERT_EQ(seeker(daemon, {"localise", "lab"}, &output), 0) << output;
  EXPECT_NE(output.find("the robot is at ("), std::string::npos) << output;
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
