#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/lab/experiments/sim_run.hpp"
#include "server/lab/stereo_database/reproduce_stereo_database.hpp"
#include "server/lab/stereo_database/stereo_bisection.hpp"
#include "server/lab/stereo_database/stereo_comparison.hpp"
#include "server/lab/stereo_database/stereo_run.hpp"
#include "server/lab/stereo_database/stereo_scene.hpp"
#include "server/sim/scene.hpp"
#include "tests/support/data.hpp"

namespace seeker::lab {
namespace {

using ::testing::Contains;
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

/// A run of which every row of the comparison is met.
StereoResult shown_run() {
  StereoResult run = good_run();
  run.survey_pictures = 60;
  run.survey_before = 6000;
  run.survey_after = 3000;
  run.added_features = run.known_features = run.thinned_features = 10;
  run.frames_shown = 4;
  double step_ms = 3.0;
  for (DatabaseScore& score : run.scores) {
    score.inside = 1.0;
    score.median_step_ms = step_ms--;
  }
  return run;
}

/// Verdicts of the rows of one printed and one of our runs.
std::string verdicts_of(const StereoResult& printed, const StereoResult& ours) {
  Report report(nullptr);
  compare_stereo({printed}, {ours}, report);
  std::string verdicts;
  for (const Check& check : report.checks()) {
    verdicts += check.passed ? 'P' : check.finding ? 'f' : 'F';
  }
  return verdicts;
}

TEST(S2Comparison, WhatOnlyThePrintedRobotMissesIsAFindingAndWhatOursMissesAFailure) {
  const StereoResult good = shown_run();
  EXPECT_EQ(verdicts_of(good, good), "PPPPPPPPPP");
  StereoResult bad = good;
  bad.survey_after = 0;            // Table 1
  bad.scores[2].landmarks = 9000;  // Table 2
  bad.frames_shown = 3;            // Fig 12
  bad.removed = 0;                 // R4, landmarks
  EXPECT_EQ(verdicts_of(bad, good), "ffPPPPfPfP");
  EXPECT_EQ(verdicts_of(good, bad), "FFPPPPFPFP");
  bad = good;
  bad.scores[2].rms_m = 0.2;  // Table 3 and Fig 13
  bad.scores[2].inside = 0.5;
  bad.scores[1].median_step_ms = 4.0;
  bad.thinned_features = 0;
  bad.scores[3].rms_m = 0.3;
  EXPECT_EQ(verdicts_of(bad, good), "PPffffPfPf");
  EXPECT_EQ(verdicts_of(bad, bad), "PPFFFFPFPF");
}

TEST(S2Comparison, UpdateIsLeftOutWhereThePrintedRobotMadeNone) {
  StereoResult none = shown_run();
  none.scores.pop_back();
  none.before = 0;
  EXPECT_EQ(verdicts_of(none, shown_run()), "PPPPPPPP");
}

TEST(S2Bisection, NamesTheChoiceThatCostsMostAndFailsWhereOursIsNoBetter) {
  BisectionResult result;
  result.rows = {{"printed", 300, 0.06, 0.04},
                 {"search", 300, 0.06, 0.039},
                 {"filter", 300, 0.05, 0.02},
                 {"ours", 600, 0.005, 0.005}};
  Report report(nullptr);
  report_bisection({result}, report);
  ASSERT_EQ(report.checks().size(), 1U);
  EXPECT_TRUE(report.checks().front().passed);
  EXPECT_THAT(report.checks().front().figures, Contains(std::pair<std::string, std::string>("most", "filter")));
  result.rows.back().salient_rms_m = 0.05;
  report_bisection({result}, report);
  EXPECT_FALSE(report.checks().back().passed);
}

TEST(S2Bisection, AllPrintedChoicesTogetherAreTheDifferenceFromOurRobot) {
  SimSpec printed;
  printed.robot_file = testing::source_file("config/robots/paper/stereo-2017.yaml");
  printed.world_file = testing::source_file("config/worlds/laboratory.yaml");
  SimSpec ours = printed;
  ours.robot_file = testing::source_file("config/robots/stereo.yaml");
  for (const PrintedChoice& choice : printed_choices()) {
    printed.overrides.insert(printed.overrides.end(), choice.as_ours.begin(), choice.as_ours.end());
  }
  auto one = sim_options(printed);
  const auto other = sim_options(ours);
  ASSERT_TRUE(one) << one.error().message;
  ASSERT_TRUE(other) << other.error().message;
  EXPECT_EQ(one->stereo.features, other->stereo.features);
  EXPECT_EQ(one->stereo.database, other->stereo.database);
  // An angle that is no round number of degrees.
  double& bearing_floor_rad = one->stereo.localiser.measurement.bearing_floor_rad;
  EXPECT_NEAR(bearing_floor_rad, other->stereo.localiser.measurement.bearing_floor_rad, 1e-9);
  bearing_floor_rad = other->stereo.localiser.measurement.bearing_floor_rad;
  EXPECT_EQ(one->stereo.localiser, other->stereo.localiser);
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
