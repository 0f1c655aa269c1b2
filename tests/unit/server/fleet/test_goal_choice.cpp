#include <gtest/gtest.h>

#include "server/fleet/goal_choice.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::fleet {
namespace {

using seeker::testing::Point2Near;

const Corridors kOpen{[](const Point2&, const Point2&, double) { return Corridor::kFree; }};

TopologyNode node(std::uint64_t id, const Point2& p, std::vector<TopologyGoal> goals = {}) {
  TopologyNode made;
  made.id = id;
  made.map_T_base = {p.x(), p.y(), 0.0};
  made.goals = std::move(goals);
  return made;
}

/// Three nodes in a row along x, 4 m apart, the robot at the first.
Topology row(const std::vector<std::vector<TopologyGoal>>& goals) {
  Topology map;
  for (std::size_t k = 0; k < goals.size(); ++k) {
    map.nodes.push_back(node(k + 1, {4.0 * static_cast<double>(k), 0.0}, goals[k]));
    if (k > 0) {
      map.edges.push_back({k, k + 1});
    }
  }
  map.current = 1;
  return map;
}

struct Scene {
  Topology own;
  FleetView fleet{"b", {}, nullptr};
  std::vector<Point2> left_out = {};
  std::function<double(const Point2&)> gain_m2 = [](const Point2&) { return 5.0; };

