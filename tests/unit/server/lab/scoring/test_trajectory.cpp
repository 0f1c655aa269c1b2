#include "server/lab/scoring/trajectory.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/lab/scoring/log_poses.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

class TrajectoryFiles : public LabFiles {};

TEST_F(TrajectoryFiles, AreReadBackAsTheyWereWritten) {
  const Trajectory trajectory = {{976052856.336081, {1.25, -2.5, 3.0}}, {976052857.322128, {-0.001, 1e3, -3.1}}};
  const auto path = write("poses.tum", tum_text(trajectory));
  const auto read = read_trajectory(path);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->poses.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(read->poses[k].stamp_s, trajectory[k].stamp_s, 1e-6);
    EXPECT_THAT(read->poses[k].map_T_base, testing::Pose2Near(trajectory[k].map_T_base, 1e-9, 1e-9));
  }
  EXPECT_EQ(read->bad.count, 0U);
}

TEST_F(TrajectoryFiles, BadLinesAreCountedAndReadingGoesOn) {
  const auto path = write("poses.csv",
                          "# map -> odom\n"
                          "t,x,y,theta\n"
                          "1.0,1,2,0.5\n"
                          "1.5,1,2\n"
                          "0.5,1,2,0.5\n"
                          "2.0,nan,2,0.5\n"
                          "\n"
                          "3.0,4,5,6.5\n");
  const auto read = read_trajectory(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->poses.size(), 2U);
  EXPECT_NEAR(read->poses[1].map_T_base.theta_rad, 6.5 - kTwoPi, 1e-12);
  EXPECT_EQ(read->bad.count, 3U);
  ASSERT_EQ(read->bad.examples.size(), 3U);
  EXPECT_EQ(read->bad.examples[0].number, 4U);
  EXPECT_EQ(read->bad.examples[1].number, 5U);
  EXPECT_NE(read->bad.examples[1].reason.find("does not rise"), std::string::npos);
}

TEST_F(TrajectoryFiles, WithoutAPoseAreRefused) {
  EXPECT_EQ(read_trajectory(write("empty.tum", "# nothing\n")).error().code, Errc::kParse);
  EXPECT_EQ(read_trajectory(folder() / "none.tum").error().code, Errc::kNotFound);
}

TEST(PoseLine, RefusesWhatIsNoPlanarPose) {
  for (const char* line : {"1 2 3 0 0 0 0", "1 2 3 0 0 0 0 1 9", "1 2 3 0 0 0 0 0", "1 2 3 0 0.5 0 0 0.8",
                           "a 2 3 0 0 0 0 1", "1 2 3 0 0 0 inf 1", "1,2,3,4,5", "1,2,3,x"}) {
    EXPECT_EQ(parse_pose_line(line).error().code, Errc::kParse) << line;
  }
  const auto scaled = parse_pose_line("1 2 3 0 0 0 2 2");
  ASSERT_TRUE(scaled && *scaled);
  EXPECT_NEAR((*scaled)->map_T_base.theta_rad, kPi / 2.0, 1e-12);
}

TEST(PoseAt, LiesOnTheShorterTurnBetweenItsNeighbours) {
  const Trajectory trajectory = {{10.0, {0.0, 0.0, 3.0}}, {12.0, {2.0, 4.0, -3.0}}};
  EXPECT_FALSE(pose_at(trajectory, 9.999));
  EXPECT_FALSE(pose_at(trajectory, 12.001));
  EXPECT_THAT(*pose_at(trajectory, 12.0), testing::Pose2Near(Pose2{2.0, 4.0, -3.0}, 1e-12, 1e-12));
  const Pose2 quarter = *pose_at(trajectory, 10.5);
  EXPECT_THAT(quarter, testing::Pose2Near(Pose2{0.5, 1.0, 3.0 + 0.25 * (kTwoPi - 6.0)}, 1e-12, 1e-12));
  EXPECT_NEAR(time_to_nearest_s(trajectory, 10.5), 0.5, 1e-12);
  EXPECT_NEAR(time_to_nearest_s(trajectory, 13.0), 1.0, 1e-12);
  EXPECT_NEAR(length_m(trajectory), std::sqrt(20.0), 1e-12);
}

class LogPosesOf : public LabFiles {};

TEST_F(LogPosesOf, AScanLogAreOdometryCorrectionsAndExactStamps) {
  const auto path = write("log.clf",
                          "ODOM 7 7 0 0 0 0 0.5 h 0.5\n"
                          "FLASER 2 1 1 10 11 0.1 1 2 0.3 1.0 exact 1.0\n"
                          "FLASER 2 1 1 20 21 0.2 3 4 0.5 2.0 interp 2.0\n"
                          "FLASER 2 1 1 20 21 0.2 3 4 0.5 1.5 exact 1.5\n"
                          "FLASER 2 1\n");
  const auto poses = read_log_poses(path);
  ASSERT_TRUE(poses) << poses.error().message;
  EXPECT_EQ(poses->odometry, (Trajectory{{1.0, {1.0, 2.0, 0.3}}, {2.0, {3.0, 4.0, 0.5}}}));
  EXPECT_EQ(poses->corrected, (Trajectory{{1.0, {10.0, 11.0, 0.1}}, {2.0, {20.0, 21.0, 0.2}}}));
  EXPECT_EQ(poses->exact_stamps_s, (std::vector<double>{1.0}));
  EXPECT_EQ(poses->summary.bad, 2U);
}

TEST_F(LogPosesOf, ALogOfOdometryAloneAreItsRecords) {
  const auto poses = read_log_poses(write("odom.clf", "ODOM 7 8 0.5 0 0 0 0.5 h 0.5\n"));
  ASSERT_TRUE(poses) << poses.error().message;
  EXPECT_EQ(poses->odometry, (Trajectory{{0.5, {7.0, 8.0, 0.5}}}));
  EXPECT_EQ(read_log_poses(write("none.clf", "# nothing\n")).error().code, Errc::kParse);
}

}  // namespace
}  // namespace seeker::lab
