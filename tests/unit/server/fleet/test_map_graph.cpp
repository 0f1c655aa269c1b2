#include "server/fleet/map_graph.hpp"

#include <gtest/gtest.h>

#include "server/fleet/deformed_pair.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::fleet {
namespace {

using testing::Pose2Near;

constexpr double kSigma_m = 0.03;
constexpr double kSigma_rad = 0.01;
const Matrix3 kJoint = Eigen::Vector3d(kSigma_m, kSigma_m, kSigma_rad).cwiseAbs2().asDiagonal();

/// Local maps every 5 m along a straight line, as the robot believes; `slips_at` is where its heading slips by
/// `slip_rad` without its knowing.
LineMap chain(std::uint32_t nodes, std::uint32_t slips_at = 0, double slip_rad = 0.0) {
  LineMap map;
  map.nodes.push_back({0, {}, {}});
  for (std::uint32_t id = 1; id < nodes; ++id) {
    const Pose2 step{5.0, 0.0, id == slips_at ? slip_rad : 0.0};
    map.edges.push_back({id - 1, id, step, kJoint, false, true});
    map.nodes.push_back({id, map.nodes.back().map_T_node * step, {}});
  }
  return map;
}

/// A loop closure between every second local map that says something else than the map.
void add_loops(LineMap& map, double off_m) {
  for (std::uint32_t id = 2; id < map.nodes.size(); ++id) {
    const Pose2 between = inverse(map.nodes[id - 2].map_T_node) * map.nodes[id].map_T_node;
    map.edges.push_back({id - 2, id, {between.x_m, between.y_m + off_m, between.theta_rad}, kJoint, true, true});
  }
}

/// Pairs of equal local maps of two robots that drove the same way, from `first` to before `end`.
std::vector<NodeRelation> pairs_of(std::uint32_t first, std::uint32_t end) {
  std::vector<NodeRelation> pairs;
  for (std::uint32_t id = first; id < end; ++id) {
    NodeRelation pair;
    pair.node_a = id;
    pair.node_b = id;
    pair.a_T_b.covariance = kJoint;
    pairs.push_back(pair);
  }
  return pairs;
}

TEST(VarianceFactor, IsOneForMapsThatNothingChecksOrThatAgreeWithTheirLoops) {
  LineMap map = chain(8);
  EXPECT_DOUBLE_EQ(variance_factor({&map}), 1.0);
  add_loops(map, 0.0);
  EXPECT_DOUBLE_EQ(variance_factor({&map}), 1.0);
}

TEST(VarianceFactor, RisesWithTheResidualsOfLoopsAndIsSharedByBothMaps) {
  LineMap off = chain(20);
  add_loops(off, 2.5 * kSigma_m);
  const double alone = variance_factor({&off});
  EXPECT_GT(alone, 1.2);
  LineMap right = chain(20);
  add_loops(right, 0.0);
  const double both = variance_factor({&off, &right});
  EXPECT_LE(both, alone);
  EXPECT_GE(both, 1.0);
}

TEST(DeformedPair, TwoEqualMapsNeedNoDeformation) {
  const LineMap map = chain(6);
  auto deformed = DeformedPair::make(map, map, pairs_of(0, 6), {});
  ASSERT_TRUE(deformed);
  EXPECT_NEAR(deformed->deformation().ratio(), 0.0, 1e-6);
  EXPECT_EQ(deformed->deformation().dof, 15U);
  EXPECT_NEAR(deformed->deformation().largest_rad, 0.0, 1e-6);
}

TEST(DeformedPair, AMapWhoseHeadingHasSlippedIsPutRightAndTheDeformationIsCounted) {
  constexpr double kSlip_rad = 0.04;
  const LineMap straight = chain(6);
  const LineMap slipped = chain(6, 3, kSlip_rad);
  auto deformed = DeformedPair::make(straight, slipped, pairs_of(0, 6), {});
  ASSERT_TRUE(deformed);
  EXPECT_THAT(inverse(deformed->pose_a(5)) * deformed->pose_b(5), Pose2Near(Pose2{}, 0.1, 0.02));
  EXPECT_GT(deformed->deformation().ratio(), 0.2);
  EXPECT_LT(deformed->deformation().ratio(), DeformationParams{}.max_ratio);
  EXPECT_GT(deformed->deformation().largest_rad, 0.3 * kSlip_rad);
}

TEST(DeformedPair, KnowsLocalMapsNearThePairsAndNotThoseFarFromThem) {
  const LineMap map = chain(30);
  auto deformed = DeformedPair::make(map, map, pairs_of(0, 3), {});
  ASSERT_TRUE(deformed);
  EXPECT_TRUE(deformed->certain(2, 2));
  EXPECT_TRUE(deformed->certain(3, 3));
  EXPECT_FALSE(deformed->certain(29, 29));
}

}  // namespace
}  // namespace seeker::fleet
