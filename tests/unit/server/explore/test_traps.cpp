#include <cmath>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "common/core/polygon.hpp"
#include "scenes.hpp"
#include "server/explore/one_step.hpp"
#include "server/explore/trap_watch.hpp"
#include "server/explore/wall_follower.hpp"
#include "server/nav/occupancy_map.hpp"

namespace seeker::explore {
namespace {

using test::kNorth;
using test::wall;

TEST(TrapWatch, ThreeHopelessDecisionsInARowAreATrap) {
  TrapWatch watch({});
  EXPECT_FALSE(watch.note(true, {10.0, 4, 5.0}));
  EXPECT_FALSE(watch.note(true, {11.0, 4, 6.0}));
  EXPECT_FALSE(watch.note(false, {12.0, 4, 7.0}));
  EXPECT_FALSE(watch.note(true, {13.0, 4, 8.0}));
  EXPECT_FALSE(watch.note(true, {14.0, 4, 9.0}));
  EXPECT_TRUE(watch.note(true, {15.0, 4, 10.0}));
}

TEST(TrapWatch, PromisesThatAreNeverKeptAreATrap) {
  TrapWatch watch({});
  EXPECT_FALSE(watch.note(false, {10.0, 4, 5.0}));
  for (int k = 0; k < 5; ++k) {
    EXPECT_FALSE(watch.note(false, {k % 2 == 0 ? 9.0 : 10.0, 4, 5.0})) << "walls that come and go are no growth";
  }
  EXPECT_TRUE(watch.note(false, {10.0, 4, 5.0}));
  watch.reset();
  EXPECT_FALSE(watch.note(false, {10.0, 4, 5.0}));
}

TEST(TrapWatch, NewFloorIsGrowthToo) {
  TrapWatch watch({});
  for (int k = 0; k < 20; ++k) {
    EXPECT_FALSE(watch.note(false, {10.0, 4, 5.0 + k}));
  }
}

/// A room of 6 x 4 m seen from inside, going round counter-clockwise: bottom, right, top, left wall.
std::vector<MapSegment> room() {
  return {wall({6.0, 0.0}, {0.0, 0.0}, {true, true}), wall({6.0, 4.0}, {6.0, 0.0}, {true, true}),
          wall({0.0, 4.0}, {6.0, 4.0}, {true, true}), wall({0.0, 0.0}, {0.0, 4.0}, {true, true})};
}

TEST(WallGraph, ARoomOfRealEndsLeadsNowhere) {
  EXPECT_FALSE(route_to_open_end(room(), 0, 0.0, WallSide::kLeft, 1.0));
  EXPECT_FALSE(route_to_open_end(room(), 0, 0.0, WallSide::kRight, 1.0));
}

TEST(WallGraph, CountsTheWayAlongWallsAndOverGaps) {
  std::vector<MapSegment> walls = room();
  walls[1] = wall({6.0, 3.5}, {6.0, 0.5}, {false, true});  // the right wall is open 0.5 m before its upper end
  const auto left = route_to_open_end(walls, 0, 1.0, WallSide::kLeft, 1.0);
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->cost_m, 4.0 + 0.5 + 3.0, 1e-9) << "x = 1 is 4 m from the left end at x = -3";
  EXPECT_EQ(left->segments, (std::vector<std::size_t>{0, 1}));
  EXPECT_FALSE(route_to_open_end(walls, 0, 1.0, WallSide::kRight, 0.3)) << "the gap is too wide now";
}

TEST(WallGraph, OnlyAnEndThatContinuesTheWalkIsAdjacent) {
  const std::vector<MapSegment> walls{wall({1.0, 0.0}, {0.0, 0.0}), wall({1.2, 0.0}, {1.2, 2.0}),
                                      wall({1.3, 2.0}, {1.3, 0.0})};
  EXPECT_EQ(adjacent_segment(walls, 0, WallSide::kLeft, 1.0), 2U) << "segment 1 begins there with its left end";
}

/// A robot that follows walls of a map that does not change, as fast as its decisions allow.
struct Walk {
  std::vector<MapSegment> walls;
  Pose2 pose;
  double nearest_m = 100.0;
  std::string failure;
  std::vector<Pose2> poses;
  WallParams params;

