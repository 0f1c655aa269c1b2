#include "server/fleet/map_overlap.hpp"

#include <gtest/gtest.h>

#include "toy_maps.hpp"

namespace seeker::fleet {
namespace {

const std::vector<Wall> kHall = box(0.0, 0.0, 9.0, 7.0);
const std::vector<Point2> kRound{{1.0, 1.0}, {8.0, 1.0}, {8.0, 6.0}, {1.0, 6.0}, {1.0, 1.0}};
/// As large as a robot.
const std::vector<Wall> kVisitor = box(4.2, 3.2, 4.7, 3.7);

/// The map of a robot that has seen the visitor stand there from the first so many of its places.
PreparedMap visited_map(std::size_t places, std::uint64_t seed) {
  std::vector<Wall> with_visitor = kHall;
  add(with_visitor, kVisitor);
  const std::vector<Pose2> path = drive(kRound);
  const ToyDrift none{0.0, 0.0};
  LineMap map = toy_map(kHall, path, seed, none);
  const LineMap visited = toy_map(with_visitor, path, seed, none);
  std::copy_n(visited.keyframes.begin(), std::min(places, path.size()), map.keyframes.begin());
  return prepared(map);
}

MapOverlap overlap_with_empty(PreparedMap& b) {
  PreparedMap a = visited_map(0, 11);
  return overlap_of(a, b, [&](std::size_t k) { return b.nodes()[k].map_T_node; });
}

TEST(MapOverlap, WhatStoodThereAllTheTimeIsDeniedByTheOther) {
  PreparedMap b = visited_map(1000, 12);
  EXPECT_GT(overlap_with_empty(b).denied_piece_m, 0.4);
}

TEST(MapOverlap, ABoxDeniesByItsExtentAndNotByTheLengthOfItsSides) {
  constexpr double kDiagonal_m = 0.75;
  constexpr double kCells_m = 0.3;  // the walls are scattered over the cells beside them
  PreparedMap b = visited_map(1000, 12);
  EXPECT_LT(overlap_with_empty(b).denied_piece_m, kDiagonal_m + kCells_m);
}

TEST(MapOverlap, WhatARobotHasLookedThroughItselfIsNoWallOfIts) {
  PreparedMap b = visited_map(12, 12);
  const MapOverlap overlap = overlap_with_empty(b);
  EXPECT_LT(overlap.denied_piece_m, 0.2);
  PreparedMap nobody = visited_map(0, 12);
  EXPECT_NEAR(overlap.contradiction, overlap_with_empty(nobody).contradiction, 0.005);
}

TEST(MapOverlap, CountsTheLocalMapsThatShowEnoughOfTheOthersWalls) {
  PreparedMap b = visited_map(0, 12);
  const std::size_t all = b.nodes().size();
  ASSERT_GE(all, 2U);
  EXPECT_EQ(overlap_with_empty(b).witnesses, all);
  PreparedMap a = visited_map(0, 11);
  constexpr double kFar_m = 100.0;
  const auto one_elsewhere = [&](std::size_t k) {
    return k == 0 ? Pose2{kFar_m, kFar_m, 0.0} : b.nodes()[k].map_T_node;
  };
  EXPECT_EQ(overlap_of(a, b, one_elsewhere).witnesses, all - 1);
}

TEST(MapOverlap, WhatIsNotLaidExactlyProvesAndDeniesNothing) {
  PreparedMap b = visited_map(1000, 12);
  PreparedMap a = visited_map(0, 11);
  const MapOverlap overlap = overlap_of(a, b, [](std::size_t) { return std::nullopt; });
  EXPECT_EQ(overlap.shared_wall_m, 0.0);
  EXPECT_EQ(overlap.contradiction, 0.0);
  EXPECT_EQ(overlap.denied_piece_m, 0.0);
}

}  // namespace
}  // namespace seeker::fleet
