#include "server/app/safety/lease.hpp"

#include <gmock/gmock.h>

namespace seeker::app {
namespace {

using api::LeaseAction;
using std::chrono::seconds;
using ::testing::HasSubstr;

class LeaseTest : public ::testing::Test {
 protected:
  Result<api::LeaseState> command(const std::string& client, LeaseAction action, bool intended = false,
                                  api::Role role = api::Role::kOperator) {
    return lease.command({client, role}, {action, intended}, now);
  }
  /// The sentence of a refusal.
  std::string refusal(const std::string& client, LeaseAction action) {
    const Result<api::LeaseState> refused = command(client, action);
    return refused || refused.error().code != Errc::kRefused ? "not refused" : refused.error().message;
  }
  [[nodiscard]] const std::string& owner() const { return lease.state().owner; }

  Lease::WallTime now;
  Lease lease{{.request_timeout = seconds(10)}};
};

TEST_F(LeaseTest, FreeLeaseIsGivenToWhoAsksForIt) {
  ASSERT_TRUE(command("ben", LeaseAction::kRequest));
  EXPECT_EQ(owner(), "ben");
}

TEST_F(LeaseTest, OwnerGrantsAndTheEpochRises) {
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire));
  const std::uint64_t before = lease.state().epoch;
  const Result<api::LeaseState> asked = command("ben", LeaseAction::kRequest);
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->owner, "anna");
  EXPECT_EQ(asked->requested_by, "ben");
  EXPECT_EQ(asked->request_left, Duration(seconds(10)));
  ASSERT_TRUE(command("anna", LeaseAction::kGrant));
  EXPECT_EQ(owner(), "ben");
  EXPECT_TRUE(lease.state().requested_by.empty());
  EXPECT_GT(lease.state().epoch, before);
}

TEST_F(LeaseTest, OwnerDeniesAndKeepsIt) {
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire));
  const std::uint64_t before = lease.state().epoch;
  ASSERT_TRUE(command("ben", LeaseAction::kRequest));
  ASSERT_TRUE(command("anna", LeaseAction::kDeny));
  EXPECT_EQ(owner(), "anna");
  EXPECT_TRUE(lease.state().requested_by.empty());
  EXPECT_EQ(lease.state().epoch, before) << "what she has sent stays good";
  EXPECT_EQ(command("anna", LeaseAction::kGrant).error().code, Errc::kNotFound);
}

TEST_F(LeaseTest, UnansweredRequestTimesOut) {
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire));
  ASSERT_TRUE(command("ben", LeaseAction::kRequest));
  now += seconds(7);
  EXPECT_FALSE(lease.watch(now));
  EXPECT_EQ(lease.state().request_left, Duration(seconds(3)));
  now += seconds(3);
  EXPECT_TRUE(lease.watch(now));
  EXPECT_FALSE(lease.watch(now)) << "once";
  EXPECT_TRUE(lease.state().requested_by.empty());
  EXPECT_EQ(owner(), "anna");
  EXPECT_TRUE(command("cleo", LeaseAction::kRequest)) << "the next one may ask";
}

TEST_F(LeaseTest, OneClientAsksAtATime) {
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire));
  ASSERT_TRUE(command("ben", LeaseAction::kRequest));
  const std::string why = refusal("cleo", LeaseAction::kRequest);
  EXPECT_THAT(why, HasSubstr("'ben'"));
  EXPECT_THAT(why, HasSubstr("'anna'"));
  EXPECT_EQ(lease.state().requested_by, "ben");
}

TEST_F(LeaseTest, RefusalsNameTheOwnerAndTheRemedy) {
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire));
  for (const LeaseAction action :
       {LeaseAction::kAcquire, LeaseAction::kTakeOver, LeaseAction::kGrant, LeaseAction::kDeny}) {
    EXPECT_THAT(refusal("ben", action), HasSubstr("'anna'")) << static_cast<int>(action);
  }
  EXPECT_THAT(refusal("ben", LeaseAction::kAcquire), HasSubstr("seeker lease request"));
  EXPECT_THAT(refusal("ben", LeaseAction::kTakeOver), HasSubstr("--yes"));
  EXPECT_THAT(lease.free_for("ben").error().message, HasSubstr("'anna'"));
  EXPECT_THAT(lease.take("ben", lease.state().epoch, 1).error().message, HasSubstr("'anna'"));
}

TEST_F(LeaseTest, AnAdminOrAPersonWhoMeansItTakesItOver) {
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire));
  EXPECT_FALSE(command("ben", LeaseAction::kTakeOver));
  EXPECT_EQ(owner(), "anna");
  ASSERT_TRUE(command("ben", LeaseAction::kTakeOver, true));
  EXPECT_EQ(owner(), "ben");
  ASSERT_TRUE(command("root", LeaseAction::kTakeOver, false, api::Role::kAdmin));
  EXPECT_EQ(owner(), "root");
}

TEST_F(LeaseTest, SilentOwnerKeepsAStaleLeaseUntilSomebodyTakesIt) {
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire));
  const std::uint64_t before = lease.state().epoch;
  lease.silent("anna");
  EXPECT_EQ(owner(), "anna");
  EXPECT_TRUE(lease.state().stale);
  EXPECT_GT(lease.state().epoch, before);
  EXPECT_TRUE(lease.free_for("ben"));
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire)) << "nobody has taken it";
  EXPECT_FALSE(lease.state().stale);
  EXPECT_FALSE(lease.take("anna", before, 0));
  EXPECT_TRUE(lease.take("anna", lease.state().epoch, 0));

  lease.silent("anna");
  ASSERT_TRUE(command("ben", LeaseAction::kAcquire));
  EXPECT_FALSE(lease.state().stale);
  EXPECT_THAT(refusal("anna", LeaseAction::kAcquire), HasSubstr("'ben'"));
}

TEST_F(LeaseTest, WhoAsksGetsTheLeaseOfAnOwnerThatFallsSilent) {
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire));
  ASSERT_TRUE(command("ben", LeaseAction::kRequest));
  lease.silent("anna");
  EXPECT_EQ(owner(), "ben");
  EXPECT_FALSE(lease.state().stale);
}

TEST_F(LeaseTest, SilentOrGoneClientAsksNoMore) {
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire));
  ASSERT_TRUE(command("ben", LeaseAction::kRequest));
  lease.silent("ben");
  EXPECT_TRUE(lease.state().requested_by.empty());
  ASSERT_TRUE(command("ben", LeaseAction::kRequest));
  lease.forget("ben");
  EXPECT_TRUE(lease.state().requested_by.empty());
  EXPECT_EQ(owner(), "anna");
}

TEST_F(LeaseTest, ReleaseGivesItToWhoAsks) {
  ASSERT_TRUE(command("anna", LeaseAction::kAcquire));
  ASSERT_TRUE(command("ben", LeaseAction::kRequest));
  ASSERT_TRUE(command("anna", LeaseAction::kRelease));
  EXPECT_EQ(owner(), "ben");
  ASSERT_TRUE(command("ben", LeaseAction::kRelease));
  EXPECT_TRUE(owner().empty());
}

}  // namespace
}  // namespace seeker::app
