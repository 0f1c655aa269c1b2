#include "server/slam/place_claim.hpp"

#include <gtest/gtest.h>

namespace seeker::slam {
namespace {

const Pose2 kNodeTBase{1.0, 0.5, 0.3};

/// A clear answer that puts the node there.
PlaceAnswer unique(const Pose2& map_T_node) {
  PlaceAnswer answer;
  answer.verdict = PlaceVerdict::kUnique;
  answer.weight = 1.0;
  answer.candidates.resize(1);
  answer.candidates.front().match.map_T_base = map_T_node * kNodeTBase;
  return answer;
}

/// One that prefers a place, of a robot at node_T_base.
PlaceAnswer slight(const Pose2& map_T_node, double weight, const Pose2& node_T_base) {
  PlaceAnswer answer;
  answer.verdict = PlaceVerdict::kAmbiguous;
  answer.weight = weight;
  answer.candidates.resize(1);
  answer.candidates.front().match.map_T_base = map_T_node * node_T_base;
  return answer;
}

Pose2 on_the_way(int views) { return kNodeTBase * Pose2{0.4 * views, 0.0, 0.0}; }

PlaceAnswer none() { return {}; }

PlaceAnswer ambiguous(bool says_nothing) {
  PlaceAnswer answer = unique({9.0, 9.0, 0.0});
  answer.verdict = PlaceVerdict::kAmbiguous;
  answer.weight = 0.0;
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

TEST(PlaceClaim, AnotherPlaceBeginsTheRowAgain) {
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

TEST(PlaceClaim, ViewsThatSlightlyPreferOnePlaceProveItTogether) {
  PlaceClaim claim;
  for (int k = 0; k < 4; ++k) {
    EXPECT_FALSE(claim.take(slight(kPlace, 0.7, on_the_way(k)), on_the_way(k))) << k;
  }
  EXPECT_TRUE(claim.take(slight(kBeside, 0.7, on_the_way(4)), on_the_way(4)));
}

TEST(PlaceClaim, OneViewLookedAtAgainAndAgainIsOne) {
  PlaceClaim claim;
  for (int k = 0; k < 50; ++k) {
    EXPECT_FALSE(claim.take(slight(kPlace, 0.9, on_the_way(0)), on_the_way(0)));
  }
}

TEST(PlaceClaim, AViewThatPrefersAnotherPlaceBeginsTheRowAgain) {
  PlaceClaim claim;
  const Pose2 other = kPlace * Pose2{2.0, 0.0, 0.0};
  for (int k = 0; k < 30; ++k) {
    const Pose2& place = k % 3 == 2 ? other : kPlace;
    EXPECT_FALSE(claim.take(slight(place, 0.9, on_the_way(k)), on_the_way(k))) << k;
  }
}

TEST(PlaceClaim, AViewThatPrefersNoneDoesNotBreakTheRowWhereTheSamePlaceFitsBest) {
  PlaceClaim claim;
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  EXPECT_FALSE(claim.take(unique(kPlace), kNodeTBase));
  EXPECT_FALSE(claim.take(slight(kPlace, 0.0, on_the_way(1)), on_the_way(1)));
  EXPECT_TRUE(claim.take(unique(kPlace), kNodeTBase));
}

}  // namespace
}  // namespace seeker::slam
