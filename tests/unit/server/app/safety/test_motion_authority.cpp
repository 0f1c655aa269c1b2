#include "server/app/safety/motion_authority.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace seeker::app {
namespace {

using api::LeaseAction;

api::DriveCommand command(const MotionAuthority& authority, double v_m_s = 0.2) {
  return {.velocity = {v_m_s, 0.0}, .ttl = std::chrono::milliseconds(300), .lease_epoch = authority.lease().epoch};
}

TEST(MotionAuthority, DriveNeedsTheLeaseAndExpires) {
  MotionAuthority authority;
  EXPECT_EQ(authority.drive("anna", command(authority), RobotTime{}).error().code, Errc::kRefused);
  ASSERT_TRUE(authority.command_lease("anna", LeaseAction::kAcquire));
  ASSERT_TRUE(authority.drive("anna", command(authority), robot_time_s(1.0)));
  EXPECT_TRUE(authority.drive_velocity(robot_time_s(1.29)).has_value());
  EXPECT_FALSE(authority.drive_velocity(robot_time_s(1.3)).has_value());
}

TEST(MotionAuthority, CommandOfAnEarlierOwnerIsRefused) {
  MotionAuthority authority;
  ASSERT_TRUE(authority.command_lease("anna", LeaseAction::kAcquire));
  const api::DriveCommand old = command(authority);
  ASSERT_TRUE(authority.command_lease("ben", LeaseAction::kTakeOver));
  ASSERT_TRUE(authority.command_lease("anna", LeaseAction::kTakeOver));
  const Status status = authority.drive("anna", old, RobotTime{});
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("earlier lease"), std::string::npos);
}

TEST(MotionAuthority, AStopHoldsAgainstCommandsThatAreStillOnTheirWay) {
  MotionAuthority authority;
  ASSERT_TRUE(authority.command_lease("anna", LeaseAction::kAcquire));
  const api::DriveCommand before = command(authority);
  ASSERT_TRUE(authority.drive("anna", before, RobotTime{}));
  authority.stop();
  EXPECT_FALSE(authority.drive_velocity(RobotTime{}).has_value());
  const Status status = authority.drive("anna", before, RobotTime{});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, Errc::kRefused);
  EXPECT_NE(status.error().message.find("was stopped"), std::string::npos) << status.error().message;
  ASSERT_TRUE(authority.command_lease("anna", LeaseAction::kAcquire));
  EXPECT_TRUE(authority.drive("anna", command(authority), RobotTime{}));
}

TEST(MotionAuthority, ARefusalNamesTheOwnerAndTheOptionThatTakesOver) {
  MotionAuthority authority;
  ASSERT_TRUE(authority.command_lease("anna", LeaseAction::kAcquire));
  const std::string why = authority.command_lease("ben", LeaseAction::kAcquire).error().message;
  EXPECT_NE(why.find("'anna'"), std::string::npos);
  EXPECT_NE(why.find("--take-over"), std::string::npos) << why;
}

TEST(MotionAuthority, OwnerGrantsARequest) {
  MotionAuthority authority;
  ASSERT_TRUE(authority.command_lease("anna", LeaseAction::kAcquire));
  EXPECT_FALSE(authority.command_lease("ben", LeaseAction::kAcquire));
  ASSERT_TRUE(authority.command_lease("ben", LeaseAction::kRequest));
  EXPECT_FALSE(authority.command_lease("ben", LeaseAction::kGrant));
  const Result<api::LeaseState> state = authority.command_lease("anna", LeaseAction::kGrant);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->owner, "ben");
}

TEST(MotionAuthority, EstopLatchesVoidsTheCommandAndDisarms) {
  MotionAuthority authority;
  ASSERT_TRUE(authority.command_lease("anna", LeaseAction::kAcquire));
  authority.arm();
  ASSERT_TRUE(authority.drive("anna", command(authority), RobotTime{}));
  authority.set_estop(true);
  EXPECT_FALSE(authority.armed());
  EXPECT_FALSE(authority.drive_velocity(RobotTime{}).has_value());
  EXPECT_FALSE(authority.drive("anna", command(authority), RobotTime{}));
  authority.set_estop(false);
  EXPECT_FALSE(authority.armed()) << "releasing must not power the motors";
}

TEST(MotionAuthority, LostOwnerFreesTheLease) {
  MotionAuthority authority;
  ASSERT_TRUE(authority.command_lease("anna", LeaseAction::kAcquire));
  ASSERT_TRUE(authority.drive("anna", command(authority), RobotTime{}));
  authority.forget("anna");
  EXPECT_TRUE(authority.lease().owner.empty());
  EXPECT_FALSE(authority.drive_velocity(RobotTime{}).has_value());
}

TEST(MotionAuthority, NanAndLongLifeAreRefused) {
  MotionAuthority authority;
  ASSERT_TRUE(authority.command_lease("anna", LeaseAction::kAcquire));
  EXPECT_EQ(authority.drive("anna", command(authority, std::nan("")), RobotTime{}).error().code,
            Errc::kInvalidArgument);
  api::DriveCommand immortal = command(authority);
  immortal.ttl = std::chrono::hours(1);
  EXPECT_FALSE(authority.drive("anna", immortal, RobotTime{}));
}

}  // namespace
}  // namespace seeker::app
