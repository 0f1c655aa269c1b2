#include "server/drivers/interfaces/odometry_calibrator.hpp"

#include <gtest/gtest.h>

namespace seeker::drivers {
namespace {

OdometrySample sample_at(const Pose2& odom_T_base) {
  OdometrySample sample;
  sample.odom_T_base = odom_T_base;
  sample.velocity = {0.5, 0.1};
  sample.battery_v = 12.5;
  sample.bumped = true;
  return sample;
}

TEST(OdometryCalibrator, LeavesSamplesAsTheyAreWithoutErrors) {
  OdometryCalibrator calibrator;
  for (const Pose2& pose : {Pose2{0.1, 0.2, 0.3}, Pose2{0.7, 1.0 / 3.0, -0.1}}) {
    EXPECT_EQ(calibrator.apply(sample_at(pose)), sample_at(pose));
  }
}

TEST(OdometryCalibrator, AddsUpCorrectedMotionsFromWhereTheOdometryBegan) {
  const WheelCalibration wheels{.left_scale = 1.02, .right_scale = 0.98, .track_scale = 0.97};
  OdometryCalibrator calibrator(wheels);
  Pose2 measured{3.0, -1.0, 0.5};
  Pose2 truly = measured;
  EXPECT_EQ(calibrator.apply(sample_at(measured)).odom_T_base, measured);
  for (int k = 0; k < 50; ++k) {
    const Twist2 twist{0.5, 0.02 * k - 0.5};
    measured = measured * integrate(twist, 0.1);
    truly = truly * integrate(corrected(twist, wheels), 0.1);
    EXPECT_LT(offset_of(calibrator.apply(sample_at(measured)).odom_T_base, truly).norm(), 1e-9);
  }
}

TEST(OdometryCalibrator, CorrectsTheVelocityAndKeepsTheRest) {
  const WheelCalibration wheels{.left_scale = 1.02, .right_scale = 1.02};
  OdometryCalibrator calibrator(wheels);
  const OdometrySample sample = calibrator.apply(sample_at({}));
  EXPECT_DOUBLE_EQ(sample.velocity.v_m_s, 0.51);
  EXPECT_EQ(sample.battery_v, 12.5);
  EXPECT_TRUE(sample.bumped);
}

}  // namespace
}  // namespace seeker::drivers
