#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/explore/openings.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::explore {
namespace {

using seeker::testing::Point2Near;

/// A floor view of a picture, and ways from a place in it.
struct Scene {
  nav::FloorView floor;
  nav::DistanceField costs;
  std::vector<MapSegment> segments;
  nav::ForbiddenAreas areas;
  Pose2 map_T_base;

  [[nodiscard]] OpeningsInput at(double t_s) const {
    return {floor, costs, segments, areas, map_T_base, robot_time_s(t_s)};
  }
};

Scene scene_of(const std::vector<std::string>& rows, const Pose2& robot, const nav::ForbiddenAreas& areas = {},
               double resolution_m = 0.25) {
  const auto occupancy = nav::ascii_map(rows, resolution_m);
  nav::CostMapLimits limits;
  limits.bound = areas.bound;
  limits.keep_out = areas.keep_out;
  auto cost = nav::CostMap::build(occupancy, {}, limits);
  auto floor = nav::reachable_floor(*cost, robot.translation(), 0.2);
  auto costs = nav::DistanceField::build(*cost, robot.translation());
  return {{occupancy, *cost, *floor, 1, {}}, *costs, {}, areas, robot};
}

/// 5 x 4 m; a wall below that nobody has seen beyond x = 3 m, nor the floor beside it.
std::vector<std::string> half_seen() {
  std::vector<std::string> rows(16, "............        ");
  rows.front() = "############        ";
  rows.back() = "############        ";
  for (std::size_t k = 1; k + 1 < rows.size(); ++k) {
    rows[k].front() = '#';
  }
  return rows;
}

/// A segment along the row of '#' below, as seen from above: y points down, so that its left end lies at higher x.
MapSegment wall_below(double from_x, double to_x) {
  MapSegment segment;
  segment.id = 7;
  segment.map_T_segment = {0.5 * (from_x + to_x), 0.25, kPi};
  segment.length_m = to_x - from_x;
  segment.right_real = true;
  return segment;
}

TEST(Openings, FindTheBorderOfTheUnknownAndFaceIt) {
  const Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0});
  Openings openings{ViewpointParams{}};
  const auto found = openings.find(scene.at(0.0));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().kind, OpeningKind::kFrontier);
  EXPECT_NEAR(found.front().p_map.x(), 2.97, 0.06);
  EXPECT_NEAR(found.front().map_T_view.theta_rad, 0.0, 0.3);
  EXPECT_GT(found.front().size_m, 1.0);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; }));
}

TEST(Openings, FindTheEndOfAWallThatMayGoOn) {
  Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0});
  scene.segments = {wall_below(0.25, 3.0)};
  ViewpointParams params;
  const auto found = wall_end_openings(scene.at(0.0), params);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found.front().p_map, Point2Near(Point2(3.0, 0.25), 1e-9));
  EXPECT_THAT(found.front().outward_map, Point2Near(Point2(1.0, 0.0), 1e-9));
  EXPECT_NEAR(found.front().size_m, params.max_extension_m, 0.06);
  EXPECT_TRUE(scene.floor.cost.traversable(found.front().map_T_view.translation()));
  EXPECT_TRUE(well_in_view(found.front(), found.front().map_T_view, scene.floor.occupancy, params));
}

TEST(Openings, AWallThatMeetsAnotherOrEndsInSeenFloorDoesNotGoOn) {
  Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0});
  ViewpointParams params;
  MapSegment wall = wall_below(0.25, 3.0);
  MapSegment across;
  across.id = 8;
  across.map_T_segment = {3.2, 1.0, -kPi / 2.0};
  across.length_m = 1.6;
  scene.segments = {wall, across};
  EXPECT_LT(possible_extension_m(scene.floor.cost, scene.segments, wall, true, 2.0), params.min_extension_m);
  // In the middle of the floor nothing goes on.
  wall.map_T_segment.y_m = 2.0;
  wall.length_m = 1.0;
  scene.segments = {wall};
  EXPECT_LT(possible_extension_m(scene.floor.cost, scene.segments, wall, true, 2.0), params.min_extension_m);
}

TEST(Openings, WhatWasLookedAtWithoutChangeIsSettled) {
  const Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0});
  ViewpointParams params;
  Openings openings{params};
  double t_s = 0.0;
  // Every look takes its time; as many as there may be for each piece of border.
  for (int look = 0; look < 40; ++look, t_s += 10.0) {
    const auto found = openings.find(scene.at(t_s));
    if (found.empty()) {
      break;
    }
    openings.looked(found.front(), robot_time_s(t_s));
  }
  EXPECT_TRUE(openings.find(scene.at(t_s)).empty());
  EXPECT_TRUE(openings.given_up().empty());
}

