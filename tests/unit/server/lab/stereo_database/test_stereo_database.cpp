#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/lab/stereo_database/reproduce_stereo_database.hpp"
#include "server/lab/stereo_database/stereo_run.hpp"
#include "server/lab/stereo_database/stereo_scene.hpp"
#include "server/sim/scene.hpp"
#include "tests/support/data.hpp"

namespace seeker::lab {
namespace {

using ::testing::HasSubstr;

DatabaseScore score_of(const char* name, int landmarks, double rms_m, double compared) {
  DatabaseScore score;
  score.name = name;
  score.landmarks = landmarks;
  score.frames = 50;
  score.rms_m = rms_m;
  score.rms_rad = 0.002;
  score.mean_nees = 3.0;
  score.mean_compared = compared;
  return score;
}

/// A run that passes everything.
StereoResult good_run() {
  StereoResult run;
  run.mode = "default";
  run.seed = 1;
  run.scores = {score_of("all", 8000, 0.010, 20.0), score_of("sparse", 3000, 0.011, 3.0),
                score_of("salient", 800, 0.0105, 1.0), score_of("updated", 820, 0.011, 1.0)};
  run.before = 800;
  run.added = 50;
  run.removed = 30;
  run.after = 820;
  run.places = 20;
  run.places_found = 20;
  run.foreign = 100;
  return run;
}

bool passes(const StereoResult& run, const std::string& id) {
  Report report(nullptr);
  check_stereo({run}, report);
  bool passed = true;
  bool found = false;
  for (const Check& check : report.checks()) {
    if (check.id == id) {
      found = true;
      passed = passed && check.passed;
    }
  }
  EXPECT_TRUE(found) << id;
  return passed;
}

TEST(S2Checks, AGoodRunPasses) {
  for (const char* id : {"R3", "R4", "S2-RMS", "S2-PLACE", "S2-FOREIGN"}) {
    EXPECT_TRUE(passes(good_run(), id)) << id;
  }
}

TEST(S2Checks, EachConditionCanFail) {
  StereoResult run = good_run();
  run.scores[2].rms_m = 0.012;
  EXPECT_FALSE(passes(run, "R3")) << "salient is worse than 1.1 times all";
  run = good_run();
  run.scores[1].mean_compared = 30.0;
  EXPECT_FALSE(passes(run, "R3")) << "sparse compares more than all";
  run = good_run();
  run.after = 900;
  EXPECT_FALSE(passes(run, "R4")) << "the counts do not add up";
  run = good_run();
  run.removed = 0;
  run.after = 850;
  EXPECT_FALSE(passes(run, "R4")) << "nothing was removed";
  run = good_run();
  run.scores[3].rms_m = 0.02;
  EXPECT_FALSE(passes(run, "R4")) << "worse after the update";
  run = good_run();
  run.scores[2].unnoticed = 1;
  EXPECT_FALSE(passes(run, "S2-RMS")) << "lost without saying so";
  run = good_run();
  run.scores[2].mean_nees = 7.0;
  EXPECT_FALSE(passes(run, "S2-RMS"));
  run = good_run();
  run.places_found = 18;
  EXPECT_FALSE(passes(run, "S2-PLACE"));
  run = good_run();
  run.places_wrong = 1;
  EXPECT_FALSE(passes(run, "S2-PLACE"));
  run = good_run();
  run.foreign_found = 1;
  EXPECT_FALSE(passes(run, "S2-FOREIGN"));
}

TEST(S2Checks, Table3HasARowForEveryDatabase) {
  const std::string table = table3_csv({good_run()});
  for (const char* name : {"all", "sparse", "salient", "updated"}) {
    EXPECT_THAT(table, HasSubstr(std::string("default,1,") + name));
  }
}

TEST(Report, FindingOfThePrintedMethodIsNoFailure) {
  std::ostringstream lines;
  Report report(&lines);
  report.add({.id = "R1", .passed = true, .figures = {{"a", "1"}}, .finding = true});
  report.add({.id = "R2", .passed = false, .figures = {{"b", "2"}}, .finding = true});
  EXPECT_TRUE(report.passed());
  report.add({.id = "R3", .passed = false, .figures = {}});
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(lines.str(), "PASS R1 a=1\nFINDING R2 b=2\nFAIL R3\n");
  EXPECT_THAT(report.json(), HasSubstr("\"verdict\":\"FINDING\""));
}

TEST(S2Scene, SurveyStandsInFivePlacesWithRoomAroundThem) {
  const auto world = load_laboratory(testing::source_file("config"), 3);
  ASSERT_TRUE(world) << world.error().message;
  const sim::RobotModel model;
  const std::vector<Pose2> poses = survey_poses(*world, model);
  ASSERT_EQ(poses.size(), 60U);
  const sim::Scene scene(*world);
  for (std::size_t i = 0; i < poses.size(); i += 12) {
    EXPECT_GT(scene.clearance_m(poses[i].translation(), 0.3, {0.0, model.stereo.height_m}), 0.29);
  }
}

// Things near the camera look otherwise to each eye: beside a wall one eye's picture is the poorer by far.
TEST(S2Scene, AViewOfSmoothThingsFromNearIsNotCalledBlurred) {
  for (const Pose2& pose : {Pose2{3.29, 0.89, -2.58}, Pose2{1.08, 8.31, 2.49}, Pose2{8.12, 5.13, 0.65}}) {
    auto robot =
        SeeingRobot::create(*load_laboratory(testing::source_file("config"), 2), sim::RobotModel{}, {}, pose, 1);
    ASSERT_TRUE(robot) << robot.error().message;
    const auto seen = robot->look();
    EXPECT_TRUE(seen) << seen.error().message;
  }
}

TEST(S2Scene, ARobotThatTurnsTellsByHowMuch) {
  const Pose2 start{4.4, 6.7, 1.0};
  auto robot =
      SeeingRobot::create(*load_laboratory(testing::source_file("config"), 2), sim::RobotModel{}, {}, start, 1);
  ASSERT_TRUE(robot) << robot.error().message;
  double told_rad = 0.0;
  for (const Twist2& velocity : robot->rotate(0.5)) {
    told_rad += velocity.omega_rad_s * kEncoderPeriod_s;
  }
  EXPECT_NEAR(told_rad, 0.5, 0.03);
  EXPECT_NEAR(wrap_angle(robot->world_T_base().theta_rad - start.theta_rad), 0.5, 0.06);
  EXPECT_NEAR(distance_m(robot->world_T_base(), start), 0.0, 0.02);
}

TEST(S2Scene, MovedFurnitureLeavesTheWayFree) {
  const auto world = load_laboratory(testing::source_file("config"), 3);
  ASSERT_TRUE(world) << world.error().message;
  Rng rng(4);
  const auto moved = move_furniture(*world, sim::RobotModel{}, 0.05, rng);
  ASSERT_TRUE(moved) << moved.error().message;
  int changed = 0;
  for (std::size_t i = 0; i < world->boxes.size(); ++i) {
    changed += moved->boxes[i].world_T_box == world->boxes[i].world_T_box ? 0 : 1;
  }
  EXPECT_GT(changed, 0);
}

}  // namespace
}  // namespace seeker::lab
