#include "server/fleet/icp.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "tests/support/matchers.hpp"
#include "toy_maps.hpp"

namespace seeker::fleet {
namespace {

using testing::Pose2Near;

TEST(RigidFit, GivesBackTheMotionThatMadeThePairs) {
  Rng rng(1);
  for (int k = 0; k < 50; ++k) {
    const Pose2 truth{rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0), rng.uniform(-kPi, kPi)};
    std::vector<Point2> a;
    std::vector<Point2> b;
    for (int i = 0; i < 7; ++i) {
      b.emplace_back(rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0));
      a.push_back(truth * b.back());
    }
    EXPECT_THAT(rigid_fit(a, b), Pose2Near(truth, 1e-9, 1e-9));
  }
}

TEST(RigidFit, OfASinglePairMovesWithoutRotation) {
  EXPECT_THAT(rigid_fit({{3.0, 1.0}}, {{1.0, 1.0}}), Pose2Near(Pose2{2.0, 0.0, 0.0}, 1e-12, 1e-12));
}

std::vector<slam::OrientedPoint> points_from(const Pose2& world_T_base, std::uint64_t seed) {
  Rng rng(seed);
  return slam::seen_points(scan_from(office(1), world_T_base, rng)).points;
}

TEST(Icp, PutsAScanOnThatOfAnotherRobotThatStoodNearbyAndLookedElsewhere) {
  const Pose2 first{6.0, 6.0, 0.1};
  const slam::ReferenceCloud reference(points_from(first, 1));
  for (const double turn_deg : {0.0, 20.0, -25.0, 50.0}) {
    const Pose2 second{6.3, 6.1, 0.1 + deg_to_rad(turn_deg)};
    const auto found = icp(reference, points_from(second, 2), {});
    ASSERT_TRUE(found) << turn_deg;
    // Points pull towards points along the walls of the corridor: a start for the exact match, no more.
    EXPECT_THAT(found->a_T_b, Pose2Near(inverse(first) * second, 0.3, 0.06)) << turn_deg;
    EXPECT_GT(found->pair_share, 0.5);
  }
}

TEST(Icp, WithoutEnoughPartnersThereIsNothing) {
  const slam::ReferenceCloud reference(points_from({6.0, 6.0, 0.1}, 1));
  EXPECT_FALSE(icp(reference, points_from({6.0, 6.0, 0.1}, 2), {500.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace seeker::fleet
