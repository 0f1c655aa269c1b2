#include "server/nav/clearance.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"

namespace seeker::nav {
namespace {

/// Smallest distance between the base's centre and a point while it follows `twist` for `arc_s` and then brakes,
/// straight on, beginning `params.reaction_s` later.
double nearest_m(const Twist2& twist, double arc_s, const std::vector<Point2>& points, const ClearanceParams& params) {
  const Pose2 end = integrate(twist, arc_s);
  const double v = std::abs(twist.v_m_s);
  const double roll_m = v * params.reaction_s + v * v / (2.0 * params.decel_m_s2);
  double nearest = 1e9;
  for (double s = 0.0; s <= roll_m; s += 0.005) {
    const Point2 at = end * Point2(std::copysign(s, twist.v_m_s), 0.0);
    for (const Point2& p : points) {
      nearest = std::min(nearest, (p - at).norm());
    }
  }
  return nearest;
}

TEST(SuddenStop, FreeFloorAndRotationOnTheSpotAreLeftAlone) {
  const Twist2 arc{0.5, 1.0};
  EXPECT_EQ(limit_for_sudden_stop(arc, {}, {{3.0, 0.0}}, {}), arc);
  const Twist2 turn{0.0, 1.0};
  EXPECT_EQ(limit_for_sudden_stop(turn, {}, {{0.27, 0.0}}, {}), turn);
}

TEST(SuddenStop, WithNoRoomStraightAheadItOnlyTurns) {
  EXPECT_EQ(limit_for_sudden_stop({0.2, 1.0}, {}, {{0.27, 0.0}}, {}), (Twist2{0.0, 1.0}));
}

TEST(SuddenStop, APostThatTheTurnWillBringAheadCounts) {
  // 0.45 m away and 60 degrees to the left: straight on it is passed, after a third of the turn it is ahead.
  const std::vector<Point2> post{{0.45 * std::cos(1.05), 0.45 * std::sin(1.05)}};
  EXPECT_LT(limit_for_sudden_stop({0.5, 1.2}, {}, post, {}).v_m_s, 0.5);
  EXPECT_EQ(limit_for_sudden_stop({0.5, -1.2}, {}, post, {}), (Twist2{0.5, -1.2}));
  EXPECT_LT(limit_for_sudden_stop({0.5, -1.2}, {0.5, 1.2}, post, {}).v_m_s, 0.5) << "it still turns to the left";
}

RC_GTEST_PROP(SuddenStop, ACommandThatEndsAtOnceEndsWithoutContact, (std::uint32_t seed)) {
  Rng rng(seed);
  const ClearanceParams params;
  const Twist2 wanted{rng.uniform(-0.5, 0.5), rng.uniform(-1.2, 1.2)};
  std::vector<Point2> points;
  for (int k = 0; k < 5; ++k) {
    const Point2 p(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0));
    if (p.norm() > params.radius_m + params.slow_margin_m) {
      points.push_back(p);
    }
  }
  const Twist2 allowed = limit_for_sudden_stop(wanted, wanted, points, params);
  RC_ASSERT(std::abs(allowed.v_m_s) <= std::abs(wanted.v_m_s));
  if (std::abs(allowed.v_m_s) > 0.0) {
    RC_ASSERT(nearest_m(allowed, 0.0, points, params) >= params.radius_m);
  }
}

}  // namespace
}  // namespace seeker::nav
