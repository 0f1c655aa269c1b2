#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"
#include "server/vision/feature_match.hpp"
#include "server/vision/nearest_kernel.hpp"

namespace seeker::vision {
namespace {

Descriptor random_descriptor(Rng& rng, std::uint64_t below = 256) {
  Descriptor out;
  for (std::uint8_t& value : out) {
    value = static_cast<std::uint8_t>(rng.below(below));
  }
  return out;
}

std::vector<Descriptor> random_descriptors(std::size_t count, Rng& rng, std::uint64_t below = 256) {
  std::vector<Descriptor> out(count);
  for (Descriptor& d : out) {
    d = random_descriptor(rng, below);
  }
  return out;
}

/// The definition, by sorting all distances.
NearestTwo by_sorting(const Descriptor& query, const std::vector<Descriptor>& candidates, Metric metric) {
  std::vector<std::pair<std::uint32_t, std::int32_t>> all;
  for (const Descriptor& candidate : candidates) {
    std::uint32_t sum = 0;
    for (std::size_t k = 0; k < kDescriptorSize; ++k) {
      const int difference = int{query[k]} - int{candidate[k]};
      sum += static_cast<std::uint32_t>(metric == Metric::kL1 ? std::abs(difference) : difference * difference);
    }
    all.emplace_back(sum, static_cast<std::int32_t>(all.size()));
  }
  std::sort(all.begin(), all.end());
  NearestTwo out;
  if (!all.empty()) {
    out.best = all[0].second;
    out.best_distance = all[0].first;
  }
  if (all.size() > 1) {
    out.second = all[1].second;
    out.second_distance = all[1].first;
  }
  return out;
}

RC_GTEST_PROP(NearestTwo, EveryBodyGivesWhatSortingGives, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  // Values below 2 and 3 make ties.
  const auto below = *rc::gen::element<std::uint64_t>(2, 3, 20, 256);
  const auto candidates = random_descriptors(*rc::gen::inRange<std::size_t>(0, 200), rng, below);
  const auto queries = random_descriptors(*rc::gen::inRange<std::size_t>(0, 5), rng, below);
  const Metric metric = *rc::gen::element(Metric::kL1, Metric::kL2);
  for (const NearestKernels& kernels : nearest_kernels()) {
    const auto found = nearest_two_with(kernels, queries, candidates, metric);
    RC_ASSERT(found.size() == queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
      RC_ASSERT(found[i] == by_sorting(queries[i], candidates, metric));
    }
  }
}

TEST(NearestTwo, ExtremeDescriptorsDoNotOverflow) {
  Descriptor black{};
  Descriptor white;
  white.fill(255);
  for (const NearestKernels& kernels : nearest_kernels()) {
    const std::vector<Descriptor> query{black};
    const std::vector<Descriptor> candidates{white, white, white};
    const auto l1 = nearest_two_with(kernels, query, candidates, Metric::kL1);
    const auto l2 = nearest_two_with(kernels, query, candidates, Metric::kL2);
    EXPECT_EQ(l1[0], (NearestTwo{0, 128U * 255U, 1, 128U * 255U})) << kernels.name;
    EXPECT_EQ(l2[0], (NearestTwo{0, 128U * 255U * 255U, 1, 128U * 255U * 255U})) << kernels.name;
  }
}

TEST(NearestTwo, ThePlainBodyIsAlwaysThere) {
  EXPECT_STREQ(nearest_kernels().back().name, "plain");
  for (const NearestKernels& kernels : nearest_kernels()) {
    std::printf("body: %s\n", kernels.name);
  }
}

RC_GTEST_PROP(MutualMatches, AreOneToOneAndEachOthersBest, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const auto first = random_descriptors(*rc::gen::inRange<std::size_t>(0, 60), rng);
  auto second = random_descriptors(*rc::gen::inRange<std::size_t>(0, 60), rng);
  second.insert(second.end(), first.begin(), first.begin() + static_cast<std::ptrdiff_t>(first.size() / 2));
  const Metric metric = *rc::gen::element(Metric::kL1, Metric::kL2);
  const auto matches = match_mutually(first, second, {.metric = metric, .max_distance = 100.0, .max_ratio = 1.0});
  RC_ASSERT(matches.size() >= first.size() / 2);
  std::vector<int> used(second.size(), 0);
  for (const FeatureMatch& m : matches) {
    RC_ASSERT(++used[static_cast<std::size_t>(m.second)] == 1);
    RC_ASSERT(by_sorting(first[static_cast<std::size_t>(m.first)], second, metric).best == m.second);
    RC_ASSERT(by_sorting(second[static_cast<std::size_t>(m.second)], first, metric).best == m.first);
  }
}

TEST(MutualMatches, AFeatureThatIsThereTwiceMatchesNothing) {
  Rng rng(5);
  const std::vector<Descriptor> first{random_descriptor(rng)};
  const std::vector<Descriptor> twice{first[0], first[0]};
  EXPECT_EQ(match_mutually(first, first, {}).size(), 1U);
  EXPECT_TRUE(match_mutually(first, twice, {}).empty());
}

TEST(MutualMatches, NothingBeyondTheGateOfDistance) {
  Descriptor a{};
  Descriptor b{};
  b[0] = 100;
  const std::vector<Descriptor> first{a};
  const std::vector<Descriptor> second{b};
  const double apart = 100.0 / kDescriptorUnit;
  for (const Metric metric : {Metric::kL1, Metric::kL2}) {
    EXPECT_DOUBLE_EQ(unit_distance(descriptor_distance(a, b, metric), metric), apart);
    EXPECT_EQ(match_mutually(first, second, {.metric = metric, .max_distance = apart + 0.001}).size(), 1U);
    EXPECT_TRUE(match_mutually(first, second, {.metric = metric, .max_distance = apart - 0.001}).empty());
  }
}

}  // namespace
}  // namespace seeker::vision
