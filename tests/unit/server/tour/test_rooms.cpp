#include <gtest/gtest.h>

#include "common/core/occupancy_tile.hpp"
#include "server/nav/cost_map.hpp"
#include "server/tour/rooms.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::tour {
namespace {

Rooms rooms_in(const std::vector<std::string>& rows) {
  const Grid<std::uint8_t> map = nav::ascii_map(rows, 0.5);
  const auto cost = nav::CostMap::build(map);
  EXPECT_TRUE(cost.has_value());
  Grid<std::uint8_t> floor(map.frame(), map.width(), map.height(), 0);
  Grid<float> clearance_m(map.frame(), map.width(), map.height(), 0.0F);
  for (std::size_t k = 0; k < map.cells().size(); ++k) {
    floor.cells()[k] = cost->traversable(floor.cell(k)) ? 1 : 0;
    clearance_m.cells()[k] = cost->clearance_m(floor.cell(k));
  }
  return Rooms::find(floor, clearance_m);
}

/// Two rooms on a corridor, doors of a metre.
const std::vector<std::string> kFloor{"###################", "#........#........#", "#........#........#",
                                      "#........#........#", "#........#........#", "#........#........#",
                                      "###..##########..##", "#.................#", "#.................#",
                                      "#.................#", "#.................#", "###################"};

TEST(Rooms, AreTheWidePartsBetweenDoors) {
  const Rooms rooms = rooms_in(kFloor);
  EXPECT_EQ(rooms.count(), 3U);
  const std::uint16_t left = rooms.at({2.0, 4.0});
  const std::uint16_t right = rooms.at({7.0, 4.0});
  const std::uint16_t corridor = rooms.at({4.5, 1.5});
  EXPECT_NE(left, Rooms::kNone);
  EXPECT_NE(left, right);
  EXPECT_NE(left, corridor);
  EXPECT_NE(right, corridor);
  EXPECT_EQ(rooms.at({8.5, 1.5}), corridor);
  EXPECT_EQ(rooms.at({1.0, 3.2}), left);
  EXPECT_EQ(rooms.at({50.0, 50.0}), Rooms::kNone);
}

TEST(Rooms, PassagesLeadFromRoomToRoom) {
  const Rooms rooms = rooms_in(kFloor);
  const std::uint16_t left = rooms.at({2.0, 4.0});
  const std::uint16_t right = rooms.at({7.0, 4.0});
  const std::uint16_t corridor = rooms.at({4.5, 1.5});
  const std::vector<int> passages = rooms.passages_from(left);
  EXPECT_EQ(passages[left], 0);
  EXPECT_EQ(passages[corridor], 1);
  EXPECT_EQ(passages[right], 2);
  EXPECT_EQ(rooms.passages_from(Rooms::kNone)[left], Rooms::kUnreached);
}

TEST(Rooms, ADeskDoesNotPartARoom) {
  const Rooms rooms =
      rooms_in({"################", "#..............#", "#..............#", "#..............#", "#....######....#",
                "#....######....#", "#..............#", "#..............#", "#..............#", "################"});
  EXPECT_EQ(rooms.count(), 1U);
}

}  // namespace
}  // namespace seeker::tour
