// A robot file with two laser scanners.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/app/composition/device_factory.hpp"
#include "server/drivers/merged/merged_lidar.hpp"

namespace seeker::app {
namespace {

Result<MadeDevices> devices_of(const std::string& sections) {
  const auto options = parse_robot_options("driver: hardware\nhardware:\n" + sections, "two.yaml");
  EXPECT_TRUE(options) << options.error().message;
  return make_devices(*options);
}

TEST(TwoScanners, AreOneLidarOfTheRobot) {
  const auto made = devices_of("  lidar: {driver: lms200}\n  second_lidar: {driver: rplidar, port: /dev/ttyUSB2}\n");
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_NE(dynamic_cast<drivers::MergedLidar*>(made->devices.lidar.get()), nullptr);
  const auto one = devices_of("  lidar: {driver: lms200}\n");
  ASSERT_TRUE(one) << one.error().message;
  EXPECT_EQ(dynamic_cast<drivers::MergedLidar*>(one->devices.lidar.get()), nullptr);
}

TEST(TwoScanners, AreRefusedWithTheFieldThatIsWrong) {
  const auto alone = devices_of("  second_lidar: {driver: rplidar}\n");
  ASSERT_FALSE(alone);
  EXPECT_THAT(alone.error().message, ::testing::HasSubstr("hardware.second_lidar"));
  const auto port = devices_of("  lidar: {driver: lms200}\n  second_lidar: {driver: rplidar, port: \"tcp://\"}\n");
  ASSERT_FALSE(port);
  EXPECT_THAT(port.error().message, ::testing::HasSubstr("hardware.second_lidar.port"));
}

TEST(OdometryCalibrationSection, IsReadAndRefusedWhereNoBaseIsSo) {
  const auto options = parse_robot_options("odometry_calibration: {left_scale: 1.01, track_m: 0.4}\n", "one.yaml");
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(options->loop.odometry_calibration, (WheelCalibration{.track_m = 0.4, .left_scale = 1.01}));
  const auto wrong = parse_robot_options("odometry_calibration: {left_scale: 0}\n", "one.yaml");
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().message, ::testing::HasSubstr("odometry_calibration"));
}

}  // namespace
}  // namespace seeker::app
