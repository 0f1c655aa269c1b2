#include "server/slam/unseen_motion.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "ring_trip.hpp"
#include "rooms.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::slam {
namespace {

using testing::Pose2Near;

TEST(UnseenMotion, ExpectsTheLastMotionOnceMore) {
  UnseenMotion unseen;
  EXPECT_FALSE(unseen.on());
  EXPECT_FALSE(unseen.trusted()) << "wheels that have not reported any motion yet";
  unseen.note({0.1, 0.01, -0.05}, 0.2);
  ASSERT_TRUE(unseen.on());
  const UncertainPose next = unseen.expected(0.4);
  EXPECT_THAT(next.a_T_b, Pose2Near(Pose2{0.2, 0.02, -0.1}, 1e-9, 1e-9));
  const UnseenMotionParams params;
  EXPECT_NEAR(next.covariance(0, 0), std::pow(params.speed_sigma_mps * 0.4, 2), 1e-9);
  EXPECT_NEAR(next.covariance(2, 2), std::pow(params.rotation_sigma_radps * 0.4, 2), 1e-9);
  EXPECT_FALSE(unseen.trusted());
  unseen.note_wheels();
  EXPECT_FALSE(unseen.on());
  EXPECT_TRUE(unseen.trusted());
  EXPECT_THAT(unseen.expected(1.0).a_T_b, Pose2Near(Pose2{}, 1e-12, 1e-12));
}

TEST(UnseenMotion, KnowsWhatNobodyCanDo) {
  const UnseenMotion unseen;
  EXPECT_FALSE(unseen.is_too_fast({0.3, 0.0, 0.4}, 0.2));
  EXPECT_TRUE(unseen.is_too_fast({0.5, 0.0, 0.0}, 0.2));
  EXPECT_TRUE(unseen.is_too_fast({0.0, 0.0, 1.5}, 0.2)) << "a square room is the same after a rotation by 90 degrees";
}

TEST(LineSlamWithoutWheels, FollowsALaserThatIsCarriedRoundARing) {
  for (const std::uint64_t seed : {21U, 22U, 23U}) {
    Trip trip(seed);
    LineSlam slam({}, trip.truth());
    double worst_m = 0.0;
    while (trip.path_m() < 40.0) {
      ASSERT_TRUE(slam.predict({}, trip.time()));
      ASSERT_TRUE(slam.update(trip.scan()));
      worst_m = std::max(worst_m, distance_m(slam.estimate().map_T_base, trip.truth()));
      trip.step();
    }
    EXPECT_LT(worst_m, 0.3) << "seed " << seed;
    EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  }
}

/// A robot in a furnished room, ten scans a second.
struct Room {
  void look(const Pose2& odom_T_base) {
    ASSERT_TRUE(slam.predict(odom_T_base, robot_time_s(time_s)));
    ASSERT_TRUE(slam.update(scan_at(furnished_room(), truth, time_s, rng)));
    time_s += 0.1;
  }
  [[nodiscard]] double off_m() const { return distance_m(slam.estimate().map_T_base, truth); }

  Rng rng{24};
  Pose2 truth{2.0, 2.5, 0.0};
  LineSlam slam{{}, truth};
  double time_s = 0.0;
};

TEST(LineSlamWithoutWheels, ARobotThatIsPushedAndRotatedIsFollowedAndItsWheelsAreBelievedAgain) {
  Room room;
  Pose2 wheels;
  for (int k = 0; k < 10; ++k) {
    room.truth = room.truth * Pose2{0.05, 0.0, 0.0};
    wheels = wheels * Pose2{0.05, 0.0, 0.0};
    ASSERT_NO_FATAL_FAILURE(room.look(wheels));
  }
  for (int k = 0; k < 10; ++k) {  // pushed for a metre, turning as fast as a person does it
    room.truth = room.truth * Pose2{0.08, 0.02, 0.12};
    ASSERT_NO_FATAL_FAILURE(room.look(wheels));
    EXPECT_EQ(room.slam.estimate().quality, LocalisationQuality::kLocalised) << k << room.slam.estimate().cause;
  }
  EXPECT_LT(room.off_m(), 0.08);
  EXPECT_NEAR(room.slam.estimate().map_T_base.theta_rad, room.truth.theta_rad, 0.03);
  for (int k = 0; k < 10; ++k) {
    room.truth = room.truth * Pose2{0.0, 0.0, 0.05};
    wheels = wheels * Pose2{0.0, 0.0, 0.05};
    ASSERT_NO_FATAL_FAILURE(room.look(wheels));
  }
  EXPECT_LT(room.off_m(), 0.08);
}

TEST(LineSlamWithoutWheels, ALaserThatIsCarriedSlowlyIsNotTakenForOneThatStands) {
  Room room;
  for (int k = 0; k < 60; ++k) {  // 2 cm a scan: too little for one scan to show
    ASSERT_NO_FATAL_FAILURE(room.look({}));
    room.truth = room.truth * Pose2{0.02, 0.0, 0.0};
  }
  ASSERT_NO_FATAL_FAILURE(room.look({}));
  EXPECT_LT(room.off_m(), 0.06);
}

}  // namespace
}  // namespace seeker::slam
