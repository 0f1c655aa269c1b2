#include "server/app/fleet/map_pairs.hpp"

#include "tests/support/matchers.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

using app::MapPairs;

TEST(MapPairs, CountTheVersionsOfAMap) {
  MapPairs pairs({}, seconds(10));
  EXPECT_EQ(pairs.version(1), 0U);
  EXPECT_TRUE(pairs.map(1).nodes.empty());
  ASSERT_TRUE(pairs.update(1, small_map(1)));
  ASSERT_TRUE(pairs.update(1, small_map(1)));
  EXPECT_EQ(pairs.version(1), 1U) << "it is the same map";
  ASSERT_TRUE(pairs.update(1, small_map(2)));
  EXPECT_EQ(pairs.version(1), 2U);
  EXPECT_EQ(pairs.map(1).nodes.size(), 2U);
}

TEST(MapPairs, HoldTheAnswerOfTheMergerUntilAMapChanges) {
  MapPairs pairs({}, seconds(10));
  ASSERT_TRUE(pairs.update(0, west()));
  ASSERT_TRUE(pairs.update(1, east()));
  pairs.compare(0, 1);
  ASSERT_EQ(pairs.fresh_answers().size(), 1U);
  const fleet::PairAnswer found = pairs.fresh_answers().front();
  EXPECT_TRUE(found.answer.merged()) << found.answer.reason;
  EXPECT_THAT(found.answer.hypotheses.front().a_T_b.a_T_b, Pose2Near(west_T_east(), 0.15, 0.03));
  ASSERT_TRUE(pairs.update(1, small_map(2, 9)));
  pairs.mark_stale();
  EXPECT_TRUE(pairs.fresh_answers().empty()) << "it speaks of local maps that are no more";
  EXPECT_EQ(pairs.all_answers().size(), 1U);
  pairs.compare(0, 1);
  EXPECT_EQ(pairs.fresh_answers().size(), 1U);
  pairs.forget_map(1);
  EXPECT_TRUE(pairs.all_answers().empty());
}

TEST(MapPairs, CompareAgainOnlyWhatIsOld) {
  MapPairs pairs({}, seconds(10));
  ASSERT_TRUE(pairs.update(0, small_map(1)));
  ASSERT_TRUE(pairs.update(1, small_map(1, 2)));
  const app::WallTime now = std::chrono::steady_clock::now();
  fleet::PairAnswer kept{0, 1, {}};
  kept.answer.reason = "kept";
  pairs.recall(kept, now);
  ASSERT_TRUE(pairs.update(1, small_map(2, 2)));
  pairs.compare_aged(0, 1, now + seconds(10));
  ASSERT_EQ(pairs.all_answers().size(), 1U);
  EXPECT_EQ(pairs.all_answers().front().answer.reason, "kept");
  pairs.compare_aged(0, 1, now + seconds(11));
  EXPECT_NE(pairs.all_answers().front().answer.reason, "kept");
}

TEST(MapPairs, TakeUpNoAnswerForAMapThatIsNotThere) {
  MapPairs pairs({}, seconds(10));
  ASSERT_TRUE(pairs.update(0, small_map(1)));
  pairs.recall({0, 1, {}}, kStart);
  EXPECT_TRUE(pairs.all_answers().empty());
  EXPECT_FALSE(pairs.contains(1));
}

}  // namespace
}  // namespace seeker::testing
