// The pose and the map's epoch: what follows when the map moves, and in which order readings reach the estimator.

#include <gtest/gtest.h>

#include "tests/unit/server/app/loop/fake_deck.hpp"

namespace seeker::app {
namespace {

using std::chrono::milliseconds;

class LocaliserTest : public ::testing::Test, protected testing::FakeDeck {};

TEST_F(LocaliserTest, AnEpochThatRisesMovesTheMapByWhatOdometryDoesNotExplain) {
  base->next = testing::odometry_at(clock->time, {});
  EXPECT_FALSE(tick());
  base->next = testing::odometry_at(clock->time, Pose2{0.2, 0.0, 0.0});
  estimator->pose.map_T_base = Pose2{0.2, 0.5, 0.0};
  estimator->pose.map_epoch = 1;
  const std::optional<MapShift> shift = tick();
  ASSERT_TRUE(shift);
  EXPECT_EQ(shift->correction.from_epoch, 0U);
  EXPECT_EQ(shift->correction.to_epoch, 1U);
  ASSERT_TRUE(shift->new_T_old);
  EXPECT_NEAR(shift->new_T_old->x_m, 0.0, 1e-9);
  EXPECT_NEAR(shift->new_T_old->y_m, 0.5, 1e-9);
}

TEST_F(LocaliserTest, ARobotThatIsFoundLeavesTheMapWhereItIs) {
  estimator->pose.quality = LocalisationQuality::kLost;
  base->next = testing::odometry_at(clock->time, {});
  EXPECT_FALSE(tick());
  base->next = testing::odometry_at(clock->time, {});
  estimator->pose = {.stamp = clock->time,
                     .map_T_base = Pose2{7.0, 0.0, 0.0},
                     .quality = LocalisationQuality::kLocalised,
                     .cause = "",
                     .map_epoch = 1};
  const std::optional<MapShift> shift = tick();
  ASSERT_TRUE(shift);
  EXPECT_FALSE(shift->new_T_old);
  EXPECT_FALSE(shift->correction.move.moves());
}

TEST_F(LocaliserTest, ASweepThatArrivesLateComesBetweenTheOdometryBeforeAndAfterIt) {
  base->next = testing::odometry_at(clock->time, {});
  EXPECT_FALSE(tick());
  const RobotTime sweep = clock->time - milliseconds(50);
  lidar->next = testing::sweep_at(sweep, 3.0F);
  base->next = testing::odometry_at(clock->time, Pose2{0.1, 0.0, 0.0});
  EXPECT_FALSE(tick());
  ASSERT_EQ(estimator->odometry.size(), 3U);
  EXPECT_EQ(estimator->odometry[1], sweep) << "the odometry at the sweep's own stamp";
  EXPECT_EQ(estimator->scans.size(), 1U);
}

TEST_F(LocaliserTest, ASweepThatOdometryHasOvertakenIsSeenFromThatOdometry) {
  for (const double x_m : {0.0, 0.1, 0.2, 0.3}) {
    base->next = testing::odometry_at(clock->time, Pose2{x_m, 0.0, 0.0});
    EXPECT_FALSE(tick());
  }
  // Made halfway between the second and the third; the newest has come since.
  const RobotTime sweep = clock->time - milliseconds(250);
  lidar->next = testing::sweep_at(sweep, 3.0F);
  EXPECT_FALSE(tick());
  ASSERT_EQ(estimator->odometry.size(), 4U) << "no time runs backwards";
  ASSERT_EQ(estimator->scans.size(), 1U);
  EXPECT_NEAR(estimator->scans[0].base_T_laser.x_m, -0.15, 1e-9);
}

TEST_F(LocaliserTest, ARefusedReadingIsAWarningAndTheEstimateGoesOn) {
  estimator->odometry_ok = fail(Errc::kInvalidArgument, "time runs backwards");
  base->next = testing::odometry_at(clock->time, {});
  EXPECT_FALSE(tick());
  ASSERT_TRUE(diagnostics.faults().find("odometry-refused"));
  EXPECT_EQ(localiser.pose().quality, LocalisationQuality::kLocalised);
}

TEST_F(LocaliserTest, NothingIsMappedWhileTheRobotIsNotPlaced) {
  estimator->pose.quality = LocalisationQuality::kLost;
  base->next = testing::odometry_at(clock->time, {});
  lidar->next = testing::sweep_at(clock->time, 3.0F);
  EXPECT_FALSE(tick());
  const std::uint64_t before = localiser.map().revision();
  localiser.map_readings(sensing);
  EXPECT_EQ(localiser.map().revision(), before);
  estimator->pose.quality = LocalisationQuality::kLocalised;
  lidar->next = testing::sweep_at(clock->time, 3.0F);
  EXPECT_FALSE(tick());
  localiser.map_readings(sensing);
  EXPECT_GT(localiser.map().revision(), before);
}

}  // namespace
}  // namespace seeker::app
