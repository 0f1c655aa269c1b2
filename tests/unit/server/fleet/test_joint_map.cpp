#include "server/fleet/joint_map.hpp"

#include <gtest/gtest.h>

#include "server/slam/covariance.hpp"
#include "tests/support/maps/random_map.hpp"
#include "tests/support/matchers.hpp"
#include "toy_maps.hpp"

namespace seeker::fleet {
namespace {

using testing::Pose2Near;

/// A map of local maps along a line, `step` apart, with a segment in each.
LineMap chain(std::size_t nodes, const Pose2& step) {
  LineMap map;
  for (std::uint32_t k = 0; k < nodes; ++k) {
    map.nodes.push_back({k, k == 0 ? Pose2{} : map.nodes.back().map_T_node * step, {}});
    if (k > 0) {
      map.edges.push_back({k - 1, k, step, slam::with_floor(Matrix3::Zero(), 0.05, 0.02), false, true});
    }
    MapSegment segment;
    segment.id = map.next_id++;
    segment.node = k;
    segment.map_T_segment = map.nodes.back().map_T_node * Pose2{1.0, 0.5, 0.2};
    segment.length_m = 1.0;
    map.segments.push_back(segment);
  }
  return map;
}

NodeRelation pair_of(std::uint32_t a, std::uint32_t b, const Pose2& a_T_b) {
  NodeRelation pair;
  pair.node_a = a;
  pair.node_b = b;
  pair.a_T_b = {a_T_b, slam::with_floor(Matrix3::Zero(), 0.03, 0.01)};
  return pair;
}

const Pose2 kStep{2.0, 0.0, 0.0};
const Pose2 kBeside{0.0, 1.0, 0.3};

TEST(JointMapIds, HoldTheRobotAndItsOwnId) {
  EXPECT_EQ(joint_node_id(0, 17), 17U);
  EXPECT_EQ(joint_segment_id(0, 17), 17U);
  EXPECT_EQ(origin_of_node(joint_node_id(3, 17)), (Origin{3, 17}));
  EXPECT_EQ(origin_of_segment(joint_segment_id(255, kMaxJointSegments - 1)), (Origin{255, kMaxJointSegments - 1}));
}

TEST(JointMap, PutsTheOtherRobotWhereTheRelationsSayAndKeepsTheMainOnesFrame) {
  const LineMap a = chain(4, kStep);
  const LineMap b = chain(3, kStep);
  const auto joint = join({{0, &a}, {2, &b}}, {{0, 2, {pair_of(1, 0, kBeside)}}}, 7);
  ASSERT_TRUE(joint) << joint.error().message;
  EXPECT_TRUE(validate(joint->map)) << validate(joint->map).error().message;
  EXPECT_EQ(joint->map.epoch, 7U);
  EXPECT_THAT(joint->robots.at(0).joint_T_map, Pose2Near(Pose2{}, 1e-6, 1e-6));
  EXPECT_THAT(joint->robots.at(2).joint_T_map, Pose2Near(kStep * kBeside, 1e-6, 1e-6));
  EXPECT_EQ(joint->map.nodes.size(), 7U);
  EXPECT_EQ(joint->map.segments.size(), 7U);
  // Segments moved with their local maps and say whose they are.
  const MapSegment& moved = joint->map.segments.back();
  EXPECT_EQ(origin_of_segment(moved.id), (Origin{2, b.segments.back().id}));
  EXPECT_EQ(origin_of_node(moved.node), (Origin{2, b.segments.back().node}));
  EXPECT_THAT(moved.map_T_segment, Pose2Near(kStep * kBeside * b.segments.back().map_T_segment, 1e-6, 1e-6));
}

TEST(JointMap, CarriesPosesOfRobotsAndGoalsThereAndBack) {
  const LineMap a = chain(4, kStep);
  const LineMap b = chain(3, kStep);
  const auto joint = join({{0, &a}, {1, &b}}, {{0, 1, {pair_of(1, 0, kBeside)}}}, 1);
  ASSERT_TRUE(joint);
  const Pose2 own{3.1, -0.4, 1.0};
  const Pose2 there = joint->robots.at(1).to_joint(own);
  EXPECT_THAT(there, Pose2Near(kStep * kBeside * own, 1e-6, 1e-6));
  EXPECT_THAT(joint->robots.at(1).from_joint(there), Pose2Near(own, 1e-6, 1e-6));
}

TEST(JointMap, RelationsAtBothEndsTakeTheDistortionOutOfAMap) {
  const LineMap a = chain(6, kStep);
  const LineMap distorted = chain(6, kStep * Pose2{0.0, 0.0, 0.02});
  const auto joint =
      join({{0, &a}, {1, &distorted}}, {{0, 1, {pair_of(0, 0, {}), pair_of(3, 3, {}), pair_of(5, 5, {})}}}, 1);
  ASSERT_TRUE(joint);
  for (std::uint32_t k = 0; k < 6; ++k) {
    const JointRobot::Node& node = joint->robots.at(1).nodes.at(k);
    EXPECT_THAT(node.joint_T_node, Pose2Near(joint->robots.at(0).nodes.at(k).joint_T_node, 0.06, 0.03)) << k;
  }
  EXPECT_TRUE(joint->switched_off.empty());
}

TEST(JointMap, APairThatLiesIsOutvotedAndNamed) {
  const LineMap a = chain(6, kStep);
  const LineMap b = chain(6, kStep);
  const Pose2 left{0.0, 1.0, 0.0};
  std::vector<NodeRelation> pairs;
  for (std::uint32_t k = 0; k < 5; ++k) {
    pairs.push_back(pair_of(k, k, left));
  }
  pairs.insert(pairs.begin() + 2, pair_of(4, 1, inverse(kStep * kStep * kStep) * left * Pose2{0.9, -0.2, 0.4}));
  const auto joint = join({{0, &a}, {1, &b}}, {{0, 1, pairs}}, 1);
  ASSERT_TRUE(joint);
  ASSERT_EQ(joint->switched_off.size(), 1U);
  EXPECT_EQ(joint->switched_off.front().pair, 2U);
  EXPECT_THAT(joint->robots.at(1).nodes.at(2).joint_T_node, Pose2Near(kStep * kStep * left, 0.1, 0.05));
}

TEST(JointMap, LeavingTheRelationOutIsTheUndo) {
  const LineMap a = chain(4, kStep);
  const LineMap b = chain(3, kStep);
  const LineMap a_before = a;
  const LineMap b_before = b;
  const auto alone = join({{0, &a}, {1, &b}}, {}, 1);
  ASSERT_TRUE(join({{0, &a}, {1, &b}}, {{0, 1, {pair_of(1, 0, kBeside)}}}, 2));
  const auto after = join({{0, &a}, {1, &b}}, {}, 1);
  ASSERT_TRUE(alone && after);
  EXPECT_EQ(a, a_before);
  EXPECT_EQ(b, b_before);
  EXPECT_EQ(after->map, alone->map);
  EXPECT_EQ(after->map.nodes, a.nodes);
  EXPECT_FALSE(after->robots.contains(1));
}

TEST(JointMap, ReachesARobotOverAnother) {
  const LineMap map = chain(3, kStep);
  const auto joint = join({{0, &map}, {1, &map}, {2, &map}},
                          {{2, 1, {pair_of(0, 0, inverse(kBeside))}}, {0, 1, {pair_of(0, 0, kBeside)}}}, 1);
  ASSERT_TRUE(joint);
  EXPECT_THAT(joint->robots.at(2).joint_T_map, Pose2Near(kBeside * kBeside, 1e-6, 1e-6));
}

TEST(JointMap, OneLocalMapAloneIsAMap) {
  const LineMap map = chain(1, kStep);
  const auto joint = join({{0, &map}}, {}, 3);
  ASSERT_TRUE(joint);
  EXPECT_EQ(joint->map.nodes, map.nodes);
}

TEST(JointMap, CanBeCarriedOnByOneRobotAndJoinedAgain) {
  const LineMap a = chain(4, kStep);
  const LineMap b = chain(3, kStep);
  const auto joint = join({{0, &a}, {2, &b}}, {{0, 2, {pair_of(1, 0, kBeside)}}}, 7);
  ASSERT_TRUE(joint) << joint.error().message;
  EXPECT_FALSE(join({{0, &joint->map}}, {}, 8)) << "its ids name robots";
  const LineMap one = as_one_robots(joint->map);
  ASSERT_TRUE(validate(one)) << validate(one).error().message;
  ASSERT_EQ(one.nodes.size(), joint->map.nodes.size());
  for (std::size_t k = 0; k < one.nodes.size(); ++k) {
    EXPECT_EQ(one.nodes[k].id, k);
    EXPECT_EQ(one.nodes[k].map_T_node, joint->map.nodes[k].map_T_node);
  }
  ASSERT_EQ(one.segments.size(), joint->map.segments.size());
  EXPECT_EQ(one.segments.back().node, 6U);
  EXPECT_EQ(one.next_id, 8U);
  const auto again = join({{0, &one}, {1, &b}}, {{0, 1, {pair_of(6, 0, kBeside)}}}, 8);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->map.nodes.size(), 10U);
  EXPECT_EQ(as_one_robots(a), a);
}

TEST(JointMap, RefusesWhatCannotBeJoined) {
  const LineMap map = chain(2, kStep);
  const LineMap empty;
  EXPECT_EQ(join({}, {}, 1).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(join({{0, &empty}}, {}, 1).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(join({{0, &map}, {0, &empty}}, {}, 1).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(join({{1, &map}, {0, &map}}, {}, 1).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(join({{0, &map}}, {{0, 1, {pair_of(0, 0, {})}}}, 1).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(join({{0, &map}, {1, &map}}, {{0, 1, {pair_of(0, 9, {})}}}, 1).error().code, Errc::kInvalidArgument);
  LineMap large = map;
  large.next_id = kMaxJointSegments + 1;
  EXPECT_EQ(join({{0, &large}}, {}, 1).error().code, Errc::kTooLarge);
}

}  // namespace
}  // namespace seeker::fleet
