#include "server/fleet/fleet_merge.hpp"

#include <gtest/gtest.h>

namespace seeker::fleet {
namespace {

PairAnswer merged(std::uint8_t a, std::uint8_t b, const Pose2& a_T_b, double confidence) {
  PairAnswer pair{a, b, {}};
  pair.answer.verdict = MergeVerdict::kMerged;
  MergeHypothesis hypothesis;
  hypothesis.a_T_b.a_T_b = a_T_b;
  hypothesis.confidence = confidence;
  pair.answer.hypotheses.push_back(hypothesis);
  return pair;
}

const Pose2 kOne{3.0, 1.0, 0.5};
const Pose2 kTwo{-2.0, 4.0, -1.2};

std::size_t merged_count(const std::vector<PairAnswer>& pairs) { return relations_of(pairs).size(); }

TEST(Cycles, ThreeRobotsThatAgreeStayMerged) {
  std::vector<PairAnswer> pairs{merged(0, 1, kOne, 0.9), merged(1, 2, kTwo, 0.8), merged(0, 2, kOne * kTwo, 0.7)};
  demote_open_cycles(pairs);
  EXPECT_EQ(merged_count(pairs), 3U);
  // In whichever order the pairs were compared.
  std::vector<PairAnswer> turned{merged(1, 0, inverse(kOne), 0.9), merged(1, 2, kTwo, 0.8),
                                 merged(2, 0, inverse(kOne * kTwo), 0.7)};
  demote_open_cycles(turned);
  EXPECT_EQ(merged_count(turned), 3U);
}

TEST(Cycles, OfThreeThatDoNotCloseTheLeastSureIsDemoted) {
  std::vector<PairAnswer> pairs{merged(0, 1, kOne, 0.9), merged(1, 2, kTwo, 0.6),
                                merged(0, 2, kOne * kTwo * Pose2{2.0, 0.0, 0.0}, 0.8)};
  demote_open_cycles(pairs);
  EXPECT_EQ(pairs[1].answer.verdict, MergeVerdict::kContradicted);
  EXPECT_FALSE(pairs[1].answer.reason.empty());
  EXPECT_EQ(merged_count(pairs), 2U);
}

TEST(Cycles, APairThatIsNotMergedIsNoPartOfACycle) {
  std::vector<PairAnswer> pairs{merged(0, 1, kOne, 0.9), merged(1, 2, kTwo, 0.6), merged(0, 2, {50.0, 0.0, 0.0}, 0.1)};
  pairs[2].answer.verdict = MergeVerdict::kAmbiguous;
  demote_open_cycles(pairs);
  EXPECT_EQ(merged_count(pairs), 2U);
}

TEST(Cycles, ALiarAmongFourRobotsIsFound) {
  std::vector<PairAnswer> pairs{merged(0, 1, kOne, 0.9), merged(1, 2, kTwo, 0.85), merged(0, 2, kOne * kTwo, 0.8),
                                merged(2, 3, kOne, 0.7), merged(0, 3, kTwo, 0.5),  merged(1, 3, kTwo * kOne, 0.75)};
  demote_open_cycles(pairs);
  EXPECT_EQ(merged_count(pairs), 5U);
  EXPECT_EQ(pairs[4].answer.verdict, MergeVerdict::kContradicted);
}

}  // namespace
}  // namespace seeker::fleet
