#include "server/fleet/prepared_map.hpp"

#include <gtest/gtest.h>

#include "toy_maps.hpp"

namespace seeker::fleet {
namespace {

const std::vector<Point2> kPath{{1.0, 6.0}, {22.0, 6.0}, {2.0, 6.2}};

/// The map as it was when only so many local maps were there.
LineMap first_nodes(LineMap map, std::uint32_t count) {
  std::erase_if(map.nodes, [&](const MapNode& node) { return node.id >= count; });
  std::erase_if(map.edges, [&](const MapEdge& edge) { return edge.to >= count; });
  std::erase_if(map.keyframes, [&](const MapKeyframe& keyframe) { return keyframe.node >= count; });
  return map;
}

TEST(PreparedMap, KeepsWhatDidNotChangeWhenTheMapGrows) {
  const LineMap whole = toy_map(office(1), drive(kPath), 1);
  ASSERT_GE(whole.nodes.size(), 4U);
  PreparedMap map = prepared(first_nodes(whole, 3));
  ASSERT_EQ(map.nodes().size(), 3U);
  const auto before = map.place(0);
  ASSERT_TRUE(before);
  ASSERT_TRUE(map.update(first_nodes(whole, 3)));
  EXPECT_EQ(map.place(0), before) << "made again although nothing changed";
  ASSERT_TRUE(map.update(whole));
  EXPECT_EQ(map.nodes().size(), whole.nodes.size());
  EXPECT_NE(map.place(0), before) << "the region has seen more since";
}

TEST(PreparedMap, ARegionIsMadeAgainWhenItsLocalMapsMoveToEachOther) {
  LineMap whole = toy_map(office(1), drive(kPath), 1);
  PreparedMap map = prepared(whole);
  const auto before = map.place(0);
  whole.nodes[1].map_T_node = whole.nodes[1].map_T_node * Pose2{0.005, 0.0, 0.0};
  ASSERT_TRUE(map.update(whole));
  EXPECT_EQ(map.place(0), before);
  whole.nodes[1].map_T_node = whole.nodes[1].map_T_node * Pose2{0.3, 0.0, 0.0};
  ASSERT_TRUE(map.update(whole));
  EXPECT_NE(map.place(0), before);
}

TEST(PreparedMap, RefusesWhatIsNoMapAndLeavesOutLocalMapsWithoutScans) {
  LineMap map = toy_map(office(1), drive(kPath), 1);
  LineMap broken = map;
  broken.keyframes.front().node = 999;
  PreparedMap empty;
  EXPECT_EQ(empty.update(broken).error().code, Errc::kInvalidArgument);
  std::erase_if(map.keyframes, [](const MapKeyframe& keyframe) { return keyframe.node == 1; });
  const PreparedMap made = prepared(map);
  EXPECT_EQ(made.nodes().size(), map.nodes.size() - 1);
}

TEST(PreparedMap, FindsTheRegionOfAPlaceAndNoneFarAway) {
  const PreparedMap map = prepared(toy_map(office(1), drive(kPath), 1));
  for (const PreparedNode& node : map.nodes()) {
    EXPECT_TRUE(map.region_at(node.map_T_node * node.middle));
    EXPECT_LT(node.region, map.regions().size());
  }
  EXPECT_FALSE(map.region_at({500.0, 500.0}));
}

TEST(PreparedMap, ProposesNoMoreRegionsThanAskedFor) {
  const PreparedMap a = prepared(toy_map(office(1), drive(kPath), 1));
  const PreparedMap b = prepared(toy_map(office(1), drive(kPath), 2));
  ASSERT_GE(a.regions().size(), 2U);
  EXPECT_EQ(a.regions_like(b.nodes().front(), 1).size(), 1U);
  EXPECT_EQ(a.regions_like(b.nodes().front(), 100).size(), a.regions().size());
}

}  // namespace
}  // namespace seeker::fleet
