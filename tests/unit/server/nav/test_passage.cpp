#include "server/nav/passage.hpp"

#include <gtest/gtest.h>

#include "ascii_map.hpp"

namespace seeker::nav {
namespace {

/// Two rooms of 3 x 4 m in cells of 0.25 m, joined by a door of 1 m in the wall between them.
std::vector<std::string> rooms_with_door() {
  std::vector<std::string> rows(18, '#' + std::string(12, '.') + '#' + std::string(12, '.') + '#');
  rows.front() = rows.back() = std::string(27, '#');
  for (std::size_t k = 7; k < 11; ++k) {
    rows[k][13] = '.';
  }
  return rows;
}

bool blocks(const std::vector<std::string>& rows, const Point2& p_map) {
  const auto cost = CostMap::build(ascii_map(rows, 0.25), {}, {});
  const auto costs = DistanceField::build(*cost, p_map);
  constexpr double kRoom_m2 = 0.5;
  return blocks_passage(*cost, *costs, p_map, kRoom_m2);
}

TEST(Passage, IsBlockedByARobotInADoor) {
  EXPECT_TRUE(blocks(rooms_with_door(), {3.375, 2.25}));
  EXPECT_TRUE(blocks(rooms_with_door(), {3.0, 2.25})) << "before the door there is no room to pass, either";
}

TEST(Passage, IsFreeBesideARobotInARoom) {
  EXPECT_FALSE(blocks(rooms_with_door(), {1.5, 2.25}));
  EXPECT_FALSE(blocks(rooms_with_door(), {0.7, 3.8})) << "a corner leads nowhere";
}

TEST(Passage, IsFreeInAWideCorridorAndBlockedInANarrowOne) {
  std::vector<std::string> rows(12, '#' + std::string(30, '.') + '#');
  rows.front() = rows.back() = std::string(32, '#');
  EXPECT_FALSE(blocks(rows, {4.0, 1.5}));
  rows.erase(rows.begin() + 5, rows.end() - 1);
  EXPECT_TRUE(blocks(rows, {4.0, 0.7}));
}

}  // namespace
}  // namespace seeker::nav
