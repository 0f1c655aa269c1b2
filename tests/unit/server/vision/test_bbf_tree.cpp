#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"
#include "server/vision/bbf_tree.hpp"

namespace seeker::vision {
namespace {

std::vector<Descriptor> random_descriptors(std::size_t count, Rng& rng, std::uint64_t below) {
  std::vector<Descriptor> out(count);
  for (Descriptor& d : out) {
    for (std::uint8_t& value : d) {
      value = static_cast<std::uint8_t>(rng.below(below));
    }
  }
  return out;
}

/// `original` with some noise, as another view of the same place gives it.
Descriptor seen_again(const Descriptor& original, double sigma, Rng& rng) {
  Descriptor out;
  for (std::size_t k = 0; k < kDescriptorSize; ++k) {
    out[k] = static_cast<std::uint8_t>(std::clamp(original[k] + rng.normal(sigma), 0.0, 255.0));
  }
  return out;
}

RC_GTEST_PROP(BbfTree, WithLeavesEnoughItIsExact, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const auto below = *rc::gen::element<std::uint64_t>(2, 20, 256);
  const auto candidates = random_descriptors(*rc::gen::inRange<std::size_t>(0, 200), rng, below);
  const auto queries = random_descriptors(3, rng, below);
  const Metric metric = *rc::gen::element(Metric::kL1, Metric::kL2);
  const BbfTree tree(candidates, metric, {.max_leaves = 1000, .leaf_size = *rc::gen::inRange(1, 9)});
  const auto found = tree.nearest_two(queries);
  const auto exact = nearest_two(queries, candidates, metric);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    RC_ASSERT(found[i].best_distance == exact[i].best_distance);
    RC_ASSERT(found[i].second_distance == exact[i].second_distance);
  }
}

RC_GTEST_PROP(BbfTree, WhatItNamesHasTheDistanceItTells, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const auto candidates = random_descriptors(*rc::gen::inRange<std::size_t>(2, 300), rng, 256);
  const auto queries = random_descriptors(3, rng, 256);
  const Metric metric = *rc::gen::element(Metric::kL1, Metric::kL2);
  const BbfTree tree(candidates, metric, {.max_leaves = 5});
  const auto found = tree.nearest_two(queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    RC_ASSERT(found[i].best != found[i].second);
    RC_ASSERT(found[i].best_distance <= found[i].second_distance);
    const auto of = [&](std::int32_t k) {
      return descriptor_distance(queries[i], candidates[static_cast<std::size_t>(k)], metric);
    };
    RC_ASSERT(of(found[i].best) == found[i].best_distance);
    RC_ASSERT(of(found[i].second) == found[i].second_distance);
  }
}

RC_GTEST_PROP(BbfTree, WithLeavesEnoughAllWithinARadiusAreFound, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const auto candidates = random_descriptors(*rc::gen::inRange<std::size_t>(0, 200), rng, 60);
  const auto queries = random_descriptors(1, rng, 60);
  const auto radius = *rc::gen::inRange<std::uint32_t>(1500, 3500);
  std::vector<NearCandidate> wanted;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const std::uint32_t distance = descriptor_distance(queries[0], candidates[k], Metric::kL1);
    if (distance <= radius) {
      wanted.push_back({static_cast<std::int32_t>(k), distance});
    }
  }
  RC_ASSERT(BbfTree(candidates, Metric::kL1, {.max_leaves = 1000}).within(queries[0], radius) == wanted);
}

TEST(BbfTree, WithFewLeavesOnlySomeAreExamined) {
  Rng rng(43);
  const auto candidates = random_descriptors(500, rng, 120);
  const BbfTree tree(candidates, Metric::kL1, {.max_leaves = 20});
  EXPECT_EQ(tree.within(candidates[7], NearestTwo::kFar - 1).size(), 20U);
  EXPECT_EQ(nearest_two({&candidates[7], 1}, candidates, Metric::kL1, 20)[0].best, 7);
  EXPECT_EQ(nearest_two({&candidates[7], 1}, candidates, Metric::kL1, 0),
            nearest_two({&candidates[7], 1}, candidates, Metric::kL1));
}

TEST(BbfTree, FindsAlmostAllThatIsSeenAgain) {
  Rng rng(41);
  const auto candidates = random_descriptors(2000, rng, 120);
  std::vector<Descriptor> queries;
  for (std::size_t i = 0; i < 200; ++i) {
    queries.push_back(seen_again(candidates[i * 10], 10.0, rng));
  }
  const auto found = BbfTree(candidates, Metric::kL1).nearest_two(queries);
  int right = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    right += found[i].best == static_cast<std::int32_t>(i * 10) ? 1 : 0;
  }
  EXPECT_GE(right, 180);
}

TEST(BbfTree, EqualDescriptorsAndNoneAreNoTrouble) {
  const std::vector<Descriptor> same(50, Descriptor{});
  const auto found = BbfTree(same, Metric::kL2).nearest_two({same.data(), 1});
  EXPECT_EQ(found[0].best_distance, 0U);
  EXPECT_EQ(found[0].second_distance, 0U);
  EXPECT_EQ(BbfTree({}, Metric::kL2).nearest_two({same.data(), 1})[0], NearestTwo{});
}

}  // namespace
}  // namespace seeker::vision
