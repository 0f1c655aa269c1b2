// A map whose robot stays in a building that it knows.

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/unit/server/slam/visit.hpp"

namespace seeker::slam {
namespace {

constexpr int kScans = 10;
constexpr int kRounds = 12;
const Pose2 kHere{2.0, 2.5, 0.0};
const Pose2 kThere{5.5, 3.5, 0.4};
const Matrix3 kStep = Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal();

/// One more local map, which truly lies at `map_T_node`.
void visit_again(Visit& visit, MapBackend& backend, const Pose2& map_T_node) {
  backend.begin_next(inverse(backend.pose(backend.newest().id)) * map_T_node, kStep, visit.now());
  visit.look(backend, map_T_node, kScans);
  MapSegment wall;
  wall.id = backend.newest().id + 1;
  wall.node = backend.newest().id;
  wall.length_m = 1.0;
  backend.newest().segments_node.push_back(wall);
}

MapBackend begun(Visit& visit, std::size_t max_keyframes) {
  KnownGroundParams known;
  known.max_keyframes = max_keyframes;
  MapBackend backend({}, known);
  backend.begin_first(kHere, visit.now());
  visit.look(backend, kHere, kScans);
  return backend;
}

std::size_t scans_of(const MapBackend& backend) { return backend.assemble(backend.map_end()).keyframes.size(); }

TEST(KnownGround, MapOfOnePlaceStopsGrowingAtItsLimit) {
  Visit visit(21);
  MapBackend backend = begun(visit, 35);
  for (int round = 0; round < kRounds; ++round) {
    visit_again(visit, backend, kHere);
    backend.plan_loops({});
    for (int scan = 0; scan < 4; ++scan) {
      backend.step_loops();
    }
    EXPECT_LE(scans_of(backend), 35U + 2 * kScans) << "the two that the robot needs now, and what it is allowed";
  }
  const LineMap map = backend.assemble(backend.map_end());
  EXPECT_EQ(map.nodes.size(), std::size_t{kRounds} + 1) << "where the robot was is known still";
  EXPECT_GT(backend.loops().closed, kRounds);
  EXPECT_LE(map.edges.size(), map.nodes.size() + 12) << "one of each that was emptied";
  for (std::uint32_t id = 0; id < map.nodes.size(); ++id) {
    EXPECT_LT(distance_m(backend.pose(id), kHere), 0.05) << "local map " << id;
  }
  EXPECT_LT(map.segments.size(), 6U);
  ASSERT_TRUE(validate(map));
  MapBackend again;
  again.load(map, MapUse::kContinue);
  EXPECT_EQ(again.assemble(again.map_end()).keyframes, map.keyframes);
}

TEST(KnownGround, WithinItsLimitAMapKeepsEverything) {
  Visit visit(22);
  MapBackend backend = begun(visit, 4000);
  for (int round = 0; round < kRounds; ++round) {
    visit_again(visit, backend, kHere);
  }
  EXPECT_EQ(scans_of(backend), std::size_t{kScans} * (kRounds + 1));
}

TEST(KnownGround, WhatIsNewIsKeptHoweverLargeTheMapIs) {
  std::vector<Wall> walls = box(0.0, 0.0, 40.0, 6.0);
  for (const double x_m : {6.0, 12.0, 18.0, 24.0, 30.0}) {
    const auto shelf = box(x_m, 1.5, x_m + 0.5, 4.5);
    walls.insert(walls.end(), shelf.begin(), shelf.end());
  }
  Visit visit(23, walls);
  MapBackend backend = begun(visit, 0);
  constexpr int kSteps = 6;
  for (int step = 1; step <= kSteps; ++step) {
    visit_again(visit, backend, kHere * Pose2{6.0 * step, 0.0, 0.0});
  }
  EXPECT_EQ(scans_of(backend), std::size_t{kScans} * (kSteps + 1));
}

TEST(KnownGround, OtherViewsOfWhatIsKnownAreNotKept) {
  Visit visit(26, box(0.0, 0.0, 10.0, 6.0));
  MapBackend backend = begun(visit, 0);
  visit_again(visit, backend, kHere * Pose2{5.0, 1.0, 2.0});
  for (int step = 1; step <= 4; ++step) {
    visit_again(visit, backend, kHere * Pose2{0.9 * step, 0.2 * step, 0.5});
  }
  EXPECT_LE(scans_of(backend), std::size_t{4} * kScans);
}

TEST(KnownGround, PartThatIsJoinedByItsSecondLocalMapStaysJoined) {
  Visit visit(25);
  MapBackend backend = begun(visit, 0);
  visit_again(visit, backend, kHere);
  const std::uint32_t first = backend.begin_apart(visit.now());
  visit.look(backend, kHere, kScans);
  backend.begin_next({}, kStep, visit.now());
  visit.look(backend, kHere, kScans);
  backend.anchor(kHere, kStep);
  visit_again(visit, backend, kHere);
  visit_again(visit, backend, kHere);
  EXPECT_TRUE(backend.maps()[first].keyframes.empty());
  const LineMap map = backend.assemble(backend.map_end());
  const Status valid = validate(map);
  ASSERT_TRUE(valid) << valid.error().message;
  for (const MapNode& node : map.nodes) {
    const bool joined = std::any_of(map.edges.begin(), map.edges.end(),
                                    [&](const MapEdge& edge) { return edge.from == node.id || edge.to == node.id; });
    EXPECT_TRUE(joined) << "local map " << node.id;
    EXPECT_LT(distance_m(node.map_T_node, kHere), 0.05) << "local map " << node.id;
  }
}

TEST(KnownGround, PlaceThatHasChangedIsKeptAsItIsNow) {
  Visit visit(24);
  MapBackend backend = begun(visit, 0);
  visit_again(visit, backend, kThere);
  std::vector<Wall> cleared = box(0.0, 0.0, 10.0, 6.0);  // cupboard and pillar are gone
  const auto shelf = box(3.0, 1.0, 3.3, 4.5);
  cleared.insert(cleared.end(), shelf.begin(), shelf.end());
  visit.rearrange(cleared);
  const std::uint32_t changed = backend.newest().id + 1;
  for (const Pose2& place : {kHere, kThere, kHere, kThere}) {
    visit_again(visit, backend, place);
  }
  EXPECT_FALSE(backend.maps()[changed].keyframes.empty());
}

}  // namespace
}  // namespace seeker::slam
