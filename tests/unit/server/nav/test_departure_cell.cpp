#include "server/nav/departure_cell.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "server/nav/planner.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::nav {
namespace {

const Point2 kRobot{2.025, 2.025};
constexpr double kSnap_m = 0.6;

/// A room of 4 x 4 m with legs about the robot, so many cells of 0.05 m off it each way: four, or eight with others
/// between them.
CostMap among_legs(int off_cells, int step_cells) {
  std::vector<std::string> rows(81, "#" + std::string(79, '.') + "#");
  rows.front() = rows.back() = std::string(81, '#');
  for (int row = -off_cells; row <= off_cells; row += step_cells) {
    for (int column = -off_cells; column <= off_cells; column += step_cells) {
      if (row != 0 || column != 0) {
        rows[static_cast<std::size_t>(40 + row)][static_cast<std::size_t>(40 + column)] = '#';
      }
    }
  }
  return *CostMap::build(ascii_map(rows, 0.05));
}

double floor_m2(const CostMap& map) {
  const auto floor = reachable_floor(map, kRobot, 0.2);
  return floor ? 0.04 * static_cast<double>(std::count(floor->cells().begin(), floor->cells().end(), 1)) : 0.0;
}

TEST(WayOut, FromABitOfFloorAmongLegsItLeadsOnToTheRoom) {
  // Between the legs are 0.45 to 0.55 m, depending on where in their cells they stand; inflated they leave nothing.
  const CostMap map = among_legs(5, 10);
  ASSERT_TRUE(map.traversable(kRobot));
  ASSERT_FALSE(map.segment_is_clear(kRobot, {2.025, 3.0}));
  const auto cell = departure_cell(map, kRobot, kSnap_m);
  ASSERT_TRUE(cell.has_value());
  EXPECT_GT((map.frame().centre_of(*cell) - kRobot).norm(), 0.3);
  EXPECT_GT(floor_m2(map), 8.0);
  const auto costs = DistanceField::build(map, kRobot);
  ASSERT_TRUE(costs.has_value());
  EXPECT_TRUE(costs->cost_to(Point2(0.6, 0.6)).has_value());
  EXPECT_TRUE(plan(map, kRobot, {0.6, 0.6}).has_value());
}

TEST(WayOut, LegsTooNearToEachOtherKeepTheRobotWhereItIs) {
  const CostMap map = among_legs(6, 6);
  ASSERT_TRUE(map.traversable(kRobot));
  EXPECT_EQ(departure_cell(map, kRobot, kSnap_m), map.frame().cell_of(kRobot));
  EXPECT_LT(floor_m2(map), 0.2);
}

TEST(WayOut, ACrowdedSpotOfALargeFloorIsLeftByTheNearestCell) {
  const CostMap map = among_legs(10, 20);
  const Point2 beside_a_leg{2.025 + 0.5 - 0.1, 2.025 + 0.5};
  EXPECT_EQ(departure_cell(map, beside_a_leg, kSnap_m), map.nearest_traversable(beside_a_leg, kSnap_m));
  EXPECT_EQ(departure_cell(map, kRobot, kSnap_m), map.frame().cell_of(kRobot));
}

TEST(WayOut, InAClosedBoxThereIsNone) {
  std::vector<std::string> rows(60, "." + std::string(60, '.'));
  for (int k = 22; k <= 38; ++k) {
    const auto at = static_cast<std::size_t>(k);
    rows[22][at] = rows[38][at] = rows[at][22] = rows[at][38] = '#';
  }
  const CostMap map = *CostMap::build(ascii_map(rows, 0.05));
  const Point2 inside{1.525, 1.475};
  const auto cell = departure_cell(map, inside, kSnap_m);
  ASSERT_TRUE(cell.has_value());
  EXPECT_LT((map.frame().centre_of(*cell) - inside).norm(), 0.2);
}

TEST(WayOut, ItDoesNotLeadThroughForbiddenFloor) {
  // A place that failed before lies across a corridor 1.2 m wide; on this side is little floor.
  std::vector<std::string> rows(60, std::string(60, '.'));
  rows[18] = rows[43] = std::string(60, '#');
  for (std::string& row : rows) {
    row[40] = '#';
  }
  CostMapLimits limits;
  limits.forbidden_discs = {{1.3, 1.2}, {1.3, 1.45}, {1.3, 1.7}};
  const CostMap map = *CostMap::build(ascii_map(rows, 0.05), {}, limits);
  const Point2 robot{1.63, 1.45};
  ASSERT_TRUE(map.traversable(robot));
  EXPECT_EQ(departure_cell(map, robot, kSnap_m), map.frame().cell_of(robot));
}

}  // namespace
}  // namespace seeker::nav