  [[nodiscard]] ChoiceInput input() const {
    return {own,
            fleet,
            {0.0, 0.0, 0.0},
            kOpen,
            8.0,
            2.0,
            [this](const Point2& p) { return std::find(left_out.begin(), left_out.end(), p) != left_out.end(); },
            gain_m2,
            {}};
  }
  [[nodiscard]] GoalChoice choose() const { return choose_goal(input()); }
  /// Whether the robot gives up its first goal, `p_other` being where robot "a" is, who drives there as well.
  [[nodiscard]] bool yields_to(const Point2& p_other);
};

RobotTopology other_at(const Point2& p, std::vector<TopologyGoal> goals = {}) {
  RobotTopology other;
  other.robot_id = "a";
  other.map_T_base = {p.x(), p.y(), 0.0};
  other.topology.nodes = {node(1, p, std::move(goals))};
  other.topology.current = 1;
  return other;
}

bool Scene::yields_to(const Point2& p_other) {
  const std::optional<PendingGoal> goal = choose().goal;
  fleet.others = {other_at(p_other)};
  fleet.others.front().target_map = goal->p_map;
  return yields(input(), *goal);
}

TEST(GoalChoice, IsTheMainGoalOfThePresentNode) {
  const Scene scene{row({{{1, {-3.0, 0.0}, 8}, {2, {3.0, 1.0}, 8}, {3, {3.0, 0.0}, 4}}, {{4, {5.0, 0.0}, 8}}})};
  const GoalChoice choice = scene.choose();
  ASSERT_TRUE(choice.goal.has_value());
  EXPECT_EQ(choice.goal->id, 2U);
  EXPECT_TRUE(choice.goal->path_map.empty());
  ASSERT_TRUE(choice.decision.chosen.has_value());
  EXPECT_EQ(choice.decision.rule, "topological");
  EXPECT_EQ(choice.decision.candidates.size(), 4U);
  EXPECT_THAT(choice.decision.candidates[*choice.decision.chosen].map_T_base.translation(),
              Point2Near(Point2(3.0, 1.0), 1e-9));
}

TEST(GoalChoice, GoesBackToTheClosestNodeWithAGoal) {
  const Scene scene{row({{}, {}, {{9, {8.0, 3.0}, 2}}, {{10, {12.0, 3.0}, 8}}})};
  const GoalChoice choice = scene.choose();
  ASSERT_TRUE(choice.goal.has_value());
  EXPECT_EQ(choice.goal->id, 9U);
  EXPECT_EQ(choice.goal->node, 3U);
  ASSERT_EQ(choice.goal->path_map.size(), 2U);
  EXPECT_THAT(choice.goal->path_map.back(), Point2Near(Point2(8.0, 0.0), 1e-9));
  EXPECT_NEAR(choice.goal->distance_m, 11.0, 1e-9);
}

TEST(GoalChoice, LeavesOutWhatFailedLately) {
  Scene scene{row({{{1, {3.0, 0.0}, 8}}, {{2, {5.0, 3.0}, 1}}})};
  scene.left_out = {{3.0, 0.0}};
  ASSERT_TRUE(scene.choose().goal.has_value());
  EXPECT_EQ(scene.choose().goal->id, 2U);
}

TEST(GoalChoice, IsNothingWhenNoNodeHasAGoal) {
  const GoalChoice choice = Scene{row({{}, {}})}.choose();
  EXPECT_FALSE(choice.goal.has_value());
  EXPECT_FALSE(choice.others_busy);
  EXPECT_FALSE(choice.decision.chosen.has_value());
}

TEST(GoalChoice, LeavesAloneWhatAnotherRobotDrivesTo) {
  Scene scene{row({{{1, {3.0, 0.0}, 8}}, {{2, {4.0, 5.0}, 1}}})};
  scene.fleet.others = {other_at({6.0, 0.0})};
  scene.fleet.others.front().target_map = Point2(3.5, 0.0);
  ASSERT_TRUE(scene.choose().goal.has_value());
  EXPECT_EQ(scene.choose().goal->id, 2U);
  scene.own.nodes[1].goals.clear();
  EXPECT_FALSE(scene.choose().goal.has_value());
  EXPECT_TRUE(scene.choose().others_busy);
}

TEST(GoalChoice, TakesOverWhatAnotherRobotHasAMuchLongerPathTo) {
  Scene scene{row({{{1, {3.0, 0.0}, 8}}})};
  scene.fleet.others = {other_at({5.0, 0.0})};
  scene.fleet.others.front().target_map = Point2(3.0, 0.0);
  EXPECT_FALSE(scene.choose().goal.has_value());
  scene.fleet.others = {other_at({12.0, 0.0})};
  scene.fleet.others.front().target_map = Point2(3.0, 0.0);
  ASSERT_TRUE(scene.choose().goal.has_value());
  EXPECT_EQ(scene.choose().goal->id, 1U);
}

TEST(GoalChoice, OfTwoThatDriveToOneGoalTheOneWithTheMuchLongerPathYieldsElseTheLastByName) {
  const Topology own = row({{{1, {9.0, 0.0}, 8}}});
  for (const char* name : {"b", "0"}) {  // after the other one, "a", and before it
    const auto yields_to = [&](const Point2& p_other) {
      Scene scene{own};
      scene.fleet.robot_id = name;
      return scene.yields_to(p_other);
    };
    EXPECT_TRUE(yields_to({8.0, 0.0})) << name;
    EXPECT_FALSE(yields_to({30.0, 0.0})) << name;
    EXPECT_EQ(yields_to({17.0, 0.0}), std::string(name) == "b");
  }
}

TEST(GoalChoice, DoesNotWaitForARobotThatIsGone) {
  Scene scene{row({{{1, {3.0, 0.0}, 8}}})};
  scene.fleet.others = {other_at({6.0, 0.0})};
  scene.fleet.others.front().target_map = Point2(3.5, 0.0);
  scene.fleet.others.front().active = false;
  ASSERT_TRUE(scene.choose().goal.has_value());
  EXPECT_EQ(scene.choose().goal->id, 1U);
}

TEST(GoalChoice, TakesUpTheGoalsOfARobotThatIsGone) {
  Scene scene{row({{}})};
  scene.fleet.others = {other_at({3.0, 0.0}, {{7, {3.0, 4.0}, 3}})};
  scene.fleet.others.front().active = false;
  const GoalChoice choice = scene.choose();
  ASSERT_TRUE(choice.goal.has_value());
  EXPECT_EQ(choice.goal->robot, 0U);
  EXPECT_EQ(choice.goal->id, 7U);
}

TEST(GoalChoice, OfGoalsThatNobodyIsNearerToTheClosestComesFirstWhateverTheyPromise) {
  Scene scene{row({{}, {{1, {4.0, 3.0}, 2}}, {{2, {8.0, 3.0}, 8}}})};
  scene.fleet.others = {other_at({20.0, 0.0}, {{7, {21.0, 0.0}, 8}})};
  scene.gain_m2 = [](const Point2& p) { return p.x() > 5.0 ? 500.0 : 0.0; };
  ASSERT_TRUE(scene.choose().goal.has_value());
  EXPECT_EQ(scene.choose().goal->id, 1U);
  scene.own.nodes[1].goals.clear();
  EXPECT_EQ(scene.choose().goal->id, 2U);
}

TEST(GoalChoice, AloneTheOutermostGoalOfANodeComesFirstAmongOthersTheClosest) {
  Scene scene{row({{{1, {0.0, 8.0}, 8}, {2, {0.0, -2.5}, 2}}})};
  EXPECT_EQ(scene.choose().goal->id, 1U);
  scene.fleet.others = {other_at({20.0, 0.0})};
  ASSERT_TRUE(scene.choose().goal.has_value());
  EXPECT_EQ(scene.choose().goal->id, 2U);
}

TEST(GoalChoice, OfTwoRobotsAtOnePlaceTheFirstByNameHasTheGoal) {
  Scene scene{row({{{1, {3.0, 0.0}, 8}}})};
  scene.fleet.others = {other_at({0.0, 0.0})};
  EXPECT_FALSE(scene.choose().goal.has_value());
  scene.fleet.robot_id = "a";
  scene.fleet.others.front().robot_id = "b";
  ASSERT_TRUE(scene.choose().goal.has_value());
  EXPECT_EQ(scene.choose().goal->id, 1U);
}

TEST(GoalChoice, SharesGoalsWithARobotThatIsNearerToThem) {
  // Both robots are free; each computes the same auction and takes its part.
  Scene scene{row({{{1, {-3.0, 0.0}, 8}}, {{2, {7.0, 0.0}, 8}}})};
  scene.fleet.others = {other_at({6.0, 0.0})};
  ASSERT_TRUE(scene.choose().goal.has_value());
  EXPECT_EQ(scene.choose().goal->id, 1U);
  scene.own.nodes[0].goals.clear();
  EXPECT_FALSE(scene.choose().goal.has_value());  // what is left is the other's
  EXPECT_TRUE(scene.choose().others_busy);
}

}  // namespace
}  // namespace seeker::fleet
