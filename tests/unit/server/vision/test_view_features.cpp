#include "server/vision/view_features.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"

namespace seeker::vision {
namespace {

Descriptor random_descriptor(Rng& rng) {
  Descriptor descriptor;
  for (std::uint8_t& byte : descriptor) {
    byte = static_cast<std::uint8_t>(rng.uniform(0.0, 120.0));
  }
  return descriptor;
}

/// What a robot with this heading sees of things all around, `first` of which are the same for each `seed`.
ViewFeatures view(std::uint64_t seed, double heading_rad, int count = 60) {
  Rng rng(seed);
  ViewFeatures features;
  for (int k = 0; k < count; ++k) {
    features.bearings_rad.push_back(static_cast<float>(wrap_angle(rng.uniform(-kPi, kPi) - heading_rad)));
    features.descriptors.push_back(random_descriptor(rng));
  }
  return features;
}

TEST(MatchViews, SaysTheRotationBetweenTwoHeadings) {
  for (const double rotation_rad : {0.0, 1.0, 3.1, -3.1, -2.0}) {
    const auto match = match_views(view(1, 0.3), view(1, 0.3 + rotation_rad), {});
    ASSERT_TRUE(match);
    EXPECT_EQ(match->matches, 60);
    EXPECT_EQ(match->agreeing, 60);
    EXPECT_NEAR(wrap_angle(match->rotation_rad - rotation_rad), 0.0, 1e-6);
  }
}

TEST(MatchViews, DoesNotTakeOnePlaceForAnother) { EXPECT_FALSE(match_views(view(1, 0.0), view(2, 0.0), {})); }

TEST(MatchViews, WantsAsManyMatchesAsThePaper) {
  ViewFeatures few = view(1, 0.0);
  few.bearings_rad.resize(19);
  few.descriptors.resize(19);
  EXPECT_FALSE(match_views(view(1, 0.0), few, {}));
  ViewMatchParams fewer;
  fewer.min_matches = 19;
  EXPECT_TRUE(match_views(view(1, 0.0), few, fewer));
}

TEST(MatchViews, RefusesMatchesThatAgreeOnNoRotation) {
  ViewFeatures shuffled = view(1, 0.0);
  Rng rng(7);
  for (float& bearing : shuffled.bearings_rad) {
    bearing = static_cast<float>(rng.uniform(-kPi, kPi));
  }
  EXPECT_FALSE(match_views(view(1, 0.0), shuffled, {}));
  ViewMatchParams printed;  // which goes by their number alone
  printed.min_agreement = 0.0;
  printed.min_agreeing = 0;
  EXPECT_TRUE(match_views(view(1, 0.0), shuffled, printed));
}

TEST(ViewFeatureExtractor, RefusesAPictureOfAnotherSize) {
  ViewParams params;
  params.omni.emplace();
  EXPECT_EQ(ViewFeatureExtractor(params, {}).extract(Image(10, 10, 1)).error().code, Errc::kInvalidArgument);
}

}  // namespace
}  // namespace seeker::vision
