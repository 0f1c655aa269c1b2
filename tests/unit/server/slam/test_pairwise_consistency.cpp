#include "server/slam/pairwise_consistency.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::slam {
namespace {

using testing::Pose2Near;

const Matrix3 kStep = Eigen::Vector3d(4e-4, 4e-4, 1e-4).asDiagonal();
const Matrix3 kSeen = Eigen::Vector3d(4e-4, 4e-4, 1e-4).asDiagonal();

/// A trajectory round a block with its odometry, and loops seen in it.
struct Walk {
  std::vector<Pose2> truth;
  std::vector<UncertainPose> steps;

  Walk(std::size_t nodes, Rng& rng) {
    const Pose2 step{0.5, 0.0, kTwoPi / 40.0};
    for (std::size_t k = 0; k < nodes; ++k) {
      truth.push_back(k == 0 ? Pose2{} : truth.back() * step);
      if (k > 0) {
        steps.push_back({{step.x_m + rng.normal(0.02), rng.normal(0.02), step.theta_rad + rng.normal(0.01)}, kStep});
      }
    }
  }
  [[nodiscard]] LoopEdge loop(std::size_t a, std::size_t b, Rng& rng) const {
    const Pose2 p = inverse(truth[a]) * truth[b];
    return {a, b, {{p.x_m + rng.normal(0.02), p.y_m + rng.normal(0.02), p.theta_rad + rng.normal(0.01)}, kSeen}};
  }
};

TEST(OdometryChain, BetweenIsTheCompositionOfTheSteps) {
  Rng rng(1);
  const Walk walk(60, rng);
  const OdometryChain chain(walk.steps);
  ASSERT_EQ(chain.size(), 60U);
  UncertainPose direct;
  for (std::size_t k = 10; k < 45; ++k) {
    direct = compose(direct, walk.steps[k]);
  }
  EXPECT_THAT(chain.between(10, 45).a_T_b, Pose2Near(direct.a_T_b, 1e-9, 1e-9));
  EXPECT_LT((chain.between(10, 45).covariance - direct.covariance).norm(), 1e-9);
  EXPECT_THAT(chain.between(45, 10).a_T_b, Pose2Near(inverse(direct.a_T_b), 1e-9, 1e-9));
  EXPECT_LT((chain.between(45, 10).covariance - invert(direct).covariance).norm(), 1e-9);
  EXPECT_EQ(chain.between(7, 7).covariance.norm(), 0.0);
}

TEST(PairwiseConsistency, TrueLoopsPassTheGateAsOftenAsItSays) {
  int passed = 0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    Rng rng(static_cast<std::uint64_t>(run));
    const Walk walk(90, rng);
    const OdometryChain chain(walk.steps);
    const auto odometry = [&](std::size_t i, std::size_t j) { return chain.between(i, j); };
    passed += cycle_chi2(walk.loop(3, 43, rng), walk.loop(15, 57, rng), odometry) <= ConsistencyParams{}.gate_chi2;
  }
  EXPECT_GT(passed, 0.97 * kRuns);
}

TEST(PairwiseConsistency, TheTrueLoopsAreFoundAmongFalseOnes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    const Walk walk(120, rng);
    const OdometryChain chain(walk.steps);
    std::vector<LoopEdge> candidates;
    for (std::size_t k = 0; k < 8; ++k) {
      candidates.push_back(walk.loop(2 * k, 40 + 2 * k + k % 3, rng));
    }
    for (std::size_t k = 0; k < 20; ++k) {
      const Pose2 p{rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0), rng.uniform(-kPi, kPi)};
      candidates.push_back({k, 90 + k, {p, kSeen}});
    }
    const auto set =
        largest_consistent_set(candidates, [&](std::size_t i, std::size_t j) { return chain.between(i, j); });
    EXPECT_TRUE(set.exact);
    const auto honest = std::count_if(set.members.begin(), set.members.end(), [](std::size_t i) { return i < 8; });
    EXPECT_GE(honest, 6) << "seed " << seed;
    EXPECT_LE(set.members.size() - static_cast<std::size_t>(honest), 1U) << "seed " << seed;
    EXPECT_LT(set.rival_size, 5U) << "seed " << seed;
  }
}

