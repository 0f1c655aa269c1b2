#include <limits>

#include <gtest/gtest.h>

#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"

namespace seeker::wire {
namespace {

TopologyNode place(std::uint64_t id, const Point2& p) {
  TopologyNode node;
  node.id = id;
  node.map_T_base = {p.x(), p.y(), 0.5};
  node.sectors = {{{0.25, 0.0}, -1.5, 3.0, 4.5}, {{0.25, 0.0}, 2.0, 0.5, 8.0}};
  node.goals = {{10 * id, p + Point2(3.0, -1.0), 8}};
  return node;
}

api::FleetShare share() {
  RobotTopology robot;
  robot.robot_id = "r1";
  robot.map_T_base = {1.0, 2.0, -0.5};
  robot.topology.nodes = {place(1, {0.0, 0.0}), place(4, {5.0, 1.0})};
  robot.topology.edges = {{1, 4}};
  robot.topology.current = 4;
  robot.target_map = Point2(8.0, 0.0);
  robot.velocity = Twist2{0.4, -0.2};
  return {"r1", 77, robot};
}

pb::FleetShare message_of(const api::FleetShare& share) {
  pb::FleetShare message;
  write(share, &message);
  return message;
}

Result<api::FleetShare> through_bytes(const pb::FleetShare& message) {
  pb::FleetShare again;
  EXPECT_TRUE(again.ParseFromString(message.SerializeAsString()));
  return from_message<api::FleetShare>(again);
}

/// What is said of a message after `change`.
template <class Change>
Errc refusal_of(Change change) {
  pb::FleetShare message = message_of(share());
  change(*message.mutable_topology());
  const Result<api::FleetShare> read = through_bytes(message);
  EXPECT_FALSE(read);
  return read ? Errc::kInternal : read.error().code;
}

TEST(ConvertFleet, WhereARobotGoesComesBackUnchanged) {
  const Result<api::FleetShare> back = through_bytes(message_of(share()));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, share());
  const api::FleetShare fresh{"r1", 78, {}};
  EXPECT_EQ(through_bytes(message_of(fresh)).value(), fresh);
}

TEST(ConvertFleet, WhereTheOthersGoComesBackUnchanged) {
  const api::FleetShared told{api::FleetState::kMerged, {*share().topology}};
  pb::FleetReply reply;
  write(told, &reply);
  pb::FleetReply again;
  ASSERT_TRUE(again.ParseFromString(reply.SerializeAsString()));
  EXPECT_EQ(from_message<api::FleetShared>(again).value(), told);
  again.set_state(pb::FLEET_STATE_UNSPECIFIED);
  EXPECT_EQ(from_message<api::FleetShared>(again).error().code, Errc::kInvalidArgument);
}

TEST(ConvertFleet, HowTheMapsHangTogetherComesBackUnchanged) {
  api::FleetMember member;
  member.robot_id = "r1";
  member.state = api::FleetState::kMerged;
  member.hypotheses = {{{1.0, 2.0, 0.5}, 0.75, 8.5, 0.25, 3, 2}};
  member.merged_with = {"r2", 3};
  const api::FleetStatus told{{member}, 7};
  pb::FleetStatus message;
  write(told, &message);
  pb::FleetStatus again;
  ASSERT_TRUE(again.ParseFromString(message.SerializeAsString()));
  EXPECT_EQ(from_message<api::FleetStatus>(again).value(), told);
  again.mutable_members(0)->mutable_merged_with()->clear_through();
  EXPECT_EQ(from_message<api::FleetStatus>(again)->members.front().merged_with, (api::FleetMergedWith{"", 3}))
      << "with the main robot's map";
  again.mutable_members(0)->mutable_merged_with()->set_through("no such/name");
  EXPECT_EQ(from_message<api::FleetStatus>(again).error().code, Errc::kInvalidArgument);
}

OccupancyTile tile(int i, int j) {
  OccupancyTile made;
  made.index = {i, j};
  made.cells.fill(kUnknownCell);
  made.cells[5] = kOccupiedCell;
  return made;
}

Result<api::FleetSeen> through_bytes(const api::FleetSeen& floor) {
  pb::FleetSeen message;
  write(floor, &message);
  pb::FleetSeen again;
  EXPECT_TRUE(again.ParseFromString(message.SerializeAsString()));
  return from_message<api::FleetSeen>(again);
}

TEST(ConvertFleet, FloorComesBackUnchangedAndIsNeverLargerThanItMayBe) {
  const api::FleetSeen floor{"r1", 77, true, {tile(-3, 0), tile(2, 9)}, {}, {}};
  EXPECT_EQ(through_bytes(floor).value(), floor);
  const api::FleetSightings others{floor.tiles, {}, {}};
  pb::FleetReply reply;
  write(others, &reply);
  EXPECT_EQ(from_message<api::FleetSightings>(reply).value(), others);
  EXPECT_EQ(through_bytes({"r1", 77, true, {tile(0, 0), tile(0, api::kMaxFleetFloorSide_tiles)}, {}, {}}).error().code,
            Errc::kTooLarge);
  const api::FleetSeen many{"r1", 77, true, std::vector<OccupancyTile>(api::kMaxFleetTiles + 1, tile(0, 0)), {}, {}};
  EXPECT_EQ(through_bytes(many).error().code, Errc::kTooLarge);
}

api::Detection detection(std::uint64_t id, const Point2& p_map) {
  api::Detection made;
  made.id = id;
  made.target = "mug";
  made.stamp = RobotTime(std::chrono::seconds(id));
  made.position = p_map;
  return made;
}

TEST(ConvertFleet, WhatWasFoundComesBackUnchangedAndIsNeverMoreThanItMayBe) {
  const api::FleetSeen found{"r1", 77, true, {}, {detection(1, {2.0, 3.0}), detection(4, {-2.0, 3.0})}, {}};
  EXPECT_EQ(through_bytes(found).value(), found);
  const api::FleetSightings others{{}, {{"r2", found.detections[0]}, {"r3", found.detections[1]}}, {}};
  pb::FleetReply reply;
  write(others, &reply);
  EXPECT_EQ(from_message<api::FleetSightings>(reply).value(), others);
  EXPECT_EQ(through_bytes({"r1", 77, true, {}, {detection(1, {2e4, 0.0})}, {}}).error().code, Errc::kInvalidArgument);
  api::Detection vague = detection(1, {1.0, 1.0});
  vague.position_covariance(0, 1) = vague.position_covariance(1, 0) = -2.0 * api::kMaxFleetCovariance_m2;
  EXPECT_EQ(through_bytes({"r1", 77, true, {}, {vague}, {}}).error().code, Errc::kInvalidArgument);
  EXPECT_TRUE(api::within_limits({vague}).empty());
  std::vector<api::Detection> many;
  for (std::uint64_t id = 1; id <= api::kMaxFleetDetections + 1; ++id) {
    many.push_back(detection(id, {1.0, 1.0}));
  }
  EXPECT_EQ(through_bytes({"r1", 77, true, {}, many, {}}).error().code, Errc::kTooLarge);
  many.back().stamp = RobotTime();  // its program has begun to count anew
  std::swap(many.front(), many.back());
  const std::vector<api::Detection> told = api::within_limits(many);
  EXPECT_TRUE(through_bytes({"r1", 77, true, {}, told, {}}));
  EXPECT_EQ(told.front().id, 2U) << "the newest stay";
  EXPECT_EQ(told.back().id, api::kMaxFleetDetections + 1);
}

TEST(ConvertFleet, WhatWasSearchedComesBackUnchangedAndIsNeverLargerThanItMayBe) {
  Grid<std::uint8_t> grid({{-3.0, 4.0}, 0.2}, 7, 5, 100);
  grid[{3, 2}] = 250;
  const SearchedFloor searched{{"box", "mug"}, {1.0, 2.0, 0.5}, std::make_shared<const Grid<std::uint8_t>>(grid)};
  const api::FleetSeen seen{"r1", 77, true, {}, {}, searched};
  EXPECT_EQ(through_bytes(seen).value(), seen);
  const api::FleetSightings others{{}, {}, {searched, searched}};
  pb::FleetReply reply;
  write(others, &reply);
  EXPECT_EQ(from_message<api::FleetSightings>(reply).value(), others);
  const auto refusal_with = [&](std::shared_ptr<const Grid<std::uint8_t>> probability) {
    api::FleetSeen bad = seen;
    bad.searched->probability = std::move(probability);
    return through_bytes(bad).error().code;
  };
  const auto grid_of = [](const GridFrame& frame, int width) {
    return std::make_shared<const Grid<std::uint8_t>>(frame, width, 1, std::uint8_t{0});
  };
  EXPECT_EQ(refusal_with(grid_of({Point2::Zero(), 0.2}, api::kMaxFleetSearchedSide_cells + 1)), Errc::kTooLarge);
  EXPECT_EQ(refusal_with(grid_of({{2e4, 0.0}, 0.2}, 1)), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_with(grid_of({Point2::Zero(), 5.0}, 1)), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_with(nullptr), Errc::kInvalidArgument);
}

TEST(ConvertFleet, WallsComeBackUnchangedAndAreNeverMoreThanTheyMayBe) {
  const api::FleetSeen seen{"r1", 77, true, {}, {}, {}, {{{0.5, 2.0}, {3.0, 2.25}}, {{-1.0, 0.0}, {-1.0, 4.0}}}};
  EXPECT_EQ(through_bytes(seen).value(), seen);
  const api::FleetSightings others{{}, {}, {}, seen.sides};
  pb::FleetReply reply;
  write(others, &reply);
  EXPECT_EQ(from_message<api::FleetSightings>(reply).value(), others);
  reply.add_sides(1.0F);
  EXPECT_EQ(from_message<api::FleetSightings>(reply).error().code, Errc::kInvalidArgument) << "half a side";
  const auto refusal_of_side = [](const MappedSide& side) {
    return through_bytes({"r1", 77, true, {}, {}, {}, {side}}).error().code;
  };
  EXPECT_EQ(refusal_of_side({{2e4, 0.0}, {0.0, 0.0}}), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of_side({{0.0, 0.0}, {0.0, std::nan("")}}), Errc::kInvalidArgument);
  const std::vector<MappedSide> many(api::kMaxFleetSides + 1, seen.sides.front());
  EXPECT_EQ(through_bytes({"r1", 77, true, {}, {}, {}, many}).error().code, Errc::kTooLarge);
  std::vector<MappedSide> told = many;
  told.front() = {{9.0, 9.0}, {9.0, 8.0}};
  told[1] = {{2e4, 0.0}, {0.0, 0.0}};
  told = api::within_limits(told, Point2(9.0, 9.0));
  EXPECT_EQ(told.size(), api::kMaxFleetSides) << "one is out of reach";
  EXPECT_TRUE(through_bytes({"r1", 77, true, {}, {}, {}, told}));
  EXPECT_EQ(api::within_limits(std::vector<MappedSide>(api::kMaxFleetSides + 1, MappedSide{}), Point2::Zero()).size(),
            api::kMaxFleetSides);
}

TEST(ConvertFleet, OfALargeFloorTheTilesNextToTheRobotAreTold) {
  std::vector<OccupancyTile> tiles;
  for (int i = -50; i < 50; ++i) {
    for (int j = -50; j < 50; ++j) {
      tiles.push_back(tile(i, j));
    }
  }
  const api::FleetSeen told{"r1", 77, true, api::within_limits(tiles, Point2(64.0, 0.0)), {}, {}};
  EXPECT_TRUE(through_bytes(told));
  ASSERT_EQ(told.tiles.size(), api::kMaxFleetTiles);
  EXPECT_TRUE(std::all_of(told.tiles.begin(), told.tiles.end(), [](const OccupancyTile& one) {
    return std::abs(one.index.i - 20) <= 16 && std::abs(one.index.j) <= 16;
  }));
}

TEST(ConvertFleet, ARobotIdThatNamesNoFolderIsRefused) {
  for (const char* id : {"", "..", "../../esc", "a/b", ".hidden"}) {
    pb::FleetManifest manifest;
    manifest.set_robot_id(id);
    EXPECT_FALSE(from_message<api::FleetManifest>(manifest)) << id;
    pb::FleetChunk chunk;
    chunk.set_robot_id(id);
    chunk.set_sha256(std::string(32, 'x'));
    EXPECT_FALSE(from_message<api::FleetChunk>(chunk)) << id;
  }
  pb::FleetManifest manifest;
  manifest.set_robot_id("Hall_2.left");
  EXPECT_TRUE(from_message<api::FleetManifest>(manifest));
}

TEST(ConvertFleet, ATopologyThatMakesNoSenseIsRefused) {
  using T = pb::FleetTopology;
  EXPECT_EQ(refusal_of([](T& t) { t.set_robot_id("r2"); }), Errc::kInvalidArgument) << "speaks of another robot";
  EXPECT_EQ(refusal_of([](T& t) { t.clear_map_t_base(); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.mutable_places(1)->set_id(1); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.mutable_places(0)->set_id(0); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.mutable_places(0)->mutable_map_t_base()->set_x_m(1e5); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.mutable_places(0)->add_sectors(1.0F); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.mutable_places(0)->set_sectors(4, -1.0F); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.mutable_places(0)->set_sectors(0, std::numeric_limits<float>::quiet_NaN()); }),
            Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.mutable_places(0)->mutable_goals(0)->set_layer(65); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.mutable_places(0)->mutable_goals(0)->mutable_p_map()->set_x_m(300.0); }),
            Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.set_edges(0, 9); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.add_edges(1); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.set_current(9); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.mutable_velocity()->set_v_m_s(1e9); }), Errc::kInvalidArgument);
  EXPECT_EQ(refusal_of([](T& t) { t.mutable_velocity()->set_omega_rad_s(-1e9); }), Errc::kInvalidArgument);
}

