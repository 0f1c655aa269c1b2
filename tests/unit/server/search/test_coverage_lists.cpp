#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/search/coverage_lists.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::search {
namespace {

using seeker::testing::Pose2Near;

TEST(CoverageLists, PassesLimitFollowsEquation1) {
  EXPECT_EQ(passes_limit(25.0, 0.64), 14);  // 13.02 rounded up, spec S3.3
  EXPECT_EQ(passes_limit(19.2, 0.64), 10);
  EXPECT_EQ(passes_limit(0.1, 0.64), 1);
}

TEST(CoverageLists, PotentialCellFollowsEquations2And3) {
  // Robot at (1, 2) heading +90 deg: its left is -x.
  const Pose2 left = potential_cell({1.0, 2.0, kPi / 2.0}, kPi / 2.0, 0.8, 0.26);
  EXPECT_THAT(left, Pose2Near(Pose2{1.0 - 1.06, 2.0, kPi}, 1e-9, 1e-9));
  const Pose2 right = potential_cell({1.0, 2.0, 0.0}, -kPi / 2.0, 0.8, 0.26);
  EXPECT_THAT(right, Pose2Near(Pose2{1.0, 2.0 - 1.06, -kPi / 2.0}, 1e-9, 1e-9));
}

TEST(CoverageLists, InListIsChebyshevHalfACell) {
  CoverageLists lists(0.8, 10);
  EXPECT_EQ(lists.arrive({0.0, 0.0}), Arrival::kFresh);
  EXPECT_TRUE(lists.searched({0.4, -0.4}));  // Euclidean distance 0.57: the norm matters
  EXPECT_FALSE(lists.searched({0.41, 0.0}));
}

TEST(CoverageLists, PotentialCellsAreAppendedOnce) {
  CoverageLists lists(0.8, 10);
  (void)lists.arrive({0.0, 0.0});
  EXPECT_TRUE(lists.note_potential({0.0, 1.06}));
  EXPECT_FALSE(lists.note_potential({0.2, 1.2}));
  EXPECT_FALSE(lists.note_potential({0.3, 0.3}));  // searched
  EXPECT_EQ(lists.lists().unsearched.size(), 1U);
}

TEST(CoverageLists, ArrivingDeletesFromUnsearchedAndResetsN) {
  CoverageLists lists(0.8, 3);
  (void)lists.arrive({0.0, 0.0});
  (void)lists.note_potential({0.0, 1.06});
  EXPECT_EQ(lists.arrive({0.1, 0.0}), Arrival::kPass);
  EXPECT_EQ(lists.lists().passes_n, 1);
  EXPECT_EQ(lists.arrive({0.1, 1.0}), Arrival::kFresh);
  EXPECT_EQ(lists.lists().passes_n, 0);
  EXPECT_TRUE(lists.lists().unsearched.empty());
  EXPECT_EQ(lists.lists().searched.size(), 2U);
}

TEST(CoverageLists, SearchWellAfterNPassesAndEscapeHalvesN) {
  CoverageLists lists(0.8, 3);
  (void)lists.arrive({0.0, 0.0});
  (void)lists.note_potential({3.0, 0.0});
  (void)lists.note_potential({0.0, 2.0});
  EXPECT_EQ(lists.arrive({0.1, 0.1}), Arrival::kPass);
  EXPECT_EQ(lists.arrive({0.1, 0.1}), Arrival::kPass);
  EXPECT_EQ(lists.arrive({0.1, 0.1}), Arrival::kSearchWell);
  const auto goal = lists.nearest_unsearched({0.1, 0.1});
  ASSERT_TRUE(goal.has_value());
  EXPECT_EQ(*goal, Point2(0.0, 2.0));
  lists.escaped(*goal, {0.1, 1.8});
  EXPECT_EQ(lists.lists().passes_n, 0);
  EXPECT_EQ(lists.lists().passes_limit_n, 1);  // floor(3 / 2), at least 1
  EXPECT_EQ(lists.lists().unsearched.size(), 1U);
  EXPECT_TRUE(lists.searched({0.1, 1.8}));
  // N = 1: one pass is enough now.
  EXPECT_EQ(lists.arrive({0.1, 1.8}), Arrival::kSearchWell);
  lists.escaped({3.0, 0.0}, {3.0, 0.0});
  EXPECT_EQ(lists.lists().passes_limit_n, 1);
}

TEST(CoverageLists, UnreachableCellsAreDroppedForGood) {
  CoverageLists lists(0.8, 10);
  (void)lists.note_potential({3.0, 0.0});
  lists.drop_unreachable({3.0, 0.0});
  EXPECT_FALSE(lists.nearest_unsearched({0.0, 0.0}).has_value());
  EXPECT_FALSE(lists.note_potential({3.1, 0.1}));
  EXPECT_EQ(lists.lists().unreachable.size(), 1U);
}

}  // namespace
}  // namespace seeker::search
