#include "server/app/fleet/announced_map.hpp"

#include "common/digest/sha256.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

using app::AnnouncedMap;

TEST(AnnouncedMap, GoesOnWithAPieceWhereItWasCut) {
  const app::PackedMap robot = packed(small_map());
  AnnouncedMap map;
  map.announce(robot.manifest);
  ASSERT_EQ(map.missing().size(), 2U);
  const api::PieceHash hash = map.missing().front().hash;
  const std::vector<std::uint8_t>& bytes = *robot.pieces.at(hash);
  const std::size_t half = bytes.size() / 2;
  const auto middle = bytes.begin() + static_cast<std::ptrdiff_t>(half);
  const auto first = map.receive({"r1", hash, 0, {bytes.begin(), middle}});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->bytes, half);
  EXPECT_FALSE(first->completed);
  EXPECT_EQ(map.missing().front().offset, half);
  EXPECT_EQ(map.receive({"r1", hash, 0, {bytes.begin(), middle}})->bytes, half) << "sent twice";
  const auto second = map.receive({"r1", hash, half, {middle, bytes.end()}});
  ASSERT_TRUE(second);
  ASSERT_TRUE(second->completed);
  EXPECT_EQ(*second->completed, bytes);
  EXPECT_EQ(map.missing().size(), 1U);
  const auto again = map.receive({"r1", hash, 0, bytes});
  ASSERT_TRUE(again);
  EXPECT_FALSE(again->completed) << "it was complete before";
}

TEST(AnnouncedMap, DropsAPieceThatIsNotWhatWasAnnounced) {
  const app::PackedMap robot = packed(small_map());
  AnnouncedMap map;
  map.announce(robot.manifest);
  const api::PieceHash hash = map.missing().front().hash;
  std::vector<std::uint8_t> altered = *robot.pieces.at(hash);
  altered.back() ^= 1U;
  EXPECT_EQ(map.receive({"r1", hash, 0, altered}).error().code, Errc::kCorrupt);
  altered.push_back(0);
  EXPECT_EQ(map.receive({"r1", hash, 0, altered}).error().code, Errc::kTooLarge);
  EXPECT_EQ(map.receive({"r1", hash, 0, {}}).error().code, Errc::kTooLarge);
  EXPECT_EQ(map.receive({"r1", digest::sha256_of(altered), 0, altered}).error().code, Errc::kNotFound);
  EXPECT_EQ(map.missing().front().offset, 0U);
}

TEST(AnnouncedMap, DropsPiecesThatItsManifestDoesNotNameAnyMore) {
  const app::PackedMap robot = packed(small_map());
  AnnouncedMap map(robot.manifest, robot.pieces);
  EXPECT_TRUE(map.missing().empty());
  api::FleetManifest shorter = robot.manifest;
  shorter.nodes.pop_back();
  shorter.edges.clear();
  map.announce(shorter);
  EXPECT_EQ(map.pieces().size(), 1U);
  map.announce(robot.manifest);
  EXPECT_EQ(map.missing().size(), 1U);
}

TEST(SameFrame, IsThatOfMapsWithALocalMapInCommonAtTheSamePlace) {
  const std::vector<api::FleetNode> nodes = packed(small_map()).manifest.nodes;
  EXPECT_TRUE(app::same_frame(nodes, {nodes.back()}));
  EXPECT_FALSE(app::same_frame(nodes, {}));
  EXPECT_FALSE(app::same_frame(nodes, packed(small_map(2, 9)).manifest.nodes)) << "other scans";
  std::vector<api::FleetNode> moved{nodes.back()};
  moved.front().node.map_T_node.x_m += 5.0;
  EXPECT_FALSE(app::same_frame(nodes, moved));
}

}  // namespace
}  // namespace seeker::testing
