#include "server/slam/place_claim.hpp"

#include <gtest/gtest.h>

namespace seeker::slam {
namespace {

const Pose2 kNodeTBase{1.0, 0.5, 0.3};

/// A clear answer that puts the node there.
PlaceAnswer unique(const Pose2& map_T_node) {
  PlaceAnswer answer;
  answer.verdict = PlaceVerdict::kUnique;
  answer.candidates.resize(1);
  answer.candidates.front().match.map_T_base = map_T_node * kNodeTBase;
  return answer;
}

PlaceAnswer none() { return {}; }

PlaceAnswer ambiguous(bool says_nothing) {
  PlaceAnswer answer = unique({9.0, 9.0, 0.0});
  answer.verdict = PlaceVerdict::kAmbiguous;
  answer.says_nothing = says_nothing;
  return answer;
}

const Pose2 kPlace{4.0, 2.0, 1.0};
const Pose2 kBeside{4.1, 1.9, 1.02};

TEST(PlaceClaim, ThreeAnswersInARowAreBelieved) {
  PlaceClaim claim;
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  EXPECT_FALSE(claim.take(unique(kBeside), kNodeTBase));
  EXPECT_TRUE(claim.take(unique(kPlace), kNodeTBase));
}

TEST(PlaceClaim, AnotherPlaceBeginsTheRowAnew) {
  PlaceClaim claim;
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  EXPECT_FALSE(claim.take(unique(kPlace * Pose2{1.0, 0.0, 0.0}), kNodeTBase));
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  EXPECT_TRUE(claim.take(unique(kPlace), kNodeTBase));
}

TEST(PlaceClaim, WhatSpeaksAgainstTheMapOrForAnotherPlaceBreaksTheRow) {
  for (const PlaceAnswer& against : {none(), ambiguous(false)}) {
    PlaceClaim claim;
    for (int round = 0; round < 5; ++round) {
      EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
      EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
      EXPECT_FALSE(claim.take(against, kNodeTBase));
    }
  }
}

TEST(PlaceClaim, WhatSaysNothingIsLeftOut) {
  PlaceClaim claim;
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  EXPECT_FALSE(claim.take(ambiguous(true), kNodeTBase));
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  EXPECT_FALSE(claim.take(ambiguous(true), kNodeTBase)) << "it is no witness";
  EXPECT_TRUE(claim.take(unique(kPlace), kNodeTBase));
}

TEST(PlaceClaim, TheRowGoesOnInTheNextLocalMap) {
  PlaceClaim claim;
  const Pose2 old_T_new{3.0, 1.0, -0.5};
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  claim.change_node(old_T_new);
  EXPECT_TRUE(claim.take(unique(kPlace * old_T_new), kNodeTBase));
  claim.clear();
  EXPECT_FALSE(claim.take(unique(kPlace * old_T_new), kNodeTBase));
}

TEST(PlaceClaim, WhereItWasKnownToBeOneAnswerIsEnough) {
  PlaceClaim claim;
  PlaceAnswer there = unique(kPlace);
  there.expected = true;
  EXPECT_TRUE(claim.take(there, kNodeTBase));
}

}  // namespace
}  // namespace seeker::slam
