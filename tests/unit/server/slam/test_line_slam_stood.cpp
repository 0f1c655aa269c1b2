// Where a robot stood, or is said to stand, in a map that it takes up again.
#include <cmath>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "ring_trip.hpp"
#include "rooms.hpp"
#include "server/slam/line_slam.hpp"

namespace seeker::slam {
namespace {

TEST(LineSlam, GoesOnWhereItStoodInAMapOfItsFirstMetre) {
  Trip trip(15);
  LineSlam mapper({}, trip.truth());
  ASSERT_NO_FATAL_FAILURE(drive(trip, mapper, 1.0));
  LineSlam slam;
  ASSERT_TRUE(slam.load(mapper.map(), MapUse::kContinue));
  EXPECT_EQ(slam.look_where_it_stood({0.0, NAN, 0.0}).error().code, Errc::kInvalidArgument);
  ASSERT_TRUE(slam.look_where_it_stood(mapper.estimate().map_T_base));
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kUnknown) << "no scan has confirmed it yet";
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 0.3));
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 15.0));
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.2);
  EXPECT_TRUE(validate(slam.map()));
}

TEST(LineSlam, IsFoundAtThePlaceThatIsNamedInAMapOfEqualPlaces) {
  Trip trip(15);
  LineSlam slam({}, trip.truth());
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 1.0));
  ASSERT_TRUE(slam.relocalise(std::nullopt));
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 0.3));
  ASSERT_NE(slam.estimate().quality, LocalisationQuality::kLocalised) << "nobody has said where it is";
  ASSERT_TRUE(slam.relocalise(trip.truth()));
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 0.3));
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.1);
}

/// A rotation by 180 degrees shows the same room: only the odometry says on which side the robot is.
TEST(LineSlam, IsFoundWhereTheOdometrySaysOfPlacesThatLookAlike) {
  const std::vector<Wall> room = box(0.0, 0.0, 10.0, 6.0);
  Rng rng(21);
  Pose2 truth{2.5, 1.5, 0.0};
  double time_s = 0.0;
  LineSlam slam({}, truth);
  const auto see = [&](double sigma_m) {
    time_s += 0.1;
    ASSERT_TRUE(slam.predict(truth, robot_time_s(time_s)));
    (void)slam.update(scan_at(room, truth, time_s, rng, kPi, 12.0, sigma_m));
  };
  for (int k = 0; k < 200; ++k) {
    truth = truth * integrate({0.3, 0.2}, 0.1);
    ASSERT_NO_FATAL_FAILURE(see(0.01));
  }
  for (int k = 0; k < 60 && slam.estimate().quality != LocalisationQuality::kUnknown; ++k) {
    ASSERT_NO_FATAL_FAILURE(see(0.3));  // the scanner is faulty
  }
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kUnknown);
  for (int k = 0; k < 60; ++k) {
    ASSERT_NO_FATAL_FAILURE(see(0.01));
  }
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, truth), 0.1);
}

TEST(LineSlam, IsFoundElsewhereWhenItDoesNotStandWhereItStood) {
  Trip first(9);
  LineSlam mapper({}, first.truth());
  ASSERT_NO_FATAL_FAILURE(drive(first, mapper, 60.0));
  Trip second(10, {15.0, 3.0, 1.4});
  LineSlam slam;
  ASSERT_TRUE(slam.load(mapper.map(), MapUse::kContinue));
  ASSERT_TRUE(slam.look_where_it_stood(mapper.estimate().map_T_base));
  for (int metre = 0; metre < 10 && slam.estimate().quality == LocalisationQuality::kUnknown; ++metre) {
    ASSERT_NO_FATAL_FAILURE(drive(second, slam, 1.0));
  }
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, second.truth()), 0.3);
}

TEST(LineSlam, FindsItselfByARotationOnTheSpotWhereItWentOnAndFacesAway) {
  Trip first(15);
  LineSlam mapper({}, first.truth());
  ASSERT_NO_FATAL_FAILURE(drive(first, mapper, 12.5));
  const Pose2 kept = mapper.estimate().map_T_base;
  Trip trip(16, first.truth() * Pose2{1.1, 0.1, 2.6});
  LineSlam slam;
  ASSERT_TRUE(slam.load(mapper.map(), MapUse::kContinue));
  ASSERT_TRUE(slam.look_where_it_stood(kept));
  constexpr double kTurn_rad_s = 0.4;
  for (double turned_rad = 0.0; turned_rad < kTwoPi; turned_rad += kTurn_rad_s * Trip::kTick_s) {
    ASSERT_TRUE(trip.feed(slam));
    trip.move({0.0, 0.0, kTurn_rad_s * Trip::kTick_s});
  }
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.2);
}

}  // namespace
}  // namespace seeker::slam