  explicit Walk(std::vector<MapSegment> segments, const Pose2& start, const WallParams& wall_params = {})
      : walls(std::move(segments)), pose(start), params(wall_params) {}

  bool run(int decisions) {
    const OneStepParams step;
    WallFollower follower(step, params);
    if (!follower.start(pose, walls)) {
      return false;
    }
    nav::FloorSource floors({}, {}, 0.2, 1.0);
    const nav::OccupancyMap empty;
    for (int k = 0; k < decisions; ++k) {
      const RobotTime now = robot_time_s(4.0 * k);
      floors.attend(empty, pose, now);
      const StrategyInput input{{now, pose, nullptr, nullptr, floors}, {}, Matrix3::Zero(), walls, 1, {}};
      const SightScene scene = scene_around(input, walls, step, nullptr);
      const WallChoice choice = follower.decide(pose, walls, ControlCheck(input, scene, 0.30, 0.6));
      failure = choice.failure;
      if (!choice.control) {
        return true;
      }
      for (int tick = 0; tick < 40; ++tick) {
        pose = pose * integrate(*choice.control, 0.1);
        for (const MapSegment& one : walls) {
          nearest_m = std::min(nearest_m, distance_to_segment_m(one.left(), one.right(), pose.translation()));
        }
      }
      poses.push_back(pose);
    }
    return true;
  }
};

TEST(WallFollower, GoesRoundInnerCornersToTheOpenEnd) {
  std::vector<MapSegment> walls = room();
  walls[2] = wall({2.0, 4.0}, {6.0, 4.0}, {false, true});  // open at (2, 4): along the bottom, the right wall, the top
  Walk walk(walls, {2.0, 1.0, 0.0});
  ASSERT_TRUE(walk.run(60));
  EXPECT_EQ(walk.failure, "the open end was passed and the wall does not go on");
  EXPECT_GT(walk.nearest_m, 0.3);
  EXPECT_NEAR(walk.pose.x_m, 1.5, 0.5);
  EXPECT_NEAR(walk.pose.y_m, 3.4, 0.2) << "0.6 m from the wall";
}

TEST(WallFollower, GoesRoundAnOuterCorner) {
  // South of a block, with its face on the right hand: westwards, then round the corner to the north.
  const std::vector<MapSegment> walls{wall({0.0, 0.0}, {4.0, 0.0}, {true, true}),
                                      wall({0.0, 4.0}, {0.0, 0.0}, {false, true})};
  Walk walk(walls, {2.0, -0.7, kPi});
  ASSERT_TRUE(walk.run(40));
  EXPECT_EQ(walk.failure, "the open end was passed and the wall does not go on");
  EXPECT_GT(walk.nearest_m, 0.3);
  EXPECT_LT(walk.pose.x_m, -0.3);
  EXPECT_GT(walk.pose.y_m, 3.9);
}

TEST(WallFollower, TakesTheShorterWayRound) {
  std::vector<MapSegment> walls = room();
  walls[3] = wall({0.0, 0.0}, {0.0, 3.0}, {true, false});
  WallFollower follower({}, {});
  ASSERT_TRUE(follower.start({1.0, 0.5, 0.0}, walls));
  EXPECT_EQ(follower.followed(), walls[0].id);
  EXPECT_EQ(follower.side(), WallSide::kRight) << "over the lower left corner";
}

TEST(WallFollower, HasNoWayWhereEveryEndIsReal) {
  WallFollower follower({}, {});
  EXPECT_FALSE(follower.start({2.0, 1.0, 0.0}, room()));
  EXPECT_FALSE(follower.start({2.0, 1.0, 0.0}, {}));
}

/// As in spec S1.12, without planned paths.
WallParams whole_lap() {
  WallParams params;
  params.adjacency_m = 0.4;
  params.whole_lap = true;
  return params;
}

TEST(WallFollower, GoesRoundARoomOfRealEndsOnceWhenItIsToMakeAWholeLap) {
  Walk walk(room(), {2.0, 1.0, 0.0}, whole_lap());
  ASSERT_TRUE(walk.run(100));
  EXPECT_EQ(walk.failure, "one lap along the walls has shown nothing new");
  EXPECT_GT(walk.nearest_m, 0.3);
  EXPECT_NEAR(walk.pose.x_m, 2.0, 0.7) << "back where it began";
  const auto at_the_top = [](const Pose2& pose) { return pose.y_m > 3.0; };
  EXPECT_TRUE(std::any_of(walk.poses.begin(), walk.poses.end(), at_the_top));
}

TEST(WallFollower, RoundsAnEndThatNoWallContinuesOnItsLap) {
  Walk walk({wall({0.0, 0.0}, {4.0, 0.0}, {false, true})}, {2.0, -0.7, kPi}, whole_lap());
  ASSERT_TRUE(walk.run(12));
  EXPECT_EQ(walk.failure, "");
  EXPECT_GT(walk.nearest_m, 0.3);
  const auto behind = [](const Pose2& pose) { return pose.y_m > 0.1; };
  EXPECT_TRUE(std::any_of(walk.poses.begin(), walk.poses.end(), behind));
}

TEST(WallFollower, NeverComesNearALineThatItIsParallelToWithoutLookingAhead) {
  const std::vector<MapSegment> walls{wall({-20.0, 0.0}, {4.0, 0.0}, {false, true})};
  WallParams params;
  params.ahead_m = 0.0;
  Walk straight(walls, {2.0, -2.6, kPi}, params);
  ASSERT_TRUE(straight.run(8));
  EXPECT_LT(straight.pose.y_m, -2.2) << "every control that leads nearer turns it away from the line's direction";
  Walk ahead(walls, {2.0, -2.6, kPi});
  ASSERT_TRUE(ahead.run(8));
  EXPECT_GT(ahead.pose.y_m, -1.2);
}

std::string refusal(const std::vector<MapSegment>& walls, const Pose2& pose, const Twist2& control) {
  nav::FloorSource floors({}, {}, 0.2, 1.0);
  const nav::OccupancyMap empty;
  floors.attend(empty, pose, {});
  const StrategyInput input{{{}, pose, nullptr, nullptr, floors}, {}, Matrix3::Zero(), walls, 1, {}};
  return ControlCheck(input, scene_around(input, walls, {}, nullptr), 0.30, 0.6).refusal(control, 4.0);
}

TEST(ControlCheck, ADoorOf80CentimetresIsPassedAndItsPostsAreNot) {
  const std::vector<MapSegment> door{wall({0.0, 0.4}, {0.0, 2.0}), wall({0.0, -2.0}, {0.0, -0.4})};
  EXPECT_EQ(refusal(door, {-0.5, 0.0, 0.0}, {0.15, 0.0}), "");
  EXPECT_EQ(refusal(door, {-0.5, 0.08, 0.0}, {0.15, 0.0}), "");
  EXPECT_NE(refusal(door, {-0.5, 0.2, 0.0}, {0.15, 0.0}), "");
  EXPECT_NE(refusal(door, {-0.5, 1.0, 0.0}, {0.15, 0.0}), "");
}

TEST(ControlCheck, ARobotTooNearToAWallMayLeaveIt) {
  const std::vector<MapSegment> close{wall({-1.0, 0.28}, {1.0, 0.28})};
  EXPECT_EQ(refusal(close, {0.0, 0.0, -kNorth}, {0.15, 0.0}), "");
  EXPECT_NE(refusal(close, {0.0, 0.0, kNorth}, {0.05, 0.0}), "");
  EXPECT_EQ(refusal(close, {0.0, 0.0, kNorth}, {0.0, 0.17}), "") << "turning meets nothing";
}

}  // namespace
}  // namespace seeker::explore
