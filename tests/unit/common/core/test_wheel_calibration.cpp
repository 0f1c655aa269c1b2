#include "common/core/wheel_calibration.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "tests/support/matchers.hpp"

namespace seeker {
namespace {

constexpr WheelCalibration kOff{.track_m = 0.4, .left_scale = 1.02, .right_scale = 0.99, .track_scale = 0.98};

TEST(WheelCalibration, CorrectsEachWheelAndTheTrack) {
  const Twist2 straight = corrected(Twist2{1.0, 0.0}, kOff);
  EXPECT_DOUBLE_EQ(straight.v_m_s, 0.5 * (1.02 + 0.99));
  EXPECT_DOUBLE_EQ(straight.omega_rad_s, (0.99 - 1.02) / (0.4 * 0.98));
  const Twist2 turn = corrected(Twist2{0.0, 1.0}, {.track_m = 0.4, .track_scale = 1.02});
  EXPECT_DOUBLE_EQ(turn.v_m_s, 0.0);
  EXPECT_DOUBLE_EQ(turn.omega_rad_s, 1.0 / 1.02);
}

TEST(WheelCalibration, CorrectsAMotionAsTheVelocityOfItsArc) {
  for (const Twist2& twist : {Twist2{0.5, 0.0}, Twist2{0.5, 0.8}, Twist2{-0.3, 0.5}, Twist2{0.0, -1.0}}) {
    const Pose2 by_motion = corrected(integrate(twist, 0.5), kOff);
    const Pose2 by_velocity = integrate(corrected(twist, kOff), 0.5);
    EXPECT_LT(offset_of(by_motion, by_velocity).norm(), 1e-12);
  }
}

TEST(WheelCalibration, WhatABaseMustBeToldIsTheInverseOfWhatItReports) {
  for (const Twist2& twist : {Twist2{0.5, 0.0}, Twist2{0.5, 0.8}, Twist2{-0.3, 0.5}, Twist2{0.0, -1.0}, Twist2{}}) {
    const Twist2 moves_at = corrected(reported(twist, kOff), kOff);
    EXPECT_NEAR(moves_at.v_m_s, twist.v_m_s, 1e-15);
    EXPECT_NEAR(moves_at.omega_rad_s, twist.omega_rad_s, 1e-15);
  }
}

RC_GTEST_PROP(WheelCalibration, CorrectsNothingWithoutErrors, (std::uint64_t seed)) {
  Rng rng(seed);
  const Pose2 increment{rng.uniform(-1.0, 1.0), rng.uniform(-0.1, 0.1), rng.uniform(-2.0, 2.0)};
  const Pose2 same = corrected(increment, {.track_m = rng.uniform(0.1, 1.0)});
  RC_ASSERT(offset_of(same, increment).norm() < 1e-12);
}

TEST(WheelCalibration, KnowsTheOneThatChangesNothing) {
  EXPECT_TRUE(is_identity({.track_m = 0.5}));
  EXPECT_FALSE(is_identity({.left_scale = 1.0001}));
  EXPECT_FALSE(is_identity({.track_scale = 0.99}));
}

TEST(WheelCalibration, RefusesWhatNoBaseHas) {
  EXPECT_TRUE(validate(kOff));
  EXPECT_FALSE(validate({.track_m = 0.0}));
  EXPECT_FALSE(validate({.left_scale = 0.0}));
  EXPECT_FALSE(validate({.right_scale = std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_FALSE(validate({.track_scale = 2.5}));
}

}  // namespace
}  // namespace seeker
