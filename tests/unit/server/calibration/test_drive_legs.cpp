#include "server/calibration/drive_legs.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::calibration {
namespace {

const DriveCalibration kRobot{{0.357, 1.02, 0.99, 0.98}, {0.15, -0.05, deg_to_rad(12.0)}};

/// Knows the truth, and keeps what it was told.
class Oracle final : public slam::PoseTracker {
 public:
  Status predict(const Pose2& odom_T_base, RobotTime /*stamp*/) override {
    told = odom_T_base;
    return {};
  }
  Status update(const LaserScan& scan) override {
    mount = scan.base_T_laser;
    return refuses ? Status(fail(Errc::kNotReady, "blind")) : Status{};
  }
  [[nodiscard]] PoseEstimate estimate() const override { return truth; }
  void reset(const Pose2& /*map_T_base*/) override {}

  PoseEstimate truth;
  Pose2 told;
  Pose2 mount;
  bool refuses = false;
};

/// Drives an Oracle, ten readings a second.
class Drive {
 public:
  explicit Drive(const DriveCalibration& predicted) : legs(oracle, {}, predicted) {
    oracle.truth.quality = LocalisationQuality::kLocalised;
    read();
  }
  void go(const Twist2& reported, int ticks) {
    for (int k = 0; k < ticks; ++k) {
      const Pose2 increment = integrate(reported, 0.1);
      odom_T_base = odom_T_base * increment;
      oracle.truth.map_T_base = oracle.truth.map_T_base * corrected(increment, kRobot.wheels);
      now += std::chrono::milliseconds(100);
      read();
    }
  }

  Oracle oracle;
  DriveLegs legs;
  Pose2 odom_T_base;
  RobotTime now;

 private:
  void read() {
    legs.add(odom_T_base, now);
    legs.add(LaserScan{});
  }
};

TEST(DriveLegs, HoldTheMotionOfTheWheelsAsReportedAndThatOfTheLaserAsSeen) {
  Drive drive({WheelCalibration{}, kRobot.base_T_laser});
  drive.go({0.5, 0.05}, 40);
  ASSERT_EQ(drive.legs.legs().size(), 3U);
  for (const DriveLeg& leg : drive.legs.legs()) {
    Pose2 reported;
    Pose2 truly;
    for (const Pose2& increment : leg.increments) {
      reported = reported * increment;
      truly = truly * corrected(increment, kRobot.wheels);
    }
    EXPECT_LT(offset_of(reported, integrate({0.5, 0.05}, 0.1 * static_cast<double>(leg.increments.size()))).norm(),
              1e-9);
    const Pose2 of_laser = inverse(kRobot.base_T_laser) * truly * kRobot.base_T_laser;
    EXPECT_LT(offset_of(leg.from_T_to.a_T_b, of_laser).norm(), 1e-9);
  }
}

TEST(DriveLegs, TellTheTrackerTheCorrectedOdometryAndThePredictedMount) {
  Drive drive(kRobot);
  drive.go({0.5, 0.05}, 40);
  EXPECT_LT(offset_of(drive.oracle.told, drive.oracle.truth.map_T_base).norm(), 1e-9);
  EXPECT_EQ(drive.oracle.mount, kRobot.base_T_laser);
}

TEST(DriveLegs, EndOnlyWhereTheRobotHardlyRotates) {
  Drive drive(kRobot);
  drive.go({0.3, 0.5}, 60);
  EXPECT_TRUE(drive.legs.legs().empty());
  drive.go({0.1, 0.0}, 1);
  ASSERT_EQ(drive.legs.legs().size(), 1U);
  EXPECT_EQ(drive.legs.legs().front().increments.size(), 61U);
}

TEST(DriveLegs, EndAllTheSameWhereTheRobotNeverStopsRotating) {
  Drive drive(kRobot);
  drive.go({0.0, 0.5}, 600);
  EXPECT_EQ(drive.legs.legs().size(), 2U);
  drive.go({0.5, 0.2}, 300);
  EXPECT_EQ(drive.legs.legs().size(), 3U);
}

TEST(DriveLegs, LeaveOutWhatALostTrackerOrAnotherMapMakesOfIt) {
  Drive drive(kRobot);
  drive.oracle.truth.quality = LocalisationQuality::kLost;
  drive.go({0.5, 0.0}, 11);
  drive.oracle.truth.quality = LocalisationQuality::kLocalised;
  drive.go({0.5, 0.0}, 11);
  EXPECT_EQ(drive.legs.unmatched(), 2U);
  ++drive.oracle.truth.map_epoch;
  drive.go({0.5, 0.0}, 11);
  EXPECT_EQ(drive.legs.unmatched(), 3U);
  EXPECT_TRUE(drive.legs.legs().empty());
  drive.go({0.5, 0.0}, 11);
  EXPECT_EQ(drive.legs.legs().size(), 1U);
}

TEST(DriveLegs, DoNotEndAtAScanThatTheTrackerRefuses) {
  Drive drive(kRobot);
  drive.oracle.refuses = true;
  drive.go({0.5, 0.0}, 15);
  EXPECT_TRUE(drive.legs.legs().empty());
  drive.oracle.refuses = false;
  drive.go({0.5, 0.0}, 1);
  ASSERT_EQ(drive.legs.legs().size(), 1U);
  EXPECT_EQ(drive.legs.legs().front().increments.size(), 16U);
}

}  // namespace
}  // namespace seeker::calibration
