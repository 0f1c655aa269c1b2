#include "server/lab/stereo_database/survey_command.hpp"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/image/png.hpp"
#include "server/app/landmarks/landmark_library.hpp"
#include "server/options/world_options.hpp"
#include "server/sim/simulation.hpp"
#include "tests/support/data.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

namespace fs = std::filesystem;

class SurveyCommandTest : public LabFiles {
 protected:
  SurveyCommandTest() {
    options_.folder = folder() / "pairs";
    options_.name = "lab";
    options_.out = folder() / "landmarks";
    options_.robot = seeker::testing::source_file("config/robots/stereo.yaml");
    fs::create_directories(options_.folder);
  }

  /// Pairs of three headings that overlap, with their poses.
  void write_pairs() const {
    sim::World world = options::load_world(seeker::testing::source_file("config/worlds/laboratory.yaml")).value();
    const sim::RobotModel robot;
    const Pose2 start = world.starts.front();
    std::ofstream poses(options_.folder / "poses.csv");
    poses << "name,x_m,y_m,theta_deg\n";
    for (int k = 0; k < 3; ++k) {
      world.starts = {start * Pose2{0.0, 0.0, deg_to_rad(10.0 * k)}};
      const StereoFrame pair = sim::Simulation::create(world, robot, 1).value().stereo_pair();
      const std::string name = std::to_string(k);
      ASSERT_TRUE(image::write_png(options_.folder / (name + "_left.png"), pair.left));
      ASSERT_TRUE(image::write_png(options_.folder / (name + "_right.png"), pair.right));
      const Pose2 eye = world.starts.front() * robot.stereo.base_T_left_eye;
      poses << name << ',' << eye.x_m << ',' << eye.y_m << ',' << rad_to_deg(eye.theta_rad) << '\n';
    }
  }

  SurveyOptions options_;
  std::ostringstream out_;
};

TEST_F(SurveyCommandTest, PairsWithPosesBecomeADatabaseInTheFrameOfThePoses) {
  ASSERT_NO_FATAL_FAILURE(write_pairs());
  const Status done = run_survey(options_, out_);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(out_.str().rfind("3 pairs, ", 0), 0U) << out_.str();
  const app::LandmarkLibrary library({.folder = options_.out, .robot_id = "", .software_version = ""});
  const auto loaded = library.load("lab");
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_GT(loaded->database->size(), 20U);
  for (const localize::Landmark& landmark : loaded->database->landmarks()) {
    EXPECT_GT(landmark.p_map.x(), -0.5);
    EXPECT_LT(landmark.p_map.x(), 10.5) << "outside the laboratory";
    EXPECT_GE(landmark.seen, 3);
  }
  const Status again = run_survey(options_, out_);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, Errc::kRefused);
}

TEST_F(SurveyCommandTest, WhatCannotBeUsedIsNamed) {
  const Status none = run_survey(options_, out_);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("pairs"), std::string::npos) << none.error().message;
  const Image black(1024, 768, 1);
  ASSERT_TRUE(image::write_png(options_.folder / "7_left.png", black));
  ASSERT_TRUE(image::write_png(options_.folder / "7_right.png", black));
  static_cast<void>(write("pairs/poses.csv", "name,x_m,y_m,theta_deg\n7,0,0,0\n"));
  const Status dark = run_survey(options_, out_);
  ASSERT_FALSE(dark);
  EXPECT_NE(dark.error().message.find("pair '7'"), std::string::npos) << dark.error().message;
  EXPECT_FALSE(fs::exists(options_.out / "lab.seekerlm"));
}

}  // namespace
}  // namespace seeker::lab