TEST(ConvertFleet, MoreThanAFleetTakesIsRefusedAndWithinTheLimitsItIsNot) {
  api::FleetShare much = share();
  Topology& topology = much.topology->topology;
  topology.nodes.front().goals.assign(api::kMaxFleetGoals, {7, {1.0, 1.0}, 1});
  const auto refused = through_bytes(message_of(much));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kTooLarge);
  while (topology.nodes.size() <= api::kMaxFleetPlaces) {
    topology.nodes.push_back(place(topology.nodes.back().id + 1, {1.0, 0.0}));
  }
  topology.nodes.back().map_T_base.x_m = 2.0 * api::kMaxFleetReach_m;
  topology.current = topology.nodes.back().id;
  much.topology = api::within_limits(std::move(*much.topology));
  const auto taken = through_bytes(message_of(much));
  ASSERT_TRUE(taken) << taken.error().message;
  EXPECT_EQ(taken->topology->topology.current, 0U);
  EXPECT_EQ(api::within_limits(*share().topology), *share().topology) << "what is little stays as it is";
}

TEST(ConvertFleet, TheSceneOfAllRobotsComesBackUnchangedAndHoldsTheMainRobotToo) {
  api::FleetScene scene;
  scene.floor = {tile(-3, 0), tile(2, 9)};
  for (std::size_t k = 0; k < api::kMaxFleetRobots; ++k) {
    scene.robots.push_back(*share().topology);
    scene.robots.back().robot_id = "r" + std::to_string(k);
    scene.findings.push_back({"r" + std::to_string(k), detection(k + 1, {2.0, 3.0})});
  }
  pb::FleetReply reply;
  write(scene, &reply);
  pb::FleetReply again;
  ASSERT_TRUE(again.ParseFromString(reply.SerializeAsString()));
  EXPECT_EQ(from_message<api::FleetScene>(again).value(), scene);
  write(*share().topology, again.add_others());
  EXPECT_EQ(from_message<api::FleetScene>(again).error().code, Errc::kTooLarge);
}

}  // namespace
}  // namespace seeker::wire