TEST(Openings, AFailedDriveRestsAndIsGivenUpAfterSome) {
  const Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0});
  ViewpointParams params;
  Openings openings{params};
  const auto first = openings.find(scene.at(0.0));
  ASSERT_FALSE(first.empty());
  const std::uint64_t id = first.front().id;
  const auto find = [&](double t_s) -> std::optional<Opening> {
    for (const Opening& opening : openings.find(scene.at(t_s))) {
      if (opening.id == id) {
        return opening;
      }
    }
    return std::nullopt;
  };
  openings.failed(first.front(), robot_time_s(0.0));
  ASSERT_TRUE(find(1.0).has_value());
  EXPECT_TRUE(find(1.0)->resting);
  EXPECT_FALSE(find(params.retry_s + 1.0)->resting);
  for (int k = 1; k < params.max_failures; ++k) {
    openings.failed(first.front(), robot_time_s(100.0 * k));
  }
  EXPECT_FALSE(find(1000.0).has_value());
  ASSERT_EQ(openings.given_up().size(), 1U);
  EXPECT_THAT(openings.given_up().front().p_map, Point2Near(first.front().p_map, 1e-9));
  EXPECT_DOUBLE_EQ(openings.given_up().front().size_m, first.front().size_m);
  EXPECT_GT(first.front().size_m, 0.0);
}

TEST(Openings, WhatWasGivenUpIsTriedOnceMoreWhenAskedTo) {
  const Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0});
  const ViewpointParams params;
  Openings openings{params};
  const auto found = openings.find(scene.at(0.0));
  for (const Opening& opening : found) {
    for (int k = 0; k < params.max_failures; ++k) {
      openings.failed(opening, robot_time_s(0.0));
    }
  }
  ASSERT_TRUE(openings.find(scene.at(1.0)).empty());
  openings.try_again();
  const auto again = openings.find(scene.at(2.0));
  ASSERT_EQ(again.size(), found.size());
  EXPECT_FALSE(again.front().resting);
  for (const Opening& opening : again) {
    openings.failed(opening, robot_time_s(2.0));
  }
  EXPECT_TRUE(openings.find(scene.at(100.0)).empty()) << "one failure more is enough";
  EXPECT_FALSE(openings.given_up().empty());
}

TEST(Openings, WhatNoDriveReachedButWasSeenFromElsewhereIsNotGivenUp) {
  Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0});
  scene.segments = {wall_below(0.25, 3.0)};
  const ViewpointParams params;
  Openings openings{params};
  for (const Opening& opening : openings.find(scene.at(0.0))) {
    for (int k = 0; k < params.max_failures && opening.kind != OpeningKind::kWallFace; ++k) {
      openings.failed(opening, robot_time_s(0.0));
    }
  }
  (void)openings.find(scene.at(100.0));
  EXPECT_FALSE(openings.given_up().empty());
  std::vector<std::string> seen = half_seen();
  for (std::string& row : seen) {
    std::replace(row.begin(), row.end(), ' ', '.');
  }
  scene = scene_of(seen, {1.0, 2.0, 0.0});
  scene.segments = {wall_below(0.25, 5.0)};
  (void)openings.find(scene.at(200.0));
  EXPECT_TRUE(openings.given_up().empty());
}

TEST(Openings, BeyondTheBoundNothingIsOpen) {
  nav::ForbiddenAreas areas;
  areas.bound = Polygon{{-1.0, -1.0}, {2.9, -1.0}, {2.9, 6.0}, {-1.0, 6.0}};
  const Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0}, areas);
  Openings openings{ViewpointParams{}};
  EXPECT_TRUE(openings.find(scene.at(0.0)).empty());
}

/// A room seen through nothing but its door: the floor beside the wall on the right is known, the wall's near side is
/// not. Its far side is: the column of '#'.
Scene back_of_a_wall(const Pose2& robot) {
  std::vector<std::string> rows(16, "#............................ #");
  rows.front() = rows.back() = std::string(rows.front().size(), '#');
  return scene_of(rows, robot, {}, 0.1);
}

TEST(Openings, FindTheUnseenSideOfAThinWallAndAPlaceThatShowsIt) {
  const Scene scene = back_of_a_wall({1.0, 0.8, kPi});
  Openings openings{ViewpointParams{}};
  const auto found = openings.find(scene.at(0.0));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().kind, OpeningKind::kWallFace);
  EXPECT_NEAR(found.front().p_map.x(), 2.85, 0.1);
  EXPECT_TRUE(well_in_view(found.front(), found.front().map_T_view, scene.floor.occupancy, {}));
  EXPECT_TRUE(scene.costs.cost_to(found.front().map_T_view.translation())) << "a place that the robot can reach";
}