TEST(PairwiseConsistency, TwoStoriesOfEqualSizeAreRivals) {
  Rng rng(7);
  const Walk walk(100, rng);
  const OdometryChain chain(walk.steps);
  std::vector<LoopEdge> candidates;
  for (std::size_t k = 0; k < 3; ++k) {
    const LoopEdge loop = walk.loop(5 * k, 40 + 5 * k, rng);
    candidates.push_back(loop);
    // The same loops, all of them shifted in the frame of the lap: a room that looks like the next one.
    const Pose2 shifted = inverse(walk.truth[5 * k]) * Pose2{6.0, 0.0, 0.0} * walk.truth[40 + 5 * k];
    candidates.push_back({loop.a, loop.b, {shifted, kSeen}});
  }
  const auto set =
      largest_consistent_set(candidates, [&](std::size_t i, std::size_t j) { return chain.between(i, j); });
  EXPECT_EQ(set.members.size(), 3U);
  EXPECT_EQ(set.rival_size, 3U);
}

TEST(PairwiseConsistency, LoopsOfOneViewCountOnceAndFollowWhenOthersAgree) {
  Rng rng(3);
  const Walk walk(90, rng);
  const OdometryChain chain(walk.steps);
  const auto odometry = [&](std::size_t i, std::size_t j) { return chain.between(i, j); };
  // One view of node 60, compared with three others, is wrong by the same displacement each time.
  std::vector<LoopEdge> candidates;
  for (const std::size_t old : {18U, 19U, 20U}) {
    LoopEdge lie = walk.loop(old, 60, rng);
    lie.a_T_b.a_T_b = lie.a_T_b.a_T_b * Pose2{2.0, 0.0, 0.0};
    candidates.push_back(lie);
  }
  std::vector<std::size_t> view{0, 0, 0};
  const auto apart = [&](std::size_t i, std::size_t j) { return view[i] != view[j]; };
  EXPECT_EQ(largest_consistent_set(candidates, odometry).members.size(), 3U) << "where all count";
  EXPECT_EQ(largest_consistent_set(candidates, odometry, {}, apart).members.size(), 1U);
  candidates.push_back(walk.loop(21, 62, rng));
  candidates.push_back(walk.loop(24, 65, rng));
  candidates.push_back(walk.loop(25, 65, rng));
  view.insert(view.end(), {1, 2, 2});
  const ConsistentSet set = largest_consistent_set(candidates, odometry, {}, apart);
  ASSERT_EQ(set.members.size(), 2U);
  EXPECT_EQ(set.members.front(), 3U);
  EXPECT_EQ(set.rival_size, 1U) << "the lies are one story of one view";
  ASSERT_EQ(set.followers.size(), 1U);
  EXPECT_EQ(set.members.back() + set.followers.front(), 4U + 5U) << "one of the last two, the other follows";
}

TEST(PairwiseConsistency, NothingAndOneAreTheirOwnAnswer) {
  const RelativePose still = [](std::size_t, std::size_t) { return UncertainPose{}; };
  EXPECT_TRUE(largest_consistent_set({}, still).members.empty());
  const auto one = largest_consistent_set({LoopEdge{0, 1, {{}, kSeen}}}, still);
  EXPECT_EQ(one.members, std::vector<std::size_t>{0});
  EXPECT_EQ(one.rival_size, 0U);
}

TEST(PairwiseConsistency, ACutSearchSaysSoAndStillGivesAConsistentSet) {
  Rng rng(9);
  std::vector<LoopEdge> candidates;
  for (std::size_t k = 0; k < 60; ++k) {
    candidates.push_back({0, 1, {{rng.uniform(-0.1, 0.1), 0.0, 0.0}, kSeen}});
  }
  const RelativePose still = [](std::size_t, std::size_t) { return UncertainPose{}; };
  ConsistencyParams params;
  params.max_search = 70;
  const auto set = largest_consistent_set(candidates, still, params);
  EXPECT_FALSE(set.exact);
  ASSERT_GT(set.members.size(), 5U);
  for (const std::size_t i : set.members) {
    for (const std::size_t j : set.members) {
      EXPECT_LE(cycle_chi2(candidates[i], candidates[j], still), params.gate_chi2);
    }
  }
  EXPECT_GE(largest_consistent_set(candidates, still).members.size(), set.members.size());
}

}  // namespace
}  // namespace seeker::slam
