#include "server/app/safety/safety_supervisor.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace seeker::app {
namespace {

constexpr Twist2 kForward{0.4, 0.0};

LaserScan wall_ahead(double range_m) {
  LaserScan scan;
  scan.angle_min_rad = -0.5;
  scan.angle_step_rad = 0.01;
  scan.range_max_m = 8.0;
  for (int i = 0; i <= 100; ++i) {
    scan.ranges_m.push_back(static_cast<float>(range_m / std::cos(scan.angle_rad(static_cast<std::size_t>(i)))));
  }
  return scan;
}

SonarScan echo_ahead(float range_m) {
  SonarScan sonar;
  sonar.range_max_m = 5.0;
  sonar.cone_half_angle_rad = 0.26;
  sonar.readings = {{Pose2{0.15, 0.0, 0.0}, range_m}};
  return sonar;
}

TEST(SafetySupervisor, FreeWayIsLeftAlone) {
  const LaserScan scan = wall_ahead(6.0);
  const SafetyVerdict verdict = supervise({.wanted = kForward, .armed = true, .scan = &scan}, {});
  EXPECT_EQ(verdict.allowed, kForward);
  EXPECT_TRUE(verdict.reason.empty());
}

TEST(SafetySupervisor, WallAheadStopsTheRobotButLetsItTurn) {
  const LaserScan scan = wall_ahead(0.27);
  const SafetyVerdict verdict = supervise({.wanted = kForward, .armed = true, .scan = &scan}, {});
  EXPECT_DOUBLE_EQ(verdict.allowed.v_m_s, 0.0);
  EXPECT_FALSE(verdict.reason.empty());
  const Twist2 turn{0.0, 0.5};
  EXPECT_EQ(supervise({.wanted = turn, .armed = true, .scan = &scan}, {}).allowed, turn);
}

TEST(SafetySupervisor, AClientsCommandMayEndInTheMiddleOfTheArcThatPassesTheWall) {
  // The arc clears a post half a metre ahead; a robot whose command ends rolls straight into it at full speed.
  LaserScan scan;
  scan.angle_step_rad = 0.01;
  scan.range_max_m = 8.0;
  scan.ranges_m = {0.5F};
  SafetyInput input{.wanted = {0.4, 1.2}, .armed = true, .scan = &scan};
  EXPECT_EQ(supervise(input, {}).allowed, input.wanted) << "a mission of the robot's own drives the arc to its end";
  input.may_be_cut = true;
  const Twist2 allowed = supervise(input, {}).allowed;
  EXPECT_GT(allowed.v_m_s, 0.1);
  // 0.24 m are free: 0.2 s of reaction, braking at 0.3 m/s^2 and 3 cm of margin fit into it at 0.3 m/s.
  EXPECT_LE(allowed.v_m_s, 0.3);
  EXPECT_NEAR(allowed.omega_rad_s / allowed.v_m_s, 3.0, 1e-9) << "along the same arc";
}

TEST(SafetySupervisor, WhatItRemembersBehindItStopsARobotThatBacksUp) {
  const LaserScan scan = wall_ahead(6.0);
  SafetyInput input{.wanted = {-0.3, 0.0}, .armed = true, .scan = &scan};
  EXPECT_EQ(supervise(input, {}).allowed, input.wanted);
  input.remembered_base = {{-0.28, 0.05}};
  EXPECT_DOUBLE_EQ(supervise(input, {}).allowed.v_m_s, 0.0);
}

TEST(SafetySupervisor, ARobotThatStillRollsDoesNotTurnIntoTheCornerThatItPasses) {
  // A corner that the robot passes with 1 cm to spare, and a follower that has stopped the way but not the turn.
  const Point2 corner(0.1, -0.27);
  LaserScan scan;
  scan.angle_min_rad = std::atan2(corner.y(), corner.x());
  scan.angle_step_rad = 0.01;
  scan.range_max_m = 8.0;
  scan.ranges_m = {static_cast<float>(corner.norm())};
  const Twist2 turn{0.0, -1.0};
  SafetyInput input{.wanted = turn, .armed = true, .scan = &scan, .velocity = {0.2, 0.0}};
  // At 0.2 m/s a turn of 0.25 rad/s passes the corner, one of 0.5 rad/s meets it before the robot stands.
  EXPECT_DOUBLE_EQ(supervise(input, {}).allowed.omega_rad_s, -0.25);
  EXPECT_FALSE(supervise(input, {}).reason.empty());
  input.velocity = {};
  EXPECT_EQ(supervise(input, {}).allowed, turn) << "standing it may turn";
}

TEST(SafetySupervisor, LowObstacleSeenBySonarAloneStopsTheRobot) {
  const LaserScan scan = wall_ahead(6.0);
  const SonarScan sonar = echo_ahead(0.15F);
  const SafetyVerdict verdict = supervise({.wanted = kForward, .armed = true, .scan = &scan, .sonar = &sonar}, {});
  EXPECT_LT(verdict.allowed.v_m_s, 0.05);
}

TEST(SafetySupervisor, EchoThatTheLidarExplainsAddsNoPoint) {
  const LaserScan scan = wall_ahead(0.75);
  const SonarScan sonar = echo_ahead(0.60F);
  EXPECT_EQ(obstacle_points({.scan = &scan, .sonar = &sonar}, {}).size(), points_in_base(scan).size());
}

TEST(SafetySupervisor, AWallIsAsNearAsTheRobotHasComeSinceItWasSeen) {
  const LaserScan scan = wall_ahead(0.77);
  const SonarScan sonar = echo_ahead(0.65F);
  SafetyInput input{.wanted = kForward, .armed = true, .scan = &scan};
  EXPECT_GT(supervise(input, {}).allowed.v_m_s, 0.3);
  input.base_T_scan = {-0.5, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(supervise(input, {}).allowed.v_m_s, 0.0) << "0.27 m are left of 0.77 m";
  input = {.wanted = kForward, .armed = true, .sonar = &sonar, .base_T_sonar = {-0.5, 0.0, 0.0}};
  EXPECT_LT(supervise(input, {}).allowed.v_m_s, 0.05) << "0.15 m before the transducer";
}

TEST(SafetySupervisor, EstopFaultAndDisarmedMeanZeroWithTheReason) {
  const api::Fault fault{.id = "sonar-silent",
                         .component = "sonar",
                         .severity = api::Severity::kError,
                         .onset = {},
                         .message = "the sonar has been silent",
                         .remedy = ""};
  EXPECT_EQ(supervise({.wanted = kForward, .armed = true, .estop = true}, {}).allowed, Twist2{});
  const SafetyVerdict blocked = supervise({.wanted = kForward, .armed = true, .blocking = &fault}, {});
  EXPECT_EQ(blocked.allowed, Twist2{});
  EXPECT_EQ(blocked.reason, fault.message);
  EXPECT_EQ(supervise({.wanted = kForward}, {}).allowed, Twist2{});
}

TEST(SafetySupervisor, AnotherRobotThatComesTowardsItStopsTheRobotEarlierThanAWall) {
  // 0.64 m of room: a robot at 0.4 m/s stops in 0.35 m, the other one comes on by 0.52 m until it stands.
  const LaserScan scan = wall_ahead(0.9);
  SafetyInput input{.wanted = kForward, .armed = true, .scan = &scan, .velocity = kForward};
  EXPECT_EQ(supervise(input, {}).allowed, kForward);
  nav::Mover other;
  other.frame_T_base = {1.16, 0.0, 3.14159};
  other.velocity = {0.5, 0.0};
  input.movers_base = {other};
  const SafetyVerdict verdict = supervise(input, {});
  EXPECT_LT(verdict.allowed.v_m_s, kForward.v_m_s);
  EXPECT_EQ(verdict.reason, "slowed for another robot");
}

TEST(SafetySupervisor, NanNeverReachesTheBase) {
  const SafetyVerdict verdict = supervise({.wanted = {std::nan(""), 0.0}, .armed = true}, {});
  EXPECT_EQ(verdict.allowed, Twist2{});
}

}  // namespace
}  // namespace seeker::app
