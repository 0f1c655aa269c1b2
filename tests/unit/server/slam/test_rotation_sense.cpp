#include "server/slam/rotation_sense.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

constexpr double kTurn_rad = 0.1;

RotationSense after(int rotations, double share) {
  RotationSense sense;
  for (int k = 0; k < rotations; ++k) {
    const double by_wheels_rad = k % 3 == 0 ? -kTurn_rad : kTurn_rad;
    sense.note(by_wheels_rad, share * by_wheels_rad);
  }
  return sense;
}

TEST(RotationSense, SaysNothingBeforeTheRobotHasRotatedEnough) {
  EXPECT_FALSE(after(39, -1.0).reversed());
  EXPECT_TRUE(after(41, -1.0).reversed());
}

TEST(RotationSense, WheelsThatSlipOrErrAreNotReversed) {
  for (const double share : {1.0, 0.7, 1.3, 0.0, -0.3}) {
    EXPECT_FALSE(after(400, share).reversed()) << share;
  }
}

TEST(RotationSense, NoiseAndRotationsTooLargeForAMatchDoNotCount) {
  RotationSense sense;
  for (int k = 0; k < 1000; ++k) {
    sense.note(0.005, -0.005);
    sense.note(0.5, -0.5);
  }
  EXPECT_FALSE(sense.reversed());
}

TEST(RotationSense, WhatWasLongAgoIsForgotten) {
  RotationSense sense = after(200, 1.0);
  for (int k = 0; k < 200; ++k) {
    sense.note(kTurn_rad, -kTurn_rad);
  }
  EXPECT_TRUE(sense.reversed());
  sense.clear();
  EXPECT_FALSE(sense.reversed());
}

}  // namespace
}  // namespace seeker::slam
