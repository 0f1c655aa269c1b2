#include <gtest/gtest.h>

#include "server/fleet/fleet_links.hpp"

namespace seeker::fleet {
namespace {

PairAnswer pair(std::uint8_t a, std::uint8_t b, double confidence, MergeVerdict verdict = MergeVerdict::kMerged) {
  PairAnswer made{a, b, {}};
  made.answer.verdict = verdict;
  made.answer.hypotheses.emplace_back().confidence = confidence;
  return made;
}

TEST(FleetLinks, ARobotHangsTogetherWithTheMainOneOverAnother) {
  const auto links = links_from(
      0, {pair(0, 1, 0.9), pair(0, 2, 0.0, MergeVerdict::kInsufficientOverlap), pair(1, 2, 0.7), pair(3, 4, 1.0)});
  ASSERT_EQ(links.size(), 2U);
  EXPECT_EQ(links.at(1).through, 0);
  EXPECT_DOUBLE_EQ(links.at(1).confidence, 0.9);
  EXPECT_EQ(links.at(2).through, 1);
  EXPECT_DOUBLE_EQ(links.at(2).confidence, 0.7);
}

TEST(FleetLinks, OfSeveralPathsTheSurestCounts) {
  const auto links = links_from(0, {pair(0, 1, 0.9), pair(0, 2, 0.3), pair(1, 2, 0.8)});
  EXPECT_EQ(links.at(2).through, 1);
  EXPECT_DOUBLE_EQ(links.at(2).confidence, 0.8);
}

TEST(FleetLinks, NobodyHangsTogetherWithoutMergedPairs) {
  EXPECT_TRUE(links_from(0, {}).empty());
  EXPECT_TRUE(links_from(0, {pair(0, 1, 0.9, MergeVerdict::kAmbiguous)}).empty());
}

}  // namespace
}  // namespace seeker::fleet
