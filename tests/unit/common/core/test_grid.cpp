#include "common/core/grid.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/occupancy_tile.hpp"
#include "tests/support/matchers.hpp"

namespace seeker {
namespace {

using testing::Point2Near;

TEST(Grid, CellsBelowTheOriginRoundDown) {
  const GridFrame frame{Point2(1.0, -1.0), 0.5};
  EXPECT_EQ(frame.cell_of({1.0, -1.0}), (CellIndex{0, 0}));
  EXPECT_EQ(frame.cell_of({0.99, -1.01}), (CellIndex{-1, -1}));
  EXPECT_THAT(frame.centre_of({0, 1}), Point2Near(Point2(1.25, -0.25), 1e-12));
}

TEST(Grid, StorageIsRowByRowAlongX) {
  Grid<int> grid({}, 3, 2, 7);
  grid[{2, 1}] = 9;
  EXPECT_EQ(grid.cells(), (std::vector<int>{7, 7, 7, 7, 7, 9}));
  EXPECT_FALSE(grid.contains({3, 0}));
  EXPECT_FALSE(grid.contains({0, -1}));
}

TEST(GridDeathTest, CellOutsideIsABug) {
  const Grid<int> grid({}, 3, 2);
  EXPECT_DEATH(static_cast<void>(grid.index({3, 0})), "assertion failed");
}

RC_GTEST_PROP(Grid, CentreOfACellLiesInIt, (int i, int j, unsigned resolution)) {
  const GridFrame frame{Point2(-3.25, 17.5), 0.01 * (1 + resolution % 100)};
  const CellIndex cell{i % 100000, j % 100000};
  RC_ASSERT(frame.cell_of(frame.centre_of(cell)) == cell);
}

RC_GTEST_PROP(Grid, IndexAndCellAreInverse, (unsigned w, unsigned h, unsigned n)) {
  const Grid<char> grid({}, static_cast<int>(1 + w % 50), static_cast<int>(1 + h % 50));
  const std::size_t index = n % grid.cells().size();
  RC_ASSERT(grid.index(grid.cell(index)) == index);
}

TEST(OccupancyTile, NoTilesGiveNoGrid) { EXPECT_EQ(assemble({}), std::nullopt); }

TEST(OccupancyTile, TilesArePastedWhereTheyBelongAndTheRestIsUnknown) {
  OccupancyTile low{{-1, 0}, 1, {}};
  low.cells[0] = kOccupiedCell;
  OccupancyTile high{{0, 1}, 2, {}};
  high.cells.back() = 17;
  const auto grid = assemble({high, low});
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->width(), 2 * kTileSide_cells);
  EXPECT_EQ(grid->height(), 2 * kTileSide_cells);
  EXPECT_THAT(grid->frame().origin, Point2Near(Point2(-3.2, 0.0), 1e-12));
  EXPECT_EQ((*grid)[(CellIndex{0, 0})], kOccupiedCell);
  EXPECT_EQ((*grid)[(CellIndex{1, 0})], 0);
  EXPECT_EQ((*grid)[(CellIndex{127, 127})], 17);
  EXPECT_EQ((*grid)[(CellIndex{kTileSide_cells, 0})], kUnknownCell);
}

TEST(OccupancyTile, AreaIsThatOfCellsRatherFreeThanNot) {
  EXPECT_EQ(free_area_m2(std::nullopt), 0.0);
  Grid<std::uint8_t> map({Point2::Zero(), 0.5}, 4, 1, kUnknownCell);
  map[{0, 0}] = 0;
  map[{1, 0}] = kOccupiedCell / 2;
  map[{2, 0}] = kOccupiedCell / 2 - 1;
  EXPECT_DOUBLE_EQ(free_area_m2(map), 0.5);
}

}  // namespace
}  // namespace seeker
