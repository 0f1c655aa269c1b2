// What the devices say: fresh and stale readings, faults of silent and of broken devices, restarts.

#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/server/app/loop/fake_deck.hpp"

namespace seeker::app {
namespace {

using std::chrono::milliseconds;

class SensingTest : public ::testing::Test, protected testing::FakeDeck {
 protected:
  SensingTest() { sensing.restart_patience(); }
  void read_after(Duration passed) {
    clock->time += passed;
    sensing.read();
  }
  [[nodiscard]] bool has_fault(const std::string& id) const { return diagnostics.faults().find(id).has_value(); }
};

TEST_F(SensingTest, AReadingIsFreshInTheTickThatBroughtItOnly) {
  base->next = testing::odometry_at(clock->time, Pose2{1.0, 0.0, 0.0}, {0.2, 0.0});
  read_after(milliseconds(100));
  EXPECT_NE(sensing.new_odometry(), nullptr);
  EXPECT_EQ(sensing.new_scan(), nullptr);
  EXPECT_TRUE(sensing.moving());
  read_after(milliseconds(100));
  EXPECT_EQ(sensing.new_odometry(), nullptr);
  ASSERT_NE(sensing.odometry(), nullptr) << "the newest stays known";
  EXPECT_EQ(sensing.odom_T_base().x_m, 1.0);
  EXPECT_EQ(sensing.scan(), nullptr);
}

TEST_F(SensingTest, ASilentDeviceIsAFaultUntilItSpeaksAgain) {
  read_after(milliseconds(400));
  EXPECT_FALSE(has_fault("base-silent"));
  read_after(milliseconds(200));
  EXPECT_TRUE(has_fault("base-silent")) << "its time-out is 500 ms";
  EXPECT_FALSE(has_fault("lidar-silent")) << "that of the lidar is a second";
  base->next = testing::odometry_at(clock->time, {});
  read_after(milliseconds(100));
  EXPECT_FALSE(has_fault("base-silent"));
}

TEST_F(SensingTest, AReadingThatCannotBeIsAFaultAndIsNotTaken) {
  base->next = testing::odometry_at(clock->time, Pose2{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  read_after(milliseconds(100));
  EXPECT_TRUE(has_fault("base-invalid"));
  EXPECT_EQ(sensing.odometry(), nullptr);
  lidar->next = testing::sweep_at(clock->time, -1.0F);
  read_after(milliseconds(100));
  EXPECT_TRUE(has_fault("lidar-invalid"));
  EXPECT_EQ(sensing.scan(), nullptr);
}

TEST_F(SensingTest, AScanThatTookItsTimeIsSeenAsIfMeasuredAtOnce) {
  LaserScan scan = testing::sweep_at(clock->time + milliseconds(100), 2.0F);
  scan.ranges_m[30] = 1.0F;  // the last beam, measured half a sweep before the stamp
  scan.sweep = milliseconds(-200);
  base->next = testing::odometry_at(clock->time, {}, {0.0, 1.0});
  sensing.read();
  base->next = testing::odometry_at(clock->time + milliseconds(200), {0.0, 0.0, 0.2}, {0.0, 1.0});
  lidar->next = scan;
  read_after(milliseconds(200));
  ASSERT_NE(sensing.new_scan(), nullptr);
  EXPECT_EQ(sensing.scan()->sweep, Duration::zero());
  EXPECT_EQ(sensing.scan()->stamp, scan.stamp);
  EXPECT_FLOAT_EQ(sensing.scan()->ranges_m[29], 1.0F) << "the base stood a step further to the right then";
}

TEST_F(SensingTest, AScanMeasuredAtOnceIsSeenAsItIs) {
  base->next = testing::odometry_at(clock->time, {}, {0.0, 1.0});
  read_after(milliseconds(100));
  const LaserScan scan = testing::sweep_at(clock->time, 2.0F);
  lidar->next = scan;
  read_after(milliseconds(100));
  ASSERT_NE(sensing.new_scan(), nullptr);
  EXPECT_EQ(*sensing.scan(), scan);
}

TEST_F(SensingTest, WithoutOdometryASweepStaysAsItIs) {
  LaserScan scan = testing::sweep_at(clock->time, 2.0F);
  scan.sweep = milliseconds(-200);
  lidar->next = scan;
  read_after(milliseconds(100));
  ASSERT_NE(sensing.new_scan(), nullptr);
  EXPECT_EQ(*sensing.scan(), scan);
}

TEST_F(SensingTest, ReadingsOfAWorldThatIsAwayAreItsFaultAlone) {
  clock->link = fail(Errc::kNotReady, "the link is cut");
  base->ok = lidar->ok = fail(Errc::kIo, "no answer");
  read_after(milliseconds(100));
  EXPECT_TRUE(has_fault("world-lost"));
  EXPECT_FALSE(has_fault("base-invalid"));
  clock->link = {};
  base->ok = lidar->ok = {};
  EXPECT_TRUE(world.check());
  read_after(milliseconds(400));
  EXPECT_TRUE(diagnostics.faults().all().empty()) << "silence counts from the world's return";
}

TEST_F(SensingTest, OdometryGoesOnWhereTheBaseWasRestarted) {
  base->next = testing::odometry_at(clock->time, Pose2{2.0, 0.0, 0.0});
  read_after(milliseconds(100));
  sensing.base_restarted();
  base->next = testing::odometry_at(clock->time, Pose2{0.0, 0.0, 0.0});
  read_after(milliseconds(100));
  EXPECT_NEAR(sensing.odom_T_base().x_m, 2.0, 1e-12) << "the base counts from zero again";
  base->next = testing::odometry_at(clock->time, Pose2{0.5, 0.0, 0.0});
  read_after(milliseconds(100));
  EXPECT_NEAR(sensing.odom_T_base().x_m, 2.5, 1e-12);
}

TEST_F(SensingTest, OdometryIsCalibratedForAllButTheOneWhoAsksForItAsMeasured) {
  LoopParams with_calibration = params;
  with_calibration.odometry_calibration = {.left_scale = 1.02, .right_scale = 1.02};
  Sensing calibrated(with_calibration, devices(), world, diagnostics);
  base->next = testing::odometry_at(clock->time, Pose2{1.0, 0.0, 0.0}, {0.2, 0.0});
  calibrated.read();
  base->next = testing::odometry_at(clock->time + milliseconds(100), Pose2{2.0, 0.0, 0.0}, {0.2, 0.0});
  calibrated.read();
  EXPECT_DOUBLE_EQ(calibrated.odom_T_base().x_m, 2.02);
  EXPECT_DOUBLE_EQ(calibrated.velocity().v_m_s, 0.204);
  EXPECT_DOUBLE_EQ(calibrated.history().at(clock->time + milliseconds(100))->odom_T_base.x_m, 2.02);
  ASSERT_NE(calibrated.new_measured_odometry(), nullptr);
  EXPECT_EQ(calibrated.new_measured_odometry()->odom_T_base.x_m, 2.0);
}

TEST_F(SensingTest, CalibratedOdometryGoesOnWhenTheBaseCountsFromZeroAgain) {
  LoopParams with_calibration = params;
  with_calibration.odometry_calibration = {.left_scale = 1.02, .right_scale = 1.02};
  Sensing calibrated(with_calibration, devices(), world, diagnostics);
  base->next = testing::odometry_at(clock->time, Pose2{});
  calibrated.read();
  base->next = testing::odometry_at(clock->time + milliseconds(100), Pose2{1.0, 0.0, 0.0});
  calibrated.read();
  calibrated.base_restarted();
  base->next = testing::odometry_at(clock->time + milliseconds(200), Pose2{});
  calibrated.read();
  EXPECT_DOUBLE_EQ(calibrated.odom_T_base().x_m, 1.02);
  EXPECT_DOUBLE_EQ(calibrated.new_measured_odometry()->odom_T_base.x_m, 1.0);
}

TEST_F(SensingTest, OdometryWithoutCalibrationIsTheVerySame) {
  const drivers::OdometrySample sample = testing::odometry_at(clock->time, Pose2{0.1, 0.2, 0.3}, {0.2, 0.7});
  base->next = sample;
  sensing.read();
  EXPECT_EQ(*sensing.odometry(), sample);
}

}  // namespace
}  // namespace seeker::app
