#include "server/nav/visibility.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "ascii_map.hpp"
#include "common/core/rng.hpp"

namespace seeker::nav {
namespace {

const std::vector<std::string> kPillar{"#######", "#.....#", "#..#..#", "#.....#", "#######"};

bool has(const std::vector<CellIndex>& cells, CellIndex cell) {
  return std::find(cells.begin(), cells.end(), cell) != cells.end();
}

TEST(LineOfSight, StopsAtWallsButSeesThem) {
  const auto grid = ascii_map(kPillar, 0.5);
  EXPECT_FALSE(line_of_sight(grid, {0.75, 1.25}, {2.75, 1.25}));
  EXPECT_TRUE(line_of_sight(grid, {0.75, 0.75}, {2.75, 0.75}));
  EXPECT_TRUE(line_of_sight(grid, {0.75, 1.25}, {1.501, 1.25}));
  EXPECT_FALSE(line_of_sight(grid, {0.75, 0.75}, {9.0, 0.75}));
}

TEST(LineOfSight, UnknownHidesUnlessAskedOtherwise) {
  const auto grid = ascii_map({". ."}, 0.5);
  EXPECT_FALSE(line_of_sight(grid, {0.25, 0.25}, {1.25, 0.25}));
  EXPECT_TRUE(line_of_sight(grid, {0.25, 0.25}, {1.25, 0.25}, {0.6, false}));
}

TEST(VisibleCellsOf, AreLitUpToRangeAndShadowedBehindThePillar) {
  const auto grid = ascii_map(kPillar, 0.5);
  const Grid<std::uint8_t> all(grid.frame(), grid.width(), grid.height(), 1);
  const auto cells = visible_cells_of(all, grid, {0.75, 1.25}, 10.0);
  EXPECT_TRUE(has(cells, grid.frame().cell_of({1.51, 1.25})));  // the pillar's near face
  EXPECT_FALSE(has(cells, grid.frame().cell_of({2.5, 1.25})));  // behind it
  EXPECT_TRUE(has(cells, grid.frame().cell_of({2.6, 0.55})));
  for (const CellIndex& cell : visible_cells_of(all, grid, {0.75, 1.25}, 0.6)) {
    EXPECT_LE((grid.frame().centre_of(cell) - Point2(0.75, 1.25)).norm(), 0.6);
  }
  EXPECT_TRUE(visible_cells_of(all, grid, {-1.0, 0.0}, 5.0).empty());
}

RC_GTEST_PROP(VisibleCellsOf, AreThoseWithALineOfSightWithinRange, (std::uint32_t seed)) {
  Rng rng(seed);
  Grid<std::uint8_t> grid(GridFrame{}, 40, 40, 0);
  for (int k = 0; k < 12; ++k) {
    grid[{static_cast<int>(rng.below(40)), static_cast<int>(rng.below(40))}] = kOccupiedCell;
  }
  grid[{20, 20}] = 0;
  const Grid<std::uint8_t> all(grid.frame(), grid.width(), grid.height(), 1);
  const Point2 from = grid.frame().centre_of({20, 20});
  const auto cells = visible_cells_of(all, grid, from, 0.9);
  for (std::size_t k = 0; k < grid.cells().size(); ++k) {
    const Point2 p = grid.frame().centre_of(grid.cell(k));
    RC_ASSERT(has(cells, grid.cell(k)) == ((p - from).norm() <= 0.9 && line_of_sight(grid, from, p)));
  }
}

TEST(VisibleCellsOf, PicksWantedCoarseCellsInSight) {
  const auto grid = ascii_map(kPillar, 0.5);
  Grid<std::uint8_t> floor(GridFrame{Point2::Zero(), 0.2}, 18, 13, 1);
  floor[floor.frame().cell_of({0.7, 1.7})] = 0;
  const auto cells = visible_cells_of(floor, grid, {0.75, 1.25}, 5.0);
  EXPECT_FALSE(has(cells, floor.frame().cell_of({2.5, 1.25})));
  EXPECT_TRUE(has(cells, floor.frame().cell_of({2.1, 0.7})));
  EXPECT_FALSE(has(cells, floor.frame().cell_of({0.7, 1.7})));
}

}  // namespace
}  // namespace seeker::nav
