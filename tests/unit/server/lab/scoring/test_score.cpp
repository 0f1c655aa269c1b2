#include <sstream>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/lab/scoring/log_poses.hpp"
#include "server/lab/scoring/score_command.hpp"
#include "server/lab/scoring/score_reference.hpp"
#include "server/lab/scoring/score_relations.hpp"
#include "server/lab/scoring/score_report.hpp"
#include "tests/support/data.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

class Score : public LabFiles {};

TEST(RelationLine, IsReadAndChecked) {
  const auto relation = parse_relation_line("1216.63 1217.49 0.4 -0.02 0 0 0 -0.07");
  ASSERT_TRUE(relation && *relation);
  EXPECT_EQ((*relation)->from_s, 1216.63);
  EXPECT_EQ((*relation)->to_s, 1217.49);
  EXPECT_THAT((*relation)->from_T_to, testing::Pose2Near(Pose2{0.4, -0.02, -0.07}, 1e-12, 1e-12));
  EXPECT_FALSE(*parse_relation_line("# comment"));
  EXPECT_FALSE(*parse_relation_line("  "));
  for (const char* line : {"1 2 3", "1 2 0 0 0 0 0 x", "1 2 0 0 0 0 0 0 0", "1 2 nan 0 0 0 0 0"}) {
    EXPECT_EQ(parse_relation_line(line).error().code, Errc::kParse) << line;
  }
}

TEST_F(Score, BadRelationsAreCountedAndReadingGoesOn) {
  const auto read = read_relations(write("r", "1 2 0 0 0 0 0 0\nrubbish\n3 4 1 0 0 0 0 0\n5 6 1 0\n"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->relations.size(), 2U);
  EXPECT_EQ(read->bad.count, 2U);
  EXPECT_EQ(read->bad.examples.front().number, 2U);
  EXPECT_EQ(complaints("r", read->bad, read->damage).rfind("r: 2 bad lines were skipped (first: line 2", 0), 0U);
}

/// The relation error of one relation whose estimate is off by a known motion.
TEST(RelationMetric, IsThePlaceOfTheErrorMotion) {
  const Trajectory trajectory = {{1.0, {5.0, 5.0, 1.0}}, {2.0, Pose2{5.0, 5.0, 1.0} * Pose2{2.0, 1.0, 0.5}}};
  const Pose2 error{0.03, -0.04, 0.02};
  const std::vector<Relation> relations = {{101.0, 102.0, Pose2{2.0, 1.0, 0.5} * inverse(error)}};
  const auto report = score_relations(trajectory, {}, relations, {}, {.offset_s = 100.0});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->all.used, 1U);
  EXPECT_NEAR(report->all.translation_m.mean, 0.05, 1e-12);
  EXPECT_NEAR(report->all.rotation_deg.mean, rad_to_deg(0.02), 1e-9);
  EXPECT_FALSE(report->exact);
}

TEST(RelationMetric, CarriesPosesByTheOdometryBetweenScans) {
  // The robot turns on the spot, then drives: between the scans it was nowhere near the straight line.
  const Trajectory odometry = {{0.0, {0.0, 0.0, 0.0}}, {1.0, {0.0, 0.0, kPi / 2.0}}, {2.0, {0.0, 2.0, kPi / 2.0}}};
  const Trajectory scans = {{0.0, {0.0, 0.0, 0.0}}, {2.0, {0.0, 2.0, kPi / 2.0}}};
  const std::vector<Relation> relations = {{0.0, 1.0, {0.0, 0.0, kPi / 2.0}}};
  const RelationParams params{.max_gap_s = 2.0};
  const auto carried = score_relations(scans, odometry, relations, {}, params);
  const auto interpolated = score_relations(scans, {}, relations, {}, params);
  ASSERT_TRUE(carried && interpolated);
  EXPECT_NEAR(carried->all.translation_m.mean, 0.0, 1e-12);
  EXPECT_NEAR(carried->all.rotation_deg.mean, 0.0, 1e-9);
  EXPECT_NEAR(interpolated->all.translation_m.mean, 1.0, 1e-12);
}

TEST(RelationMetric, CountsWhatItMissesAndScoresExactStampsApart) {
  const Trajectory trajectory = {{0.0, {}}, {1.0, {1.0, 0.0, 0.0}}, {5.0, {2.0, 0.0, 0.0}}};
  const std::vector<Relation> relations = {
      {0.0, 1.0, {1.0, 0.0, 0.0}},   // between exact scans, right
      {0.0, 1.2, {1.25, 0.0, 0.0}},  // ends beside one, 0.2 m wrong
      {1.0, 3.0, {}},                // in a gap
      {-1.0, 1.0, {}},               // before the trajectory
  };
  const auto report = score_relations(trajectory, {}, relations, {0.0, 1.0});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->all.used, 2U);
  EXPECT_EQ(report->missed, 2U);
  EXPECT_NEAR(report->all.translation_m.max, 0.2, 1e-12);
  ASSERT_TRUE(report->exact);
  EXPECT_EQ(report->exact->used, 1U);
  EXPECT_NEAR(report->exact->translation_m.max, 0.0, 1e-12);
}

TEST(RelationMetric, RefusesClocksThatDoNotFit) {
  const Trajectory trajectory = {{0.0, {}}, {1.0, {}}};
  EXPECT_EQ(score_relations(trajectory, {}, {{1000.0, 1001.0, {}}}, {}).error().code, Errc::kInvalidArgument);
}

