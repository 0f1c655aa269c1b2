#include "common/core/pose2.hpp"

#include <functional>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "tests/support/matchers.hpp"

namespace seeker {
namespace {

using testing::Point2Near;
using testing::Pose2Near;

/// A pose from three raw integers: rapidcheck's doubles are mostly denormal, which proves nothing here.
Pose2 pose_from(int x, int y, int theta) {
  constexpr int kRange = 10000;
  return {(x % kRange) / 100.0, (y % kRange) / 100.0, wrap_angle((theta % kRange) / 1000.0)};
}

Eigen::Vector3d as_vector(const Pose2& p) { return {p.x_m, p.y_m, p.theta_rad}; }

Matrix3 numeric_jacobian(const std::function<Pose2(const Pose2&)>& f, const Pose2& at) {
  constexpr double kStep = 1e-6;
  Matrix3 jacobian;
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d delta = Eigen::Vector3d::Zero();
    delta[k] = kStep;
    const Pose2 plus{at.x_m + delta[0], at.y_m + delta[1], at.theta_rad + delta[2]};
    const Pose2 minus{at.x_m - delta[0], at.y_m - delta[1], at.theta_rad - delta[2]};
    Eigen::Vector3d difference = as_vector(f(plus)) - as_vector(f(minus));
    difference[2] = wrap_angle(difference[2]);
    jacobian.col(k) = difference / (2.0 * kStep);
  }
  return jacobian;
}

TEST(Angle, WrapMapsToHalfOpenInterval) {
  EXPECT_DOUBLE_EQ(wrap_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(3.0 * kPi + 0.1), -kPi + 0.1, 1e-12);
}

TEST(Pose2, ComposeTurnsThenMoves) {
  const Pose2 map_T_base{1.0, 2.0, kPi / 2.0};
  EXPECT_THAT(map_T_base * (Pose2{3.0, 0.0, kPi}), Pose2Near(Pose2{1.0, 5.0, -kPi / 2.0}, 1e-12, 1e-12));
  EXPECT_THAT(map_T_base * Point2(0.0, 1.0), Point2Near(Point2(0.0, 2.0), 1e-12));
}

TEST(Pose2, IntegrateQuarterCircle) {
  EXPECT_THAT(integrate(Twist2{kPi / 2.0, kPi / 2.0}, 1.0), Pose2Near(Pose2{1.0, 1.0, kPi / 2.0}, 1e-12, 1e-12));
  EXPECT_THAT(integrate(Twist2{0.5, 0.0}, 2.0), Pose2Near(Pose2{1.0, 0.0, 0.0}, 1e-12, 1e-12));
}

TEST(Pose2, BearingIsPositiveToTheLeft) {
  EXPECT_NEAR(bearing_to(Pose2{0, 0, 0}, Point2(0.0, 1.0)), kPi / 2.0, 1e-12);
  EXPECT_NEAR(bearing_to(Pose2{0, 0, kPi / 2.0}, Point2(1.0, 0.0)), -kPi / 2.0, 1e-12);
}

RC_GTEST_PROP(Pose2, InverseUndoesCompose, (int ax, int ay, int at, int bx, int by, int bt)) {
  const Pose2 a = pose_from(ax, ay, at);
  const Pose2 b = pose_from(bx, by, bt);
  const Pose2 back = inverse(a) * (a * b);
  RC_ASSERT(distance_m(back, b) < 1e-9);
  RC_ASSERT(std::abs(wrap_angle(back.theta_rad - b.theta_rad)) < 1e-9);
}

RC_GTEST_PROP(Pose2, JacobiansMatchCentralDifferences, (int ax, int ay, int at, int bx, int by, int bt)) {
  const Pose2 a = pose_from(ax, ay, at);
  const Pose2 b = pose_from(bx, by, bt);
  constexpr double kTolerance = 1e-6;
  RC_ASSERT((compose_jacobian_a(a, b) - numeric_jacobian([&](const Pose2& p) { return p * b; }, a)).norm() <
            kTolerance);
  RC_ASSERT((compose_jacobian_b(a, b) - numeric_jacobian([&](const Pose2& p) { return a * p; }, b)).norm() <
            kTolerance);
  RC_ASSERT((inverse_jacobian(a) - numeric_jacobian([](const Pose2& p) { return inverse(p); }, a)).norm() < kTolerance);
}

TEST(TwistBetween, LeadsFromOnePoseToTheOther) {
  const Pose2 from{1.0, -2.0, 0.4};
  for (const Twist2& velocity : {Twist2{0.3, 0.0}, Twist2{0.3, 0.8}, Twist2{-0.2, 0.5}, Twist2{0.0, -1.0}}) {
    const double tau_s = 0.5;
    const double turn = velocity.omega_rad_s * tau_s;
    const double way = velocity.v_m_s * tau_s;
    const Point2 chord =
        turn != 0.0 ? Point2(way / turn * std::sin(turn), way / turn * (1.0 - std::cos(turn))) : Point2(way, 0.0);
    const Twist2 found = twist_between(from, from * Pose2{chord.x(), chord.y(), turn}, tau_s);
    EXPECT_NEAR(found.v_m_s, velocity.v_m_s, 1e-9);
    EXPECT_NEAR(found.omega_rad_s, velocity.omega_rad_s, 1e-9);
  }
}

}  // namespace
}  // namespace seeker
