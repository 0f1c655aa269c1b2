#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "server/vision/place_index.hpp"
#include "server/vision/sift_features.hpp"
#include "stereo_scenes.hpp"

namespace seeker::vision {
namespace {

FeatureList features_of(const cv::Mat& grey) { return detect_sift(grey, place_detector_params()); }

cv::Mat place(std::uint64_t seed) {
  Rng rng(seed);
  return testing::rich_texture(512, 384, rng);
}

/// The same place from a step aside, turned a little, with noise.
cv::Mat seen_again(const cv::Mat& picture, Rng& rng) {
  const cv::Matx33d view(0.97, -0.04, 14.0, 0.05, 1.02, -9.0, 2e-5, 4e-5, 1.0);
  cv::Mat out;
  cv::warpPerspective(picture, out, view, picture.size());
  testing::degrade(out, 0.5, 2.0, rng);
  return out;
}

TEST(PlaceIndex, APlaceSeenAgainIsFoundAmongOthers) {
  Rng rng(71);
  PlaceIndex index;
  for (std::uint64_t id = 0; id < 5; ++id) {
    index.add(10 + id, features_of(place(id)));
  }
  const auto found = index.best_matches(features_of(seen_again(place(3), rng)), 5);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, 13U);
  EXPECT_GE(found[0].evidence.inliers.size(), 60U);
}

TEST(PlaceIndex, ForeignPlacesAreRefused) {
  PlaceIndex index;
  for (std::uint64_t id = 0; id < 6; ++id) {
    index.add(id, features_of(place(id)));
  }
  for (std::uint64_t seed = 100; seed < 106; ++seed) {
    EXPECT_TRUE(index.best_matches(features_of(place(seed)), 9).empty());
  }
}

TEST(PlaceIndex, NoFeatureIsInTwoInliers) {
  Rng rng(72);
  const cv::Mat picture = place(1);
  const auto evidence = compare_places(features_of(seen_again(picture, rng)), features_of(picture), {});
  ASSERT_TRUE(evidence.has_value());
  std::set<int> first;
  std::set<int> second;
  for (const FeatureMatch& m : evidence->inliers) {
    EXPECT_TRUE(first.insert(m.first).second);
    EXPECT_TRUE(second.insert(m.second).second);
  }
  EXPECT_LE(static_cast<int>(evidence->inliers.size()), evidence->matches);
}

// Fifteen matches onto five points were once "579 inliers" (vision.md 1.4).
TEST(PlaceIndex, ManyFeaturesThatAllLookLikeFiveAreNoEvidence) {
  Rng rng(73);
  const FeatureList five = features_of(place(2));
  FeatureList many = features_of(place(3));
  for (std::size_t i = 0; i < 100; ++i) {
    Descriptor like = five.descriptors[i % 5];
    like[i] = static_cast<std::uint8_t>(like[i] ^ 1U);
    many.descriptors[i] = like;
  }
  EXPECT_FALSE(compare_places(many, five, {}).has_value());
  EXPECT_FALSE(compare_places(five, many, {}).has_value());
}

TEST(PlaceIndex, InliersInOneSpotAreNoEvidence) {
  Rng rng(74);
  const FeatureList whole = features_of(place(4));
  FeatureList spot;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (std::hypot(whole.keypoints[i].u_px - 250.0F, whole.keypoints[i].v_px - 190.0F) < 200.0F) {
      spot.keypoints.push_back(whole.keypoints[i]);
      spot.keypoints.back().u_px = 250.0F + 0.1F * (whole.keypoints[i].u_px - 250.0F);
      spot.keypoints.back().v_px = 190.0F + 0.1F * (whole.keypoints[i].v_px - 190.0F);
      spot.descriptors.push_back(whole.descriptors[i]);
    }
  }
  EXPECT_GE(match_mutually(spot.descriptors, whole.descriptors, PlaceParams{}.match).size(), 60U);
  EXPECT_FALSE(compare_places(spot, whole, {}).has_value());
}

TEST(PlaceIndex, OnlyAllowedIdsAreLookedAtAndAddReplaces) {
  Rng rng(75);
  const FeatureList again = features_of(seen_again(place(1), rng));
  PlaceIndex index;
  index.add(1, features_of(place(1)));
  EXPECT_EQ(index.best_matches(again, 1).size(), 1U);
  EXPECT_TRUE(index.best_matches(again, 1, [](std::uint64_t id) { return id != 1; }).empty());
  index.add(1, features_of(place(2)));
  EXPECT_EQ(index.size(), 1U);
  EXPECT_TRUE(index.best_matches(again, 1).empty());
}

TEST(PlaceIndex, PicturesWithoutFeaturesMatchNothing) {
  PlaceIndex index;
  index.add(1, {});
  EXPECT_TRUE(index.best_matches(features_of(place(1)), 3).empty());
  EXPECT_TRUE(index.best_matches({}, 3).empty());
}

}  // namespace
}  // namespace seeker::vision