TEST(Figures, OfAList) {
  const ErrorFigures figures = figures_of({4.0, 1.0, 2.0, 1.0});
  EXPECT_EQ(figures.mean, 2.0);
  EXPECT_EQ(figures.median, 1.5);
  EXPECT_EQ(figures.max, 4.0);
  EXPECT_NEAR(figures.standard_deviation, std::sqrt(1.5), 1e-12);
  EXPECT_EQ(figures_of({3.0, 1.0, 2.0}).median, 2.0);
}

TEST(ReferenceMetric, IsBlindToTheFrameAndSeesTheRest) {
  Rng rng(5);
  const Pose2 frame{12.0, -7.0, 2.5};
  Trajectory reference;
  Trajectory exact;
  Trajectory noisy;
  for (int k = 0; k < 2000; ++k) {
    const double t = 0.05 * k;
    const Pose2 pose{std::cos(0.3 * t) * 5.0, std::sin(0.4 * t) * 3.0, wrap_angle(t)};
    reference.push_back({t, pose});
    exact.push_back({t, frame * pose});
    noisy.push_back(
        {t, frame * Pose2{pose.x_m + rng.normal(0.1), pose.y_m + rng.normal(0.1), pose.theta_rad + rng.normal(0.02)}});
  }
  const auto perfect = score_reference(exact, reference, 0.5);
  ASSERT_TRUE(perfect) << perfect.error().message;
  EXPECT_NEAR(perfect->translation_rms_m, 0.0, 1e-9);
  EXPECT_NEAR(perfect->rotation_rms_deg, 0.0, 1e-9);
  EXPECT_THAT(perfect->reference_T_map, testing::Pose2Near(inverse(frame), 1e-9, 1e-9));
  const auto off = score_reference(noisy, reference, 0.5);
  ASSERT_TRUE(off);
  EXPECT_NEAR(off->translation_rms_m, 0.1 * std::sqrt(2.0), 0.01);
  EXPECT_NEAR(off->rotation_rms_deg, rad_to_deg(0.02), 0.1);
}

TEST(ReferenceMetric, MissesWhatLiesOutsideTheReference) {
  const Trajectory reference = {{0.0, {}}, {1.0, {1.0, 0.0, 0.0}}, {9.0, {2.0, 0.0, 0.0}}};
  const Trajectory trajectory = {{0.0, {}}, {1.0, {1.0, 0.0, 0.0}}, {5.0, {}}, {10.0, {}}};
  const auto report = score_reference(trajectory, reference, 0.5);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->used, 2U);
  EXPECT_EQ(report->missed, 2U);
  EXPECT_EQ(score_reference({{50.0, {}}}, reference, 0.5).error().code, Errc::kInvalidArgument);
}

TEST_F(Score, TheCommandNamesWhatDoesNotGoTogether) {
  std::ostringstream out;
  std::ostringstream notes;
  ScoreOptions options;
  options.trajectory = write("t.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  EXPECT_EQ(run_score(options, out, notes).error().code, Errc::kInvalidArgument);
  options.corrections = options.trajectory;
  EXPECT_EQ(run_score(options, out, notes).error().code, Errc::kInvalidArgument);
  options.corrections.clear();
  options.relations = write("r", "0 1 1 0 0 0 0 0\nrubbish\n");
  options.json = true;
  ASSERT_TRUE(run_score(options, out, notes));
  EXPECT_NE(out.str().find("\"relations\":1"), std::string::npos);
  EXPECT_NE(notes.str().find("1 bad lines were skipped"), std::string::npos);
}

/// Poses of a recorded log against its relations, interpolated between scans.
RelationReport score_of_log(const std::filesystem::path& log, const std::filesystem::path& relations, bool corrected,
                            double offset_s) {
  const auto poses = read_log_poses(log);
  const auto truth = read_relations(relations);
  EXPECT_TRUE(poses && truth);
  const auto report = score_relations(corrected ? poses->corrected : poses->odometry, {}, truth->relations,
                                      poses->exact_stamps_s, {.offset_s = offset_s});
  EXPECT_TRUE(report);
  return *report;
}

TEST(RecordedRelations, TheMappersPosesOfFreiburg079ScoreAsPublishedWithTheRecording) {
  SEEKER_REQUIRE_DATA(log, "lidar/fr079.clf.gz");
  SEEKER_REQUIRE_DATA(relations, "lidar/fr079.relations.gz");
  struct Row {
    double offset_s;
    double translation_m;
    double rotation_deg;
  };
  for (const Row& row : {Row{1211.36, 0.0497, 1.63}, Row{1211.40, 0.0532, 1.18}, Row{1211.44, 0.0595, 1.00}}) {
    const RelationScore score = score_of_log(log, relations, true, row.offset_s).all;
    EXPECT_NEAR(score.translation_m.mean, row.translation_m, 0.00006) << row.offset_s;
    EXPECT_NEAR(score.rotation_deg.mean, row.rotation_deg, 0.006) << row.offset_s;
  }
  const RelationScore odometry = score_of_log(log, relations, false, 1211.40).all;
  EXPECT_NEAR(odometry.translation_m.mean, 6.5, 0.1);
  EXPECT_NEAR(odometry.rotation_deg.mean, 30.0, 1.0);
}

TEST(RecordedRelations, MostOfIntelHaveScansNearBothTimes) {
  SEEKER_REQUIRE_DATA(log, "lidar/intel.clf.gz");
  SEEKER_REQUIRE_DATA(relations, "lidar/intel.relations.gz");
  const RelationReport report = score_of_log(log, relations, false, 0.0);
  EXPECT_GE(report.all.used, 2782U);
  EXPECT_EQ(report.all.used + report.missed, 2984U);
  EXPECT_GT(report.all.translation_m.mean, 1.0);
  ASSERT_TRUE(report.exact);
  EXPECT_EQ(report.exact->used, 19U);
}

}  // namespace
}  // namespace seeker::lab
