#include "server/app/safety/motion_authority.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace seeker::app {
namespace {

using api::LeaseAction;

api::DriveCommand command(const MotionAuthority& authority, double v_m_s = 0.2) {
  return {.velocity = {v_m_s, 0.0}, .ttl = std::chrono::milliseconds(300), .lease_epoch = authority.lease().epoch};
}

/// As a person does it.
Result<api::LeaseState> lease_by(MotionAuthority& authority, const std::string& client, LeaseAction action) {
  return authority.command_lease({client}, {action, true}, {});
}

TEST(MotionAuthority, DriveNeedsTheLeaseAndExpires) {
  MotionAuthority authority;
  EXPECT_EQ(authority.drive("anna", command(authority), RobotTime{}).error().code, Errc::kRefused);
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  ASSERT_TRUE(authority.drive("anna", command(authority), robot_time_s(1.0)));
  EXPECT_TRUE(authority.drive_velocity(robot_time_s(1.29)).has_value());
  EXPECT_FALSE(authority.drive_velocity(robot_time_s(1.3)).has_value());
}

TEST(MotionAuthority, CommandOfAnEarlierOwnerIsRefused) {
  MotionAuthority authority;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  const api::DriveCommand old = command(authority);
  ASSERT_TRUE(lease_by(authority, "ben", LeaseAction::kTakeOver));
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kTakeOver));
  const Status status = authority.drive("anna", old, RobotTime{});
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("earlier lease"), std::string::npos);
}

TEST(MotionAuthority, AStopHoldsAgainstCommandsThatAreStillOnTheirWay) {
  MotionAuthority authority;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  const api::DriveCommand before = command(authority);
  ASSERT_TRUE(authority.drive("anna", before, RobotTime{}));
  authority.stop();
  EXPECT_FALSE(authority.drive_velocity(RobotTime{}).has_value());
  const Status status = authority.drive("anna", before, RobotTime{});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, Errc::kRefused);
  EXPECT_NE(status.error().message.find("was stopped"), std::string::npos) << status.error().message;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  EXPECT_TRUE(authority.drive("anna", command(authority), RobotTime{}));
}

TEST(MotionAuthority, ARefusalNamesTheOwnerAndTheOptionThatTakesOver) {
  MotionAuthority authority;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  const std::string why = lease_by(authority, "ben", LeaseAction::kAcquire).error().message;
  EXPECT_NE(why.find("'anna'"), std::string::npos);
  EXPECT_NE(why.find("--take-over"), std::string::npos) << why;
}

TEST(MotionAuthority, OwnerGrantsARequest) {
  MotionAuthority authority;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  EXPECT_FALSE(lease_by(authority, "ben", LeaseAction::kAcquire));
  ASSERT_TRUE(lease_by(authority, "ben", LeaseAction::kRequest));
  EXPECT_FALSE(lease_by(authority, "ben", LeaseAction::kGrant));
  const Result<api::LeaseState> state = lease_by(authority, "anna", LeaseAction::kGrant);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->owner, "ben");
}

TEST(MotionAuthority, EstopLatchesVoidsTheCommandAndDisarms) {
  MotionAuthority authority;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  authority.arm();
  ASSERT_TRUE(authority.drive("anna", command(authority), RobotTime{}));
  authority.set_estop(true);
  EXPECT_FALSE(authority.armed());
  EXPECT_FALSE(authority.drive_velocity(RobotTime{}).has_value());
  EXPECT_FALSE(authority.drive("anna", command(authority), RobotTime{}));
  authority.set_estop(false);
  EXPECT_FALSE(authority.armed()) << "releasing must not power the motors";
}

TEST(MotionAuthority, OwnerThatHasLeftFreesTheLease) {
  MotionAuthority authority;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  ASSERT_TRUE(authority.drive("anna", command(authority), RobotTime{}));
  authority.forget("anna");
  EXPECT_TRUE(authority.lease().owner.empty());
  EXPECT_FALSE(authority.drive_velocity(RobotTime{}).has_value());
}

TEST(MotionAuthority, SilentOwnerStandsAndMovesAgainOnlyAfterRefreshingItsLease) {
  MotionAuthority authority;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  const api::DriveCommand late = command(authority);
  ASSERT_TRUE(authority.drive("anna", late, RobotTime{}));
  authority.silent("anna");
  EXPECT_FALSE(authority.drive_velocity(RobotTime{}).has_value());
  EXPECT_TRUE(authority.lease().stale);
  const Status status = authority.drive("anna", late, RobotTime{});
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("stale"), std::string::npos) << status.error().message;
  EXPECT_FALSE(authority.drive("anna", command(authority), RobotTime{})) << "also under the new epoch";
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  EXPECT_FALSE(authority.drive("anna", late, RobotTime{}));
  EXPECT_TRUE(authority.drive("anna", command(authority), RobotTime{}));
}

TEST(MotionAuthority, LifeOfACommandCountsFromWhenItWasSent) {
  MotionAuthority authority;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  api::DriveCommand sent = command(authority);
  sent.sent = robot_time_s(10.0);
  ASSERT_TRUE(authority.drive("anna", sent, robot_time_s(10.2)));
  EXPECT_TRUE(authority.drive_velocity(robot_time_s(10.29)).has_value());
  EXPECT_FALSE(authority.drive_velocity(robot_time_s(10.3)).has_value());
  EXPECT_EQ(authority.drive("anna", sent, robot_time_s(10.3)).error().code, Errc::kTimeout);
  sent.sent = robot_time_s(11.0);
  EXPECT_EQ(authority.drive("anna", sent, robot_time_s(10.3)).error().code, Errc::kRefused) << "from the future";
  sent.sent = robot_time_s(10.5);
  ASSERT_TRUE(authority.drive("anna", sent, robot_time_s(10.4))) << "clocks are compared to some error";
  EXPECT_FALSE(authority.drive_velocity(robot_time_s(10.7)).has_value()) << "which never makes a life longer";
}

TEST(MotionAuthority, CommandThatWasOvertakenIsRefused) {
  MotionAuthority authority;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  api::DriveCommand numbered = command(authority, 0.0);
  numbered.sequence = 8;
  ASSERT_TRUE(authority.drive("anna", numbered, RobotTime{}));
  EXPECT_EQ(authority.lease().sequence, 8U);
  api::DriveCommand late = command(authority);
  late.sequence = 7;
  EXPECT_FALSE(authority.drive("anna", late, RobotTime{}));
  EXPECT_EQ(authority.drive_velocity(RobotTime{}), Twist2{});
  ASSERT_TRUE(lease_by(authority, "ben", LeaseAction::kTakeOver));
  api::DriveCommand first = command(authority);
  first.sequence = 1;
  EXPECT_TRUE(authority.drive("ben", first, RobotTime{})) << "numbers count anew for each epoch";
}

TEST(MotionAuthority, NanAndLongLifeAreRefused) {
  MotionAuthority authority;
  ASSERT_TRUE(lease_by(authority, "anna", LeaseAction::kAcquire));
  EXPECT_EQ(authority.drive("anna", command(authority, std::nan("")), RobotTime{}).error().code,
            Errc::kInvalidArgument);
  api::DriveCommand immortal = command(authority);
  immortal.ttl = std::chrono::hours(1);
  EXPECT_FALSE(authority.drive("anna", immortal, RobotTime{}));
}

}  // namespace
}  // namespace seeker::app
