#include "server/drivers/sim/sim_devices.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::drivers {
namespace {

using namespace std::chrono_literals;

SimDevices make_devices(double speed = 0.0) {
  auto devices = make_sim_devices(sim::testing::square_room(6.0), sim::without_errors(sim::RobotModel{}), 1, speed);
  EXPECT_TRUE(devices);
  EXPECT_TRUE(devices->base->activate());
  EXPECT_TRUE(devices->lidar->activate());
  EXPECT_TRUE(devices->sonar->activate());
  EXPECT_TRUE(devices->camera->activate());
  return std::move(*devices);
}

TEST(SimBase, DrivesOnlyWithItsMotorsOn) {
  SimDevices d = make_devices();
  EXPECT_EQ(d.base->set_velocity({0.2, 0.0}, d.clock->now()).error().code, Errc::kRefused);
  EXPECT_TRUE(d.base->set_velocity({}, d.clock->now()));
  ASSERT_TRUE(d.base->set_motors(true));
  ASSERT_TRUE(d.base->set_velocity({0.2, 0.0}, d.clock->now()));
  ASSERT_TRUE(d.clock->advance(400ms));
  EXPECT_GT(d.simulation->truth().path_length_m, 0.01);
  ASSERT_TRUE(d.base->set_motors(false));
  ASSERT_TRUE(d.clock->advance(1s));
  EXPECT_EQ(d.simulation->truth().velocity, Twist2{});
}

TEST(SimBase, HaltsWhenCommandsStopComing) {
  SimDevices d = make_devices();
  ASSERT_TRUE(d.base->set_motors(true));
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(d.base->set_velocity({0.3, 0.0}, d.clock->now()));
    ASSERT_TRUE(d.clock->advance(100ms));
  }
  EXPECT_NEAR(d.simulation->truth().velocity.v_m_s, 0.3, 1e-9);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(d.clock->advance(100ms));
  }
  EXPECT_NEAR(d.simulation->truth().velocity.v_m_s, 0.3, 1e-9);  // 500 ms after the last command
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(d.clock->advance(100ms));
  }
  EXPECT_EQ(d.simulation->truth().velocity, Twist2{});
}

TEST(SimBase, OdometryStartsAtActivation) {
  SimDevices d = make_devices();
  ASSERT_TRUE(d.base->set_motors(true));
  ASSERT_TRUE(d.base->set_velocity({0.3, 0.2}, d.clock->now()));
  ASSERT_TRUE(d.clock->advance(500ms));
  d.base->deactivate();
  EXPECT_EQ(d.base->read().error().code, Errc::kNotReady);
  ASSERT_TRUE(d.clock->advance(1s));
  ASSERT_TRUE(d.base->activate());
  const auto sample = d.base->read();
  ASSERT_TRUE(sample && *sample);
  EXPECT_NEAR((*sample)->odom_T_base.x_m, 0.0, 1e-12);
  EXPECT_FALSE((*sample)->motors_enabled);
}

TEST(SimDevices, GiveOneSampleAPeriod) {
  SimDevices d = make_devices();
  EXPECT_TRUE(d.lidar->read()->has_value());
  EXPECT_FALSE(d.lidar->read()->has_value());
  ASSERT_TRUE(d.clock->advance(50ms));
  EXPECT_FALSE(d.lidar->read()->has_value());
  ASSERT_TRUE(d.clock->advance(50ms));
  const auto scan = d.lidar->read();
  ASSERT_TRUE(scan->has_value());
  EXPECT_EQ((*scan)->stamp, d.clock->now());
  EXPECT_TRUE(d.sonar->read()->has_value());
  EXPECT_TRUE(d.base->read()->has_value());
}

TEST(SimFaults, SilenceNanAndADeadCameraCanBeSwitched) {
  SimDevices d = make_devices();
  d.faults->sonar_nan = 3;
  const auto scan = d.sonar->read();
  ASSERT_TRUE(scan->has_value());
  EXPECT_TRUE(std::isnan((*scan)->readings[3].range_m));
  EXPECT_FALSE(validate(**scan));
  d.faults->sonar_silent = d.faults->lidar_silent = d.faults->base_silent = true;
  ASSERT_TRUE(d.clock->advance(1s));
  EXPECT_FALSE(d.sonar->read()->has_value());
  EXPECT_FALSE(d.lidar->read()->has_value());
  EXPECT_FALSE(d.base->read()->has_value());
  EXPECT_TRUE(d.camera->grab());
  d.faults->camera_dead = true;
  EXPECT_EQ(d.camera->grab().error().code, Errc::kIo);
  EXPECT_FALSE(d.camera->activate());
  d.faults->camera_dead = false;
  EXPECT_TRUE(d.camera->activate());
  EXPECT_TRUE(d.camera->grab());
}

TEST(SimStereo, GivesPicturesOfItsGeometryOnlyWhileActive) {
  SimDevices d = make_devices();
  EXPECT_EQ(d.stereo->grab().error().code, Errc::kNotReady);
  ASSERT_TRUE(d.stereo->activate());
  ASSERT_TRUE(d.clock->advance(300ms));
  const auto frame = d.stereo->grab();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp, d.clock->now());
  for (const Image* image : {&frame->left, &frame->right}) {
    EXPECT_EQ(image->width_px(), d.stereo->geometry().width_px);
    EXPECT_EQ(image->height_px(), d.stereo->geometry().height_px);
  }
  d.faults->stereo_dead = true;
  EXPECT_EQ(d.stereo->grab().error().code, Errc::kIo);
  EXPECT_FALSE(d.stereo->activate());
}

TEST(SimStereo, FaultsSpoilThePictures) {
  SimDevices d = make_devices();
  ASSERT_TRUE(d.stereo->activate());
  const StereoFrame good = *d.stereo->grab();
  const auto spoilt = [&d](StereoFault fault) {
    d.faults->stereo = fault;
    return *d.stereo->grab();
  };
  const auto mean_step = [](const Image& image) {
    double sum = 0.0;
    for (std::size_t i = 1; i < image.data().size(); ++i) {
      sum += std::abs(image.data()[i] - image.data()[i - 1]);
    }
    return sum / static_cast<double>(image.data().size());
  };
  EXPECT_EQ(spoilt(StereoFault::kStale).right, good.right);
  const StereoFrame black = spoilt(StereoFault::kBlack);
  EXPECT_TRUE(std::all_of(black.left.data().begin(), black.left.data().end(), [](auto v) { return v == 0; }));
  const StereoFrame white = spoilt(StereoFault::kSaturated);
  EXPECT_TRUE(std::all_of(white.right.data().begin(), white.right.data().end(), [](auto v) { return v == 255; }));
  EXPECT_EQ(spoilt(StereoFault::kHalfSize).left.width_px(), d.stereo->geometry().width_px / 2);
  EXPECT_LT(mean_step(spoilt(StereoFault::kBlurred).left), 0.3 * mean_step(good.left));
}

TEST(LockstepClock, PacesByTheWallOnlyWhenAsked) {
  SimDevices fast = make_devices(0.0);
  EXPECT_TRUE(fast.clock->lockstep());
  SimDevices paced = make_devices(20.0);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(paced.clock->advance(100ms));
    ASSERT_EQ(paced.clock->await(1h), Result<bool>(true));
  }
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 45ms);  // 1 s of robot time at 20x
  EXPECT_EQ(paced.clock->now(), robot_time_s(1.0));
  EXPECT_FALSE(paced.clock->advance(0ms));
  EXPECT_FALSE(make_sim_devices(sim::testing::square_room(4.0), {}, 1, -1.0));
}

}  // namespace
}  // namespace seeker::drivers