TEST(Openings, BordersAloneLeaveWallsOut) {
  const Scene scene = back_of_a_wall({1.0, 0.8, kPi});
  OpeningsInput input = scene.at(0.0);
  input.walls = false;
  EXPECT_TRUE(Openings{ViewpointParams{}}.find(input).empty()) << "the floor before the wall is too narrow to enter";
}

/// A wall from `from` to `to`, the free side on the right of that way.
MapSegment wall_between(const Point2& from, const Point2& to) {
  const Point2 along = to - from;
  const Point2 middle = 0.5 * (from + to);
  MapSegment segment;
  segment.id = 9;
  segment.map_T_segment = {middle.x(), middle.y(), std::atan2(along.y(), along.x())};
  segment.length_m = along.norm();
  segment.left_real = segment.right_real = true;
  return segment;
}

/// 4 x 4 m, all of it seen; three of its walls are in the map.
Scene room_with_three_walls_mapped() {
  std::vector<std::string> rows(16, "#..............#");
  rows.front() = rows.back() = std::string(16, '#');
  Scene scene = scene_of(rows, {1.0, 2.0, 0.0});
  scene.segments = {wall_between({0.25, 0.25}, {0.25, 3.75}), wall_between({0.25, 3.75}, {3.75, 3.75}),
                    wall_between({3.75, 0.25}, {0.25, 0.25})};
  return scene;
}

TEST(Openings, AWallThatWasSeenButIsInNoSegmentIsLeft) {
  Scene scene = room_with_three_walls_mapped();
  const auto found = wall_face_openings(scene.at(0.0), {});
  ASSERT_FALSE(found.empty());
  for (const Opening& opening : found) {
    EXPECT_NEAR(opening.p_map.x(), 3.7, 0.1);
    EXPECT_GT(opening.outward_map.x(), 0.9);
  }
  scene.segments.push_back(wall_between({3.75, 3.75}, {3.75, 0.25}));
  EXPECT_TRUE(wall_face_openings(scene.at(0.0), {}).empty());
}

TEST(Openings, AWallThatAnotherRobotHasMappedNeedsNoVisit) {
  const Scene scene = room_with_three_walls_mapped();
  const std::vector<MappedSide> others{{{3.75, 3.75}, {3.75, 0.25}}};
  OpeningsInput input = scene.at(0.0);
  ASSERT_FALSE(wall_face_openings(input, {}).empty());
  input.others_sides = others;
  EXPECT_TRUE(wall_face_openings(input, {}).empty());
  const std::vector<MappedSide> from_behind{{{3.75, 0.25}, {3.75, 3.75}}};
  input.others_sides = from_behind;
  EXPECT_FALSE(wall_face_openings(input, {}).empty()) << "that is the side in the next room";
}

TEST(Openings, AWallGoesOnNoFurtherThanToWhatAnotherRobotHasMapped) {
  Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0});
  scene.segments = {wall_below(0.25, 3.0)};
  OpeningsInput input = scene.at(0.0);
  ASSERT_EQ(wall_end_openings(input, {}).size(), 1U);
  const std::vector<MappedSide> others{{{5.0, 0.3}, {2.9, 0.3}}};
  input.others_sides = others;
  EXPECT_TRUE(wall_end_openings(input, {}).empty());
}

TEST(Openings, TheOtherSideOfAThinWallDoesNotCountAsMapped) {
  Scene scene = room_with_three_walls_mapped();
  scene.segments.push_back(wall_between({3.85, 0.25}, {3.85, 3.75}));  // seen from the right
  EXPECT_FALSE(wall_face_openings(scene.at(0.0), {}).empty());
}

TEST(Openings, AnUnseenSideThatStaysUnseenIsSettled) {
  const Scene scene = back_of_a_wall({2.0, 0.8, 0.0});
  Openings openings{ViewpointParams{}};
  for (int k = 0; k < ViewpointParams{}.max_visits; ++k) {
    (void)openings.find(scene.at(2.0 * k));
  }
  EXPECT_TRUE(openings.find(scene.at(10.0)).empty());
}

