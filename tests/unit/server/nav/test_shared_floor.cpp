#include "server/nav/shared_floor.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/occupancy_tile.hpp"
#include "round_scan.hpp"
#include "server/nav/floor_view.hpp"
#include "server/nav/planner.hpp"

namespace seeker::nav {
namespace {

constexpr std::uint8_t kFreeCell = 0;

/// A grid of one value whose first cell is the given one of the frame `map`.
Grid<std::uint8_t> patch(CellIndex first, int width, int height, std::uint8_t value) {
  return {{kTileResolution_m * Point2(first.i, first.j), kTileResolution_m}, width, height, value};
}

std::uint8_t at(const Grid<std::uint8_t>& grid, const Point2& p) {
  const CellIndex cell = grid.frame().cell_of(p);
  return grid.contains(cell) ? grid[cell] : kUnknownCell;
}

TEST(SharedFloor, OwnCellsWinAndOthersFillWhatIsUnknown) {
  Grid<std::uint8_t> own = patch({0, 0}, 8, 1, kFreeCell);
  own[{1, 0}] = kUnknownCell;
  const Grid<std::uint8_t> both = with_known(own, patch({-2, 0}, 5, 2, kOccupiedCell));
  EXPECT_EQ(at(both, {-0.09, 0.01}), kOccupiedCell);
  EXPECT_EQ(at(both, {0.01, 0.01}), kFreeCell);
  EXPECT_EQ(at(both, {0.06, 0.01}), kOccupiedCell);
  EXPECT_EQ(at(both, {0.11, 0.01}), kFreeCell);
  EXPECT_EQ(at(both, {0.39, 0.06}), kUnknownCell);
  EXPECT_EQ(at(both, {0.01, 0.06}), kOccupiedCell);
}

TEST(SharedFloor, WhereOwnCellsAreUndecidedTheOtherRobotIsHeard) {
  constexpr std::uint8_t kUndecided = kOccupiedCell / 2;
  Grid<std::uint8_t> own = patch({0, 0}, 3, 1, kUndecided);
  own[{2, 0}] = kOccupiedCell;
  const Grid<std::uint8_t> both = with_known(own, patch({0, 0}, 1, 1, kFreeCell));
  EXPECT_EQ(at(both, {0.01, 0.01}), kFreeCell);
  EXPECT_EQ(at(both, {0.11, 0.01}), kOccupiedCell) << "what is sure stays";
  EXPECT_EQ(at(with_known(own, patch({0, 0}, 3, 1, kUnknownCell)), {0.06, 0.01}), kUndecided);
}

TEST(SharedFloor, FreeFloorEndsAtTheWallThatAnotherRobotSawThoughItsMapLiesACellAside) {
  constexpr CellIndex kBeyond{10, 3};  // the first cell that this robot has not seen
  const Grid<std::uint8_t> own = patch({0, 0}, kBeyond.i, 6, kFreeCell);
  const auto beyond = [&](const Grid<std::uint8_t>& all) { return at(all, own.frame().centre_of(kBeyond)); };
  Grid<std::uint8_t> other = patch({0, 0}, 10, 6, kFreeCell);
  for (int j = 0; j < 6; ++j) {
    other[{9, j}] = kOccupiedCell;
  }
  EXPECT_EQ(beyond(with_known(own, other)), kOccupiedCell);
  EXPECT_EQ(beyond(with_known(other, own)), kUnknownCell) << "its own wall ends its floor already";
  for (int j = 0; j < 6; ++j) {
    other[{9, j}] = kFreeCell;
    other[{5, j}] = kOccupiedCell;
  }
  EXPECT_EQ(beyond(with_known(own, patch({0, 0}, 5, 6, kFreeCell))), kUnknownCell);
  EXPECT_EQ(beyond(with_known(own, other)), kUnknownCell) << "that wall stands elsewhere";
}

TEST(SharedFloor, IsCarriedToWhereItLiesInTheOtherFrame) {
  Grid<std::uint8_t> floor = patch({0, 0}, 40, 20, kFreeCell);
  floor[{30, 10}] = kOccupiedCell;
  const Pose2 new_T_old{3.0, -1.0, kPi / 2};
  const Grid<std::uint8_t> there = carried(floor, new_T_old);
  EXPECT_EQ(at(there, new_T_old * floor.frame().centre_of({30, 10})), kOccupiedCell);
  EXPECT_EQ(at(there, new_T_old * floor.frame().centre_of({5, 5})), kFreeCell);
  EXPECT_EQ(at(there, {3.5, -0.5}), kUnknownCell);
}

TEST(SharedFloor, AWayLeadsOverFloorThatOnlyAnotherRobotHasSeen) {
  OccupancyMap map;
  LaserScan scan = round_scan(2.0F);
  scan.ranges_m.at(360) = kNoReturn;
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(map.integrate(scan, {}));
  }
  FloorSource floors({}, {}, 0.25, 1.0);
  floors.attend(map, {}, RobotTime{});
  const Point2 beyond(0.0, 5.0);
  EXPECT_FALSE(plan((*floors.view())->cost, {0, 0}, beyond));
  // The other one looked through a gap of the ring of walls that this one believes in: ring cells stay walls.
  const auto other = std::make_shared<const Grid<std::uint8_t>>(patch({-60, -60}, 120, 180, kFreeCell));
  floors.attend(map, {}, RobotTime{}, {}, other);
  const auto walled = floors.view();
  ASSERT_TRUE(walled);
  EXPECT_EQ((*walled)->cost.state((*walled)->cost.frame().cell_of(beyond)), CellState::kFree);
  EXPECT_FALSE(plan((*walled)->cost, {0, 0}, beyond));

