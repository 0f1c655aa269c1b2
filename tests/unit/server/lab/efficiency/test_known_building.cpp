#include <gtest/gtest.h>

#include "server/lab/efficiency/known_building.hpp"

namespace seeker::lab {
namespace {

constexpr double kRadius_m = 0.2;
constexpr double kHeight_m = 0.3;

std::uint8_t at(const Grid<std::uint8_t>& grid, const Point2& p) { return grid[grid.frame().cell_of(p)]; }

sim::Wall wall_of(const Point2& a, const Point2& b) {
  sim::Wall wall;
  wall.a = a;
  wall.b = b;
  return wall;
}

/// Two rooms of 2 x 2 m without a door between; the start is in the left one.
sim::World two_rooms() {
  sim::World world;
  world.max_corner = {4.0, 2.0};
  world.walls = {wall_of({0.0, 0.0}, {4.0, 0.0}), wall_of({4.0, 0.0}, {4.0, 2.0}), wall_of({4.0, 2.0}, {0.0, 2.0}),
                 wall_of({0.0, 2.0}, {0.0, 0.0}), wall_of({2.02, 0.0}, {2.02, 2.0})};
  world.starts = {{1.0, 1.0, 0.0}};
  return world;
}

TEST(KnownBuilding, OfAWorldIsDrivenAsFarAsTheRobotComes) {
  const tour::KnownBuilding building = building_of(two_rooms(), kRadius_m, kHeight_m);
  EXPECT_EQ(at(building.drive, {1.0, 1.0}), 1);
  EXPECT_EQ(at(building.drive, {0.1, 1.0}), 0) << "too near to the wall";
  EXPECT_EQ(at(building.drive, {3.0, 1.0}), 0) << "no door leads there";
  EXPECT_EQ(at(building.blocks, {2.02, 1.0}), 1);
  EXPECT_EQ(at(building.free, {2.02, 1.0}), 0);
  EXPECT_EQ(at(building.free, {3.0, 1.0}), 1);
}

TEST(KnownBuilding, WhatLiesOutsideTheScannersPlaneHidesNothing) {
  const tour::KnownBuilding building = building_of(two_rooms(), kRadius_m, 3.0);
  EXPECT_EQ(at(building.blocks, {2.02, 1.0}), 0);
  EXPECT_EQ(at(building.drive, {3.0, 1.0}), 0) << "the wall is in the way all the same";
}

/// The same rooms in cells of 0.1 m.
RosMap map_of_two_rooms() {
  const GridFrame frame{Point2::Zero(), 0.1};
  RosMap map{Grid<std::uint8_t>(frame, 40, 20, 0), Grid<std::uint8_t>(frame, 40, 20, 1)};
  for (CellIndex cell{0, 0}; cell.j < 20; ++cell.j) {
    for (cell.i = 0; cell.i < 40; ++cell.i) {
      const bool wall = cell.i == 0 || cell.i == 20 || cell.i == 39 || cell.j == 0 || cell.j == 19;
      map.occupied[cell] = wall ? 1 : 0;
    }
  }
  return map;
}

TEST(KnownBuilding, OfAMapIsDrivenAsFarAsTheRobotComes) {
  RosMap map = map_of_two_rooms();
  map.known[map.known.frame().cell_of({1.55, 1.55})] = 0;
  const auto building = building_of(map, {1.0, 1.0}, kRadius_m);
  ASSERT_TRUE(building) << building.error().message;
  EXPECT_EQ(at(building->drive, {1.0, 1.0}), 1);
  EXPECT_EQ(at(building->drive, {0.15, 1.0}), 0);
  EXPECT_EQ(at(building->drive, {3.0, 1.0}), 0);
  EXPECT_EQ(at(building->free, {3.0, 1.0}), 1);
  EXPECT_EQ(at(building->free, {1.55, 1.55}), 0) << "nobody knows what is there";
}

TEST(KnownBuilding, RefusesAStartInAWallOrOffTheMap) {
  for (const Point2& start : {Point2(0.05, 1.0), Point2(9.0, 9.0)}) {
    const auto building = building_of(map_of_two_rooms(), start, kRadius_m);
    ASSERT_FALSE(building);
    EXPECT_EQ(building.error().code, Errc::kUnreachable);
    EXPECT_NE(building.error().message.find("--start"), std::string::npos) << building.error().message;
  }
}

}  // namespace
}  // namespace seeker::lab