TEST(Openings, TheTwoSidesOfAThinWallAreSettledEachByItself) {
  // A wall 0.1 m thick into seen floor, which no segment holds; the robot looks at it from the left.
  std::vector<std::string> rows(45, std::string(60, '.'));
  rows.front() = std::string(60, '#');
  for (std::size_t k = 0; k < 30; ++k) {
    rows[k][30] = '#';
  }
  Scene scene = scene_of(rows, {1.9, 3.75, 0.0}, {}, 0.1);
  scene.segments = {wall_between({0.0, 4.4}, {6.0, 4.4})};
  Openings openings{ViewpointParams{}};
  for (int k = 0; k < ViewpointParams{}.max_visits; ++k) {
    (void)openings.find(scene.at(2.0 * k));
  }
  bool seen_side = false;
  bool other_side = false;
  for (const Opening& opening : openings.find(scene.at(10.0))) {
    const bool at_wall =
        opening.kind == OpeningKind::kWallFace && opening.p_map.y() > 2.5 && std::abs(opening.p_map.x() - 3.05) < 0.5;
    seen_side = seen_side || (at_wall && opening.outward_map.x() > 0.9);
    other_side = other_side || (at_wall && opening.outward_map.x() < -0.9);
  }
  EXPECT_FALSE(seen_side) << "the robot looks at it";
  EXPECT_TRUE(other_side) << "the robot cannot see it";
}

TEST(Openings, WhatIsSettledStaysSoWhenTheMapBends) {
  // The robot's pose is corrected by 0.8 m; what is left to explore lies where it was.
  const Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0});
  Openings openings{ViewpointParams{}};
  double t_s = 0.0;
  for (int look = 0; look < 40; ++look, t_s += 10.0) {
    for (const Opening& opening : openings.find(scene.at(t_s))) {
      openings.looked(opening, robot_time_s(t_s));
    }
  }
  ASSERT_TRUE(openings.find(scene.at(t_s)).empty());
  openings.transform(Pose2{0.5, 0.0, 0.0});
  openings.transform(Pose2{0.3, 0.0, 0.0});
  t_s += 100.0;  // nobody has looked for openings since
  EXPECT_TRUE(openings.find(scene.at(t_s)).empty());
  EXPECT_TRUE(openings.find(scene.at(t_s + 100.0)).empty()) << "it has taken its place from what was found";
}

TEST(Openings, ASmallPocketOfUnknownIsNoise) {
  std::vector<std::string> rows(16, "#..................#");
  rows.front() = rows.back() = std::string(20, '#');
  rows[8][10] = ' ';
  Scene scene = scene_of(rows, {1.0, 2.0, 0.0});
  Openings openings{ViewpointParams{}};
  EXPECT_TRUE(openings.find(scene.at(0.0)).empty());
  rows[8][11] = rows[7][10] = rows[7][11] = ' ';
  scene = scene_of(rows, {1.0, 2.0, 0.0});
  EXPECT_FALSE(openings.find(scene.at(0.0)).empty());
}

TEST(Openings, FloorBehindAWallOfWhichSomeIsSeenIsCutOff) {
  std::vector<std::string> rows(16, "#..................#");
  rows.front() = rows.back() = std::string(20, '#');
  for (std::string& row : rows) {
    row[10] = '#';
  }
  rows[8][10] = '.';  // a gap of 0.25 m
  const Scene scene = scene_of(rows, {1.0, 2.0, 0.0});
  const auto places = cut_off_floor(scene.floor.cost, scene.costs, 1.0);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_GT(places.front().p_map.x(), 2.75);
}

// The memory survives a moved map: the same opening has the same id wherever the map went.
RC_GTEST_PROP(Openings, KeepTheirIdsWhenTheMapMoves, ()) {
  const auto dx = static_cast<double>(*rc::gen::inRange(-40, 40)) * 0.25;
  const auto dy = static_cast<double>(*rc::gen::inRange(-40, 40)) * 0.25;
  const Pose2 new_T_old{dx, dy, 0.0};
  Scene scene = scene_of(half_seen(), {1.0, 2.0, 0.0});
  Openings openings{ViewpointParams{}};
  const auto before = openings.find(scene.at(0.0));
  openings.transform(new_T_old);
  GridFrame frame = scene.floor.occupancy.frame();
  frame.origin += Point2(dx, dy);
  Grid<std::uint8_t> moved(frame, scene.floor.occupancy.width(), scene.floor.occupancy.height());
  moved.cells() = scene.floor.occupancy.cells();
  const auto cost = nav::CostMap::build(moved);
  const Pose2 robot = new_T_old * scene.map_T_base;
  const auto costs = nav::DistanceField::build(*cost, robot.translation());
  const Scene after_scene{
      {moved, *cost, *nav::reachable_floor(*cost, robot.translation(), 0.2), 2, {}}, *costs, {}, {}, robot};
  const auto after = openings.find(after_scene.at(0.1));
  RC_ASSERT(before.size() == after.size());
  for (const Opening& opening : before) {
    const auto same = std::find_if(after.begin(), after.end(), [&](const Opening& o) { return o.id == opening.id; });
    RC_ASSERT(same != after.end());
    RC_ASSERT((same->p_map - new_T_old * opening.p_map).norm() < 0.2);
  }
}

}  // namespace
}  // namespace seeker::explore
