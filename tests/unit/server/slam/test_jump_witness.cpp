#include "server/slam/jump_witness.hpp"

#include <gtest/gtest.h>

namespace seeker::slam {
namespace {

const Pose2 kJump{2.0, -1.0, 0.9};  ///< found * inverse(predicted)

/// Where odometry has the robot after `k` steps along a curve.
Pose2 predicted(int k) { return integrate({0.3, 0.2}, static_cast<double>(k)); }

TEST(JumpWitness, ConfirmsWhatThreeScansInARowSay) {
  JumpWitness witness;
  EXPECT_FALSE(witness.confirms(kJump * predicted(1), predicted(1)));
  EXPECT_FALSE(witness.confirms(kJump * predicted(2), predicted(2)));
  EXPECT_TRUE(witness.confirms(kJump * predicted(3), predicted(3)));
}

TEST(JumpWitness, BeginsAgainWhenAScanDisagrees) {
  JumpWitness witness;
  const Pose2 other{-1.0, 2.0, -1.3};
  EXPECT_FALSE(witness.confirms(kJump * predicted(1), predicted(1)));
  EXPECT_FALSE(witness.confirms(kJump * predicted(2), predicted(2)));
  EXPECT_FALSE(witness.confirms(other * predicted(3), predicted(3)));
  EXPECT_FALSE(witness.confirms(kJump * predicted(4), predicted(4)));
}

TEST(JumpWitness, BeginsAgainAfterAScanThatSaidNothingOfIt) {
  JumpWitness witness;
  EXPECT_FALSE(witness.confirms(kJump * predicted(1), predicted(1)));
  EXPECT_FALSE(witness.confirms(kJump * predicted(2), predicted(2)));
  witness.clear();
  EXPECT_FALSE(witness.confirms(kJump * predicted(3), predicted(3)));
}

}  // namespace
}  // namespace seeker::slam
