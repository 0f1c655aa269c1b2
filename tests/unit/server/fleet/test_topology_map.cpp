#include <algorithm>

#include <gtest/gtest.h>

#include "server/fleet/topology_map.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::fleet {
namespace {

using seeker::testing::Point2Near;

const Corridors kOpen{[](const Point2&, const Point2&, double) { return Corridor::kFree; }};
const Corridors kUnseen{[](const Point2&, const Point2&, double) { return Corridor::kUnknown; }};
/// A wall along x = 0.
const Corridors kWall{[](const Point2& a, const Point2& b, double) {
  return a.x() * b.x() < 0.0 ? Corridor::kBlocked : Corridor::kFree;
}};

TopologyNode node(std::uint64_t id, const Point2& p, std::vector<Point2> goals = {}) {
  TopologyNode made;
  made.id = id;
  made.map_T_base = {p.x(), p.y(), 0.0};
  for (const Point2& goal : goals) {
    made.goals.push_back({100 * id + made.goals.size() + 1, goal, 1});
  }
  return made;
}

SpaceTree tree_with(const std::vector<Point2>& goals_base) {
  SpaceTree tree;
  for (const Point2& p : goals_base) {
    tree.goals.push_back({p, 3, 0});
  }
  return tree;
}

int rule_for(const Point2& p, const std::vector<TopologyNode>& others_nodes, const Corridors& corridors,
             const Point2& present = {5.0, 0.0}) {
  const TopologyNode here = node(9, present);
  Topology own;
  own.nodes = others_nodes;
  own.nodes.push_back(here);
  return apply_rules({{p, 1, 0}}, {here, own, {}, {}, corridors}).front().rule;
}

TEST(NodeRules, OneDropsWhatIsTooCloseToThePresentNode) {
  EXPECT_EQ(rule_for({6.9, 0.0}, {}, kOpen), 1);
  EXPECT_EQ(rule_for({7.1, 0.0}, {}, kOpen), 0);
}

TEST(NodeRules, TwoDropsWhatLiesInTheRegionOfAnotherNode) {
  EXPECT_EQ(rule_for({1.5, 0.0}, {node(1, {0.1, 0.0})}, kWall), 2);
  EXPECT_EQ(rule_for({2.5, 0.0}, {node(1, {0.1, 0.0})}, kWall), 0);
}

TEST(NodeRules, FourKeepsWhatIsNearANodeButWalledOff) {
  EXPECT_EQ(rule_for({1.0, 0.0}, {node(1, {-0.5, 0.0})}, kWall), 4);
  // Another node on this side still takes it.
  EXPECT_EQ(rule_for({1.0, 0.0}, {node(1, {-0.5, 0.0}), node(2, {1.0, 1.0})}, kWall), 2);
}

TEST(NodeRules, ThreeDropsWhatDuplicatesAPendingGoal) {
  EXPECT_EQ(rule_for({1.0, 0.0}, {node(1, {1.0, -8.0}, {{1.0, 1.5}})}, kOpen), 3);
  EXPECT_EQ(rule_for({1.0, 0.0}, {node(1, {1.0, -8.0}, {{1.0, 2.5}})}, kOpen), 0);
  // A goal beyond a wall is of another room.
  EXPECT_EQ(rule_for({1.0, 0.0}, {node(1, {-8.0, 0.0}, {{-0.5, 0.0}})}, kWall), 0);
}

TEST(NodeRules, ThreeLeavesTheOutermostOfNewGoals) {
  const TopologyNode here = node(9, {0.0, 0.0});
  const auto ruled = apply_rules({{{5.0, 0.0}, 3, 0}, {{5.0, 1.0}, 6, 0}}, {here, {}, {}, {}, kOpen});
  EXPECT_EQ(ruled[0].layer, 6);
  EXPECT_TRUE(ruled[0].kept());
  EXPECT_EQ(ruled[1].rule, 3);
}

TEST(NodeRules, HoldForNodesAndGoalsOfOtherRobots) {
  const TopologyNode here = node(1, {0.0, 0.0});
  RobotTopology other;
  other.topology.nodes = {node(1, {6.0, 0.0}, {{9.0, 6.0}})};
  other.topology.nodes.front().sectors = {{Point2::Zero(), -kPi, kTwoPi, 3.0}};
  const auto ruled =
      apply_rules({{{5.0, 0.5}, 1, 0}, {{8.5, 6.5}, 1, 0}, {{0.0, 6.0}, 1, 0}}, {here, {}, {other}, {}, kUnseen});
  ASSERT_EQ(ruled.size(), 3U);
  const auto rule_at = [&](const Point2& p) {
    return std::find_if(ruled.begin(), ruled.end(), [&](const RuledGoal& g) { return g.p_map == p; })->rule;
  };
  EXPECT_EQ(rule_at({5.0, 0.5}), 2);  // by the other's own tree: this robot has never seen the place
  EXPECT_EQ(rule_at({8.5, 6.5}), 3);
  EXPECT_EQ(rule_at({0.0, 6.0}), 0);
}

TEST(Joined, TrustsTheNodesOwnTreeWhereTheMapKnowsNothing) {
  TopologyNode turned = node(1, {1.0, 1.0});
  turned.map_T_base.theta_rad = kPi / 2.0;
  turned.sectors = {{Point2::Zero(), -0.2, 0.4, 3.0}};
  EXPECT_TRUE(joined(turned, {1.0, 3.5}, kUnseen));
  EXPECT_FALSE(joined(turned, {1.0, 4.5}, kUnseen));
  EXPECT_FALSE(joined(turned, {3.0, 1.0}, kUnseen));
  EXPECT_TRUE(joined(turned, {3.0, 1.0}, kOpen));
}

TEST(TopologyMap, FiveBindsPendingGoalsToTheNearerNode) {
  TopologyMap map({});
  (void)map.create({0.0, 0.0, 0.0}, tree_with({{8.0, 3.0}, {-6.0, 0.0}}), {}, kOpen);
  ASSERT_EQ(map.current()->goals.size(), 2U);
  (void)map.create({5.0, 0.0, 0.0}, {}, {}, kOpen);
  ASSERT_EQ(map.current()->goals.size(), 1U);
  EXPECT_THAT(map.current()->goals.front().p_map, Point2Near(Point2(8.0, 3.0), 1e-9));
  EXPECT_EQ(map.find(1)->goals.size(), 1U);
}

TEST(TopologyMap, FiveLeavesGoalsBehindAWallWhereTheyAre) {
  TopologyMap map({});
  (void)map.create({-5.0, 0.0, 0.0}, tree_with({{4.0, 3.0}}), {}, kOpen);  // at (-1, 3)
  (void)map.create({1.0, 3.0, 0.0}, {}, {}, kWall);
  EXPECT_TRUE(map.current()->goals.empty());
  EXPECT_EQ(map.find(1)->goals.size(), 1U);
}

TEST(TopologyMap, ForgetsGoalsWhoseRegionHasANodeNow) {
  TopologyMap map({});
  (void)map.create({0.0, 0.0, 0.0}, tree_with({{5.0, 0.0}, {0.0, 5.0}}), {}, kOpen);
  (void)map.create({4.0, 0.0, 0.0}, {}, {}, kOpen);
  EXPECT_FALSE(map.has(1));
  EXPECT_TRUE(map.has(2));
  RobotTopology other;
  other.topology.nodes = {node(1, {0.0, 4.5})};
  map.settle({other}, kOpen);
  EXPECT_FALSE(map.has(2));
}

TEST(TopologyMap, JoinsNodesInSight) {
  TopologyMap map({});
  (void)map.create({1.0, 0.0, 0.0}, {}, {}, kWall);
  (void)map.create({1.0, 3.0, 0.0}, {}, {}, kWall);
  (void)map.create({-1.0, 3.0, 0.0}, {}, {}, kWall);  // through a door elsewhere
  const std::vector<TopologyEdge> expected{{1, 2}, {2, 3}};
  EXPECT_EQ(map.topology().edges, expected);
  map.arrive(1);
  EXPECT_EQ(map.topology().edges.size(), 3U);
  EXPECT_EQ(map.topology().current, 1U);
}

TEST(TopologyMap, KnowsAtWhichNodeAPlaceIs) {
  TopologyMap map({});
  (void)map.create({1.0, 0.0, 0.0}, {}, {}, kWall);
  EXPECT_EQ(map.node_at({2.5, 0.0}, kWall), 1U);
  EXPECT_EQ(map.node_at({3.5, 0.0}, kWall), std::nullopt);
  EXPECT_EQ(map.node_at({-0.5, 0.0}, kWall), std::nullopt);
}

TEST(TopologyMap, DoesNotTakeUpAgainWhatWasGivenUp) {
  TopologyMap map({});
  (void)map.create({0.0, 0.0, 0.0}, tree_with({{5.0, 0.0}}), {}, kOpen);
  map.close(1);
  EXPECT_FALSE(map.has(1));
  const auto ruled = map.look_again({0.0, 0.0, 0.0}, tree_with({{5.5, 0.0}}), {}, kOpen);
  EXPECT_EQ(ruled.front().rule, 3);
}

TEST(TopologyMap, MovesWithTheMap) {
  TopologyMap map({});
  (void)map.create({1.0, 2.0, 0.0}, tree_with({{5.0, 0.0}}), {}, kOpen);
  map.transform(Pose2{1.0, 0.0, kPi / 2.0});
  EXPECT_THAT(map.current()->map_T_base.translation(), Point2Near(Point2(-1.0, 1.0), 1e-9));
  EXPECT_THAT(map.current()->goals.front().p_map, Point2Near(Point2(-1.0, 6.0), 1e-9));
}

TEST(UnionOfRobots, JoinsNodesOfTwoRobotsWhereTheLineIsPassable) {
  Topology own;
  own.nodes = {node(1, {1.0, 0.0}), node(2, {1.0, 4.0})};
  own.edges = {{1, 2}};
  RobotTopology other;
  other.topology.nodes = {node(1, {-1.0, 0.0}), node(2, {2.0, 4.0}), node(3, {30.0, 4.0})};
  other.topology.edges = {{1, 2}, {2, 3}, {3, 77}};  // an edge to nowhere is left out
  const UnionGraph all = union_of(own, {other}, kWall, 8.0);
  ASSERT_EQ(all.members.size(), 5U);
  EXPECT_FALSE(all.members[1].robot.has_value());
  EXPECT_EQ(all.members[2].robot, 0U);
  const ShortestPaths paths = bellman_ford(all.graph, 0);
  EXPECT_NEAR(paths.distance_m[3], std::hypot(1.0, 4.0), 1e-9);
  EXPECT_NEAR(paths.distance_m[2], std::hypot(1.0, 4.0) + 5.0, 1e-9);  // the wall keeps the two starts apart
}

TEST(FarthestVisible, IsTheFarthestPlaceOfThePathThatCanBeDrivenStraightTo) {
  const std::vector<Point2> path{{1.0, 0.0}, {1.0, 3.0}, {0.5, 2.0}, {-1.0, 9.0}};
  EXPECT_EQ(farthest_visible({1.0, -1.0}, path, kWall), Point2(1.0, 3.0));
  EXPECT_EQ(farthest_visible({-1.0, -1.0}, {{1.0, 0.0}, {2.0, 0.0}}, kWall), Point2(1.0, 0.0));
  EXPECT_EQ(farthest_visible({0.0, 0.0}, {}, kWall), std::nullopt);
}

TEST(CorridorsOfAMap, DistinguishFreeFromBlockedFromUnseen) {
  const auto map = nav::CostMap::build(nav::ascii_map({"############",  //
                                                       "#....#     #",  //
                                                       "#....#     #",  //
                                                       "#..........#",  //
                                                       "#..........#",  //
                                                       "#....#.....#",  //
                                                       "############"},
                                                      0.5));
  ASSERT_TRUE(map.has_value());
  const Corridors corridors{corridors_of(*map)};
  const Point2 left(1.5, 1.5);
  EXPECT_EQ(corridors.test(left, {4.5, 1.5}, 0.7), Corridor::kFree);
  EXPECT_EQ(corridors.test(left, {4.5, 1.5}, 1.4), Corridor::kBlocked);  // the door is 1 m wide
  EXPECT_EQ(corridors.test(left, {4.5, 2.7}, 0.0), Corridor::kBlocked);  // the door frame
  EXPECT_EQ(corridors.test({4.0, 1.5}, {4.0, 2.7}, 0.7), Corridor::kUnknown);
  EXPECT_EQ(corridors.test(left, {9.0, 1.5}, 0.7), Corridor::kBlocked);
  EXPECT_TRUE(corridors.free(left, {4.5, 1.5}));
  EXPECT_FALSE(corridors.walled_off(left, {4.5, 1.5}));
}

TEST(TopologyMap, GoesOnFromWhatWasKeptWithNewIds) {
  TopologyMap before({});
  (void)before.create({0.0, 0.0, 0.0}, tree_with({{5.0, 0.0}, {0.0, 5.0}}), {}, kUnseen);
  before.close(before.topology().nodes[0].goals[0].id);
  TopologyMap after({}, before.topology(), before.closed_map());
  EXPECT_EQ(after.topology(), before.topology());
  ASSERT_EQ(after.closed_map().size(), 1U);
  (void)after.create({9.0, 0.0, 0.0}, tree_with({{-4.0, 0.0}, {0.0, -5.0}}), {}, kUnseen);
  const TopologyNode& added = after.topology().nodes.back();
  EXPECT_GT(added.id, before.topology().nodes.back().id);
  ASSERT_EQ(added.goals.size(), 1U) << "what was given up stays so";
  EXPECT_GT(added.goals[0].id, before.topology().nodes[0].goals[0].id);
}

}  // namespace
}  // namespace seeker::fleet
