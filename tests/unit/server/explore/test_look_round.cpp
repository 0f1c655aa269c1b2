#include "server/explore/look_round.hpp"

#include <gtest/gtest.h>

namespace seeker::explore {
namespace {

OneStepParams looking() {
  OneStepParams params;
  params.look_round_m = 0.01;
  return params;
}

/// Of a robot whose position is known to `sigma_m` along x and to a millimetre along y.
Matrix3 known_to(double sigma_m) { return Eigen::Vector3d(sigma_m * sigma_m, 1e-6, 1e-6).asDiagonal(); }

/// The angle that the robot turns by until no part of a turn is due any more.
double turned_rad(LookRound& look, const OneStepParams& params, double sigma_m) {
  double turned_rad = 0.0;
  for (int k = 0; k < 100; ++k) {
    const std::optional<Twist2> part = look.next(known_to(sigma_m));
    if (!part) {
      return turned_rad;
    }
    EXPECT_EQ(part->v_m_s, 0.0);
    turned_rad += part->omega_rad_s * params.observation_period_s;
  }
  ADD_FAILURE() << "it turns for ever";
  return turned_rad;
}

TEST(LookRound, TurnsRoundOnceWherePositionHasBecomeLessCertain) {
  LookRound look(looking());
  EXPECT_EQ(turned_rad(look, looking(), 0.009), 0.0);
  const double turn_rad = turned_rad(look, looking(), 0.011);
  EXPECT_GE(turn_rad, 2.0 * kPi);
  EXPECT_LT(turn_rad, 2.0 * kPi + 0.17 * looking().observation_period_s) << "and hardly farther";
  EXPECT_EQ(turned_rad(look, looking(), 0.0145), 0.0) << "its variance has grown by less than 1 cm squared";
  EXPECT_GT(turned_rad(look, looking(), 0.016), 0.0);
}

TEST(LookRound, CountsFromTheBestThatWasKnownSince) {
  LookRound look(looking());
  EXPECT_GT(turned_rad(look, looking(), 0.03), 0.0);
  EXPECT_EQ(turned_rad(look, looking(), 0.002), 0.0);
  EXPECT_GT(turned_rad(look, looking(), 0.012), 0.0);
}

TEST(LookRound, ATurnThatIsCutOffBeginsAnew) {
  LookRound look(looking());
  ASSERT_TRUE(look.next(known_to(0.02)));
  look.cancel();
  EXPECT_TRUE(look.next(known_to(0.02)));
}

TEST(LookRound, TurnsTheWayThatTheRobotCan) {
  OneStepParams right = looking();
  right.omega_rad_s = {-0.3, 0.0, 0.1};
  LookRound look(right);
  EXPECT_LE(turned_rad(look, right, 0.02), -2.0 * kPi);
  OneStepParams straight = looking();
  straight.omega_rad_s = {0.0};
  LookRound never(straight);
  EXPECT_FALSE(never.next(known_to(1.0)));
}

TEST(LookRound, NeverTurnsUnlessItIsAskedTo) {
  LookRound look({});
  EXPECT_EQ(turned_rad(look, {}, 5.0), 0.0);
}

}  // namespace
}  // namespace seeker::explore