  OccupancyMap open;
  ASSERT_TRUE(open.integrate(round_scan(kNoReturn), {}));
  FloorSource free_floors({}, {}, 0.25, 1.0);
  free_floors.attend(open, {}, RobotTime{});
  EXPECT_FALSE(plan((*free_floors.view())->cost, {0, 0}, beyond));
  free_floors.attend(open, {}, RobotTime{}, {}, other);
  EXPECT_TRUE(plan((*free_floors.view())->cost, {0, 0}, beyond));
}

TEST(SharedFloor, FloorsOfSeveralRobotsComeTogetherInOneFrame) {
  const auto shared = [](Grid<std::uint8_t> grid) {
    return std::make_shared<const Grid<std::uint8_t>>(std::move(grid));
  };
  const SharedFloor all = carried({{Pose2{0.5, 0.0, 0.0}, shared(patch({0, 0}, 4, 2, kOccupiedCell))},
                                   {Pose2{0.0, 0.0, 0.0}, shared(patch({0, 0}, 12, 2, kFreeCell))}});
  ASSERT_NE(all, nullptr);
  EXPECT_EQ(at(*all, {0.525, 0.025}), kOccupiedCell) << "the first of two that know a cell counts";
  EXPECT_EQ(at(*all, {0.025, 0.025}), kFreeCell);
  EXPECT_EQ(carried(std::vector<std::pair<Pose2, SharedFloor>>()), nullptr);
}

TEST(SharedFloor, CutIntoTilesItIsTheSameFloor) {
  const Grid<std::uint8_t> floor = patch({-70, 60}, 100, 30, kOccupiedCell);
  const std::vector<OccupancyTile> tiles = cut(floor);
  EXPECT_EQ(tiles.size(), 6U);
  const auto whole = assemble(tiles);
  ASSERT_TRUE(whole);
  const Grid<std::uint8_t> both = with_known(*whole, floor);
  EXPECT_EQ(std::count(both.cells().begin(), both.cells().end(), kOccupiedCell), 3000) << "nothing is missing";
  EXPECT_EQ(std::count(whole->cells().begin(), whole->cells().end(), kOccupiedCell), 3000);
}

}  // namespace
}  // namespace seeker::nav
