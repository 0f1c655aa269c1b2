#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"
#include "server/vision/sift_features.hpp"
#include "server/vision/stereo_match.hpp"

namespace seeker::vision {
namespace {

constexpr double kRowGate_px = 1.0;

Descriptor random_descriptor(Rng& rng) {
  Descriptor out;
  for (std::uint8_t& value : out) {
    value = static_cast<std::uint8_t>(rng.below(60));
  }
  return out;
}

Keypoint random_keypoint(Rng& rng) {
  // A few rows only, so that many pairs pass some of the constraints.
  return {static_cast<float>(rng.uniform(0.0, 300.0)), static_cast<float>(rng.uniform(0.0, 6.0)),
          static_cast<float>(rng.uniform(1.0, 3.0)), static_cast<float>(rng.uniform(-kPi, kPi))};
}

FeatureList random_features(std::size_t count, Rng& rng) {
  FeatureList out;
  for (std::size_t i = 0; i < count; ++i) {
    out.keypoints.push_back(random_keypoint(rng));
    out.descriptors.push_back(random_descriptor(rng));
  }
  return out;
}

/// What a right eye sees of `left`: some of it lost, some of it moved beyond the gates.
FeatureList seen_from_the_right(const FeatureList& left, Rng& rng) {
  FeatureList out;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (rng.below(5) == 0) {
      continue;
    }
    Keypoint key = left.keypoints[i];
    key.u_px -= static_cast<float>(rng.uniform(-10.0, 60.0));
    key.v_px += static_cast<float>(rng.normal(0.5));
    key.scale_px *= static_cast<float>(rng.uniform(0.6, 1.6));
    key.orientation_rad = static_cast<float>(wrap_angle(key.orientation_rad + rng.normal(0.2)));
    Descriptor seen = left.descriptors[i];
    for (std::uint8_t& value : seen) {
      value = static_cast<std::uint8_t>(std::clamp(value + rng.normal(4.0), 0.0, 255.0));
    }
    out.keypoints.push_back(key);
    out.descriptors.push_back(seen);
  }
  return out;
}

bool passes_constraints(const Keypoint& l, const Keypoint& r, const StereoMatchParams& p) {
  const double disparity = static_cast<double>(l.u_px) - static_cast<double>(r.u_px);
  const double rotation =
      std::remainder(static_cast<double>(l.orientation_rad) - static_cast<double>(r.orientation_rad), kTwoPi);
  const double scales =
      static_cast<double>(std::max(l.scale_px, r.scale_px)) / static_cast<double>(std::min(l.scale_px, r.scale_px));
  const double difference = std::abs(static_cast<double>(l.scale_px) - static_cast<double>(r.scale_px));
  return std::abs(static_cast<double>(l.v_px) - static_cast<double>(r.v_px)) < kRowGate_px &&
         disparity > p.min_disparity_px && disparity < p.max_disparity_px && std::abs(rotation) < p.max_rotation_rad &&
         (p.scale_gate_kind == ScaleGate::kRatio ? scales <= p.scale_gate : difference < p.scale_gate);
}

RC_GTEST_PROP(StereoMatch, EveryMatchPassesAllConstraints, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const FeatureList left = random_features(*rc::gen::inRange<std::size_t>(0, 120), rng);
  const FeatureList right = seen_from_the_right(left, rng);
  const StereoMatchParams params = *rc::gen::arbitrary<bool>() ? StereoMatchParams{} : paper_stereo_params().match;
  std::set<int> rights;
  for (const FeatureMatch& m : match_stereo(left, right, params, kRowGate_px)) {
    const auto l = static_cast<std::size_t>(m.first);
    const auto r = static_cast<std::size_t>(m.second);
    RC_ASSERT(passes_constraints(left.keypoints[l], right.keypoints[r], params));
    const std::uint32_t distance = descriptor_distance(left.descriptors[l], right.descriptors[r], params.metric);
    RC_ASSERT(distance <= byte_distance(params.max_distance, params.metric));
    RC_ASSERT(params.paper_uniqueness || rights.insert(m.second).second);
    for (std::size_t other = 0; other < right.size(); ++other) {
      if (other != r && passes_constraints(left.keypoints[l], right.keypoints[other], params)) {
        const auto further = descriptor_distance(left.descriptors[l], right.descriptors[other], params.metric);
        const std::uint32_t limit =
            params.paper_uniqueness ? byte_distance(params.max_distance, params.metric) : distance;
        RC_ASSERT(further > limit);
      }
    }
  }
}

TEST(StereoMatch, FindsMostOfWhatBothEyesSeeWithinTheGates) {
  Rng rng(81);
  const FeatureList left = random_features(100, rng);
  FeatureList right;
  for (std::size_t i = 0; i < left.size(); ++i) {
    Keypoint key = left.keypoints[i];
    key.u_px -= 20.0F;
    key.orientation_rad += 0.1F;
    right.keypoints.push_back(key);
    right.descriptors.push_back(left.descriptors[i]);
  }
  EXPECT_EQ(match_stereo(left, right, {}, kRowGate_px).size(), 100U);
}

TEST(StereoMatch, BestBinFirstSearchMissesOnlyWhatItDoesNotExamine) {
  Rng rng(83);
  const FeatureList left = random_features(400, rng);
  const FeatureList right = seen_from_the_right(left, rng);
  StereoMatchParams params = paper_stereo_params().match;
  const auto found = match_stereo(left, right, params, kRowGate_px);
  const auto alike = match_by_descriptor(left, right, params);
  EXPECT_GT(alike.size(), found.size()) << "the constraints drop some";
  params.bbf_leaves = 0;
  const auto exact = match_stereo(left, right, params, kRowGate_px);
  int missed = 0;
  for (const FeatureMatch& m : exact) {
    missed += std::find(found.begin(), found.end(), m) == found.end() ? 1 : 0;
  }
  EXPECT_GT(exact.size(), 20U);
  EXPECT_LE(missed, static_cast<int>(exact.size()) / 10);
}

TEST(StereoMatch, APlaceIsMatchedByWhicheverOfItsOrientationsBothEyesHave) {
  Rng rng(82);
  const Descriptor first = random_descriptor(rng);
  const Descriptor second = random_descriptor(rng);
  FeatureList left;
  left.keypoints = {{100.0F, 50.0F, 2.0F, 0.5F}, {100.0F, 50.0F, 2.0F, 2.0F}};
  left.descriptors = {first, second};
  FeatureList right;
  right.keypoints = {{80.0F, 50.0F, 2.0F, 2.1F}};
  right.descriptors = {second};
  const auto lost_first = match_stereo(left, right, {}, kRowGate_px);
  ASSERT_EQ(lost_first.size(), 1U);
  EXPECT_EQ(lost_first[0], (FeatureMatch{1, 0}));
  const auto both =
      match_stereo(left, {{{80.0F, 50.0F, 2.0F, 0.5F}, {80.0F, 50.0F, 2.0F, 2.1F}}, {first, second}}, {}, kRowGate_px);
  ASSERT_EQ(both.size(), 1U) << "one feature a place";
  EXPECT_EQ(both[0], (FeatureMatch{0, 0}));
}

}  // namespace
}  // namespace seeker::vision
