#include "server/app/fleet/member.hpp"

#include "tests/support/matchers.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

using app::Member;

app::MemberRecord kept_record() {
  const app::PackedMap robot = packed(small_map());
  app::MemberRecord record;
  record.manifest = robot.manifest;
  record.pieces = robot.pieces;
  record.topology = at_place("r1", {2.0, 1.0});
  record.finds.before = {found_at(1, {1.0, 0.0})};
  return record;
}

TEST(Member, IsWhatItsRecordSaysWithoutTheVelocity) {
  const Member member(kept_record(), 3);
  EXPECT_EQ(member.slot, 3);
  EXPECT_TRUE(member.map.missing().empty());
  ASSERT_TRUE(member.report.topology);
  EXPECT_FALSE(member.report.topology->velocity) << "nobody knows how it drives now";
  EXPECT_EQ(member.record().manifest, kept_record().manifest);
  EXPECT_EQ(member.record().finds.before.size(), 1U);
}

TEST(Member, IsDescribedInTheFrameOfTheMainRobotOnlyWhereItIsMerged) {
  Member member(kept_record(), 1);
  member.map.set_pose(Pose2{1.0, 0.0, 0.0});
  api::FleetMember entry = member.describe(kStart, seconds(5));
  EXPECT_FALSE(entry.main_T_base);
  EXPECT_TRUE(entry.detections.empty());
  EXPECT_EQ(entry.places.size(), 2U);
  ASSERT_TRUE(member.standing.settle(1, merged_at({10.0, 0.0, 0.0}), {}));
  entry = member.describe(kStart, seconds(5));
  ASSERT_TRUE(entry.main_T_base);
  EXPECT_THAT(*entry.main_T_base, Pose2Near(Pose2{11.0, 0.0, 0.0}, 1e-9, 1e-9));
  EXPECT_EQ(entry.detections.size(), 1U);
}

TEST(Member, IsLinkedForTwiceTheSilenceLimit) {
  Member member;
  EXPECT_FALSE(member.describe(kStart, seconds(5)).linked) << "it was never heard";
  member.seen = kStart;
  EXPECT_TRUE(member.describe(kStart + seconds(9), seconds(5)).linked);
  EXPECT_FALSE(member.describe(kStart + seconds(10), seconds(5)).linked);
}

TEST(Member, DropsItsReportWithItsMap) {
  Member member(kept_record(), 1);
  EXPECT_TRUE(member.begin_new_map(packed(small_map(2, 9)).manifest));
  EXPECT_FALSE(member.report.topology);
  EXPECT_FALSE(Member().begin_new_map(packed(small_map()).manifest)) << "it is its first map";
}

}  // namespace
}  // namespace seeker::testing
