#include <gtest/gtest.h>

#include "server/fleet/merge_memory.hpp"

namespace seeker::fleet {
namespace {

MergeHypothesis at(double x_m, double shared_m, double contradiction) {
  MergeHypothesis made;
  made.a_T_b.a_T_b = {x_m, 0.0, 0.0};
  made.shared_wall_m = shared_m;
  made.weak_wall_m = shared_m;
  made.contradiction = contradiction;
  made.pairs.resize(3);
  return made;
}

MergeAnswer judged(std::vector<MergeHypothesis> hypotheses) {
  MergeAnswer answer;
  answer.hypotheses = std::move(hypotheses);
  judge(answer, {});
  return answer;
}

MergeVerdict after_merge(std::vector<MergeHypothesis> now) {
  MergeAnswer answer = judged(std::move(now));
  judge_again(answer, judged({at(5.0, 80.0, 0.05)}), {});
  return answer.verdict;
}

TEST(MergeMemory, WhatIsLessSureThanAtFirstStaysMerged) {
  ASSERT_EQ(judged({at(5.1, 80.0, 0.21)}).verdict, MergeVerdict::kAmbiguous);
  EXPECT_EQ(after_merge({at(5.1, 80.0, 0.21)}), MergeVerdict::kMerged);
  EXPECT_EQ(after_merge({at(5.1, 20.0, 0.05)}), MergeVerdict::kMerged);
}

TEST(MergeMemory, OnePairIsEnoughForWhatWasMergedByMore) {
  MergeHypothesis one_pair = at(5.1, 80.0, 0.05);
  one_pair.pairs.resize(1);
  ASSERT_EQ(judged({one_pair}).verdict, MergeVerdict::kAmbiguous);
  EXPECT_EQ(after_merge({one_pair}), MergeVerdict::kMerged);
}

TEST(MergeMemory, ADoorThatWasShutMeanwhileEndsNothingButALongWallDoes) {
  MergeHypothesis door = at(5.1, 80.0, 0.1);
  door.denied_piece_m = 2.0;
  ASSERT_EQ(judged({door}).verdict, MergeVerdict::kAmbiguous);
  EXPECT_EQ(after_merge({door}), MergeVerdict::kMerged);
  door.denied_piece_m = 5.0;
  EXPECT_EQ(after_merge({door}), MergeVerdict::kAmbiguous);
}

TEST(MergeMemory, ContradictionRivalsAndTooLittleOverlapEndIt) {
  EXPECT_EQ(after_merge({at(5.1, 80.0, 0.3)}), MergeVerdict::kContradicted);
  EXPECT_EQ(after_merge({at(5.1, 80.0, 0.1), at(20.0, 70.0, 0.1)}), MergeVerdict::kAmbiguous);
  EXPECT_EQ(after_merge({at(5.1, 5.0, 0.1)}), MergeVerdict::kInsufficientOverlap);
  EXPECT_EQ(after_merge({}), MergeVerdict::kInsufficientOverlap);
}

TEST(MergeMemory, AnotherPlaceOrAFirstMeetingIsJudgedAsEver) {
  EXPECT_EQ(after_merge({at(9.0, 80.0, 0.21)}), MergeVerdict::kAmbiguous);
  MergeAnswer first = judged({at(5.0, 20.0, 0.05)});
  judge_again(first, judged({at(5.0, 20.0, 0.05)}), {});
  EXPECT_EQ(first.verdict, MergeVerdict::kAmbiguous);
}

}  // namespace
}  // namespace seeker::fleet
