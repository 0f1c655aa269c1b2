#include <cmath>

#include <gtest/gtest.h>

#include "common/core/occupancy_tile.hpp"
#include "server/tour/clairvoyant.hpp"
#include "server/tour/floor_paths.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::tour {
namespace {

/// The picture as somebody knows it who has its plan; the robot is a point.
KnownBuilding building_of(const std::vector<std::string>& rows) {
  const Grid<std::uint8_t> map = nav::ascii_map(rows, 0.5);
  const Grid<std::uint8_t> nothing(map.frame(), map.width(), map.height(), 0);
  KnownBuilding building{nothing, nothing, nothing};
  for (std::size_t k = 0; k < map.cells().size(); ++k) {
    building.blocks.cells()[k] = map.cells()[k] == kOccupiedCell ? 1 : 0;
    building.free.cells()[k] = map.cells()[k] == 0 ? 1 : 0;
  }
  building.drive = building.free;
  return building;
}

const std::vector<std::string> kRoom{"##########", "#........#", "#........#", "#........#", "##########"};
const std::vector<std::string> kTwoRooms{"#####################", "#.........#.........#", "#.........#.........#",
                                         "#.........#.........#", "#.........#.........#", "#...................#",
                                         "#####################"};

TEST(Coverage, ARoomIsSeenFromWhereTheRobotStands) {
  CoverageParams params;
  params.share = 0.9;  // of the corners' outlines some cells are seen from near only
  const auto tour = clairvoyant_tour(building_of(kRoom), {1.0, 1.0}, params);
  ASSERT_TRUE(tour.has_value()) << tour.error().message;
  EXPECT_TRUE(tour->coverage.views.empty());
  EXPECT_NEAR(tour->coverage.floor_m2, 4.0 * 1.5, 0.3);
  EXPECT_DOUBLE_EQ(tour->open_tour_m, 0.0);
  EXPECT_DOUBLE_EQ(tour->with_return_m, 0.0);
}

TEST(Coverage, ASecondRoomNeedsAViewpointInIt) {
  const auto tour = clairvoyant_tour(building_of(kTwoRooms), {1.0, 2.5});
  ASSERT_TRUE(tour.has_value()) << tour.error().message;
  ASSERT_FALSE(tour->coverage.views.empty());
  EXPECT_GE(tour->coverage.floor_share, 0.985);
  EXPECT_GE(tour->coverage.wall_share, 0.985);
  EXPECT_GT(tour->coverage.views.front().x(), 5.0);
  EXPECT_GT(tour->open_tour_m, 4.0);
  EXPECT_GT(tour->with_return_m, tour->open_tour_m);
  EXPECT_LT(tour->with_return_m, 25.0);
}

TEST(Coverage, AShortSensorNeedsMoreViewpoints) {
  CoverageParams near;
  near.range_m = 1.5;
  const auto far_tour = clairvoyant_tour(building_of(kTwoRooms), {1.0, 2.5});
  const auto near_tour = clairvoyant_tour(building_of(kTwoRooms), {1.0, 2.5}, near);
  ASSERT_TRUE(far_tour && near_tour);
  EXPECT_GT(near_tour->coverage.views.size(), far_tour->coverage.views.size());
  EXPECT_GT(near_tour->open_tour_m, far_tour->open_tour_m);
}

TEST(Coverage, IsTheSameEveryTime) {
  const auto first = clairvoyant_tour(building_of(kTwoRooms), {1.0, 2.5});
  const auto second = clairvoyant_tour(building_of(kTwoRooms), {1.0, 2.5});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->open_tour, second->open_tour);
  EXPECT_EQ(first->with_return, second->with_return);
}

TEST(Coverage, RefusesWhatMakesNoSense) {
  CoverageParams params;
  params.share = 1.5;
  const auto refused = clairvoyant_tour(building_of(kRoom), {1.0, 1.0}, params);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Errc::kInvalidArgument);
  const auto in_wall = clairvoyant_tour(building_of(kRoom), {0.1, 0.1});
  ASSERT_FALSE(in_wall.has_value());
  EXPECT_EQ(in_wall.error().code, Errc::kUnreachable);
  params = {};
  params.step_m = -1.0;
  EXPECT_FALSE(clairvoyant_tour(building_of(kRoom), {1.0, 1.0}, params).has_value());
}

TEST(FloorPaths, GoAroundAWallAndAreNearlyStraight) {
  const KnownBuilding building = building_of(kTwoRooms);
  const Point2 from(1.0, 2.5);
  const Point2 to(9.0, 2.5);
  const FloorPaths paths(building.drive, from);
  const Point2 corner(5.0, 0.99);
  const double straight_m = 2.0 * (corner - from).norm();
  EXPECT_GT(paths.length_m(to), straight_m - 0.3);
  EXPECT_LT(paths.length_m(to), 1.08 * straight_m) << "sixteen directions err by a few per cent";
  const std::vector<Point2> path = FloorPaths(building.drive, from, &to).path_to(to);
  ASSERT_FALSE(path.empty());
  EXPECT_LT((path.front() - from).norm(), 0.1);
  EXPECT_LT((path.back() - to).norm(), 0.1);
  EXPECT_FALSE(std::isfinite(paths.length_m({-5.0, 0.0})));
  EXPECT_TRUE(FloorPaths(building.drive, {-5.0, 0.0}).path_to(to).empty());
}

}  // namespace
}  // namespace seeker::tour
