// A mission that a crash cut off: what is kept of it, and how the robot is looked for.

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/app/loop/mission_checkpoints.hpp"
#include "server/app/loop/mission_resumption.hpp"

namespace seeker::app {
namespace {

using std::chrono::seconds;

const RobotTime kStart{seconds(10)};

api::MissionRequest exploration() {
  api::MissionRequest request;
  request.id = "round";
  request.task = api::ExploreMission{};
  return request;
}

TEST(MissionResumption, OnlyMissionsThatBuildAMapNeedOne) {
  MissionResumption resumption(RobotMapParams{});
  EXPECT_FALSE(resumption.needs_map());
  resumption.offer(exploration());
  EXPECT_TRUE(resumption.needs_map());
  EXPECT_TRUE(resumption.is_of("round"));
  EXPECT_FALSE(MissionCheckpoints::wanted_for(api::GotoMission{}));
}

TEST(MissionResumption, ARobotThatIsNotFoundTurnsOnceOnTheSpot) {
  const RobotMapParams params;
  MissionResumption resumption(params);
  resumption.offer(exploration());
  resumption.begin_search({}, "tester", kStart);
  EXPECT_EQ(resumption.look_round(0.0, kStart), Twist2{}) << "it may be found without";
  const RobotTime later = kStart + params.look_round_after;
  double heading_rad = 0.0;
  double turned_rad = 0.0;
  while (resumption.look_round(heading_rad, later) != Twist2{}) {
    heading_rad = wrap_angle(heading_rad + 0.1);
    turned_rad += 0.1;
    ASSERT_LT(turned_rad, 10.0) << "it never ends";
  }
  EXPECT_NEAR(turned_rad, kTwoPi, 0.25);
}

TEST(MissionResumption, WithoutItsMapOnlyTheTimeItRanStillHolds) {
  MissionResumption resumption(RobotMapParams{});
  resumption.offer(exploration());
  KeptState kept;
  kept.map_T_base = Pose2{1.0, 0.0, 0.0};
  kept.so_far = {Point2(1.0, 2.0), seconds(30)};
  resumption.begin_search(kept, "tester", kStart);
  EXPECT_TRUE(resumption.has_own_map());
  resumption.go_on_without_map(resumption.kept().so_far);
  EXPECT_FALSE(resumption.has_own_map());
  EXPECT_FALSE(resumption.kept().so_far.start_map);
  EXPECT_EQ(resumption.kept().so_far.running, Duration(seconds(30)));
}

TEST(MissionResumption, AMissionThatBeginsEndsTheOffer) {
  MissionResumption resumption(RobotMapParams{});
  resumption.offer(exploration());
  resumption.mission_began();
  EXPECT_FALSE(resumption.unfinished());
  EXPECT_FALSE(resumption.needs_map());
}

}  // namespace
}  // namespace seeker::app
