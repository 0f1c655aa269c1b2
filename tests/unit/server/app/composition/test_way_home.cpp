// The way home of a robot whose client is gone, as the factory of a simulated robot makes it.

#include <gtest/gtest.h>

#include "server/app/composition/robot_assembly.hpp"
#include "tests/support/data.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::app {
namespace {

using testing::source_file;

/// A hall of 12 m x 6 m, whose west end the robot has started in.
class WayHome : public ::testing::Test {
 protected:
  WayHome() {
    const RobotOptions options = load_robot_options(source_file("config/robots/sim.yaml")).value();
    assembly = assemble(options).value();
  }

  /// From where it is now the robot sees so much of the hall.
  void see(double fov_rad) {
    std::vector<std::string> rows(8, "#............#");
    rows.front() = rows.back() = "##############";
    const Grid<std::uint8_t> hall = nav::ascii_map(rows, 1.0);
    const Pose2 hall_T_map{2.5, 4.0, 0.0};
    const LaserScan scan = nav::scan_in(hall, hall_T_map * map_T_base, 1441, fov_rad);
    for (int k = 0; k < 5; ++k) {
      ASSERT_TRUE(map.integrate(scan, map_T_base));
    }
  }

  [[nodiscard]] Decision step(double now_s) {
    situation.now = robot_time_s(now_s);
    return behaviour->step(situation);
  }
  [[nodiscard]] Decision first_step(const api::ReturnMission& mission) {
    situation.pose.map_T_base = map_T_base;
    situation.pose.quality = LocalisationQuality::kLocalised;
    situation.map = &map;
    behaviour = assembly.parts.behaviours(mission, situation).value();
    return step(1.0);
  }

  Assembly assembly;
  nav::OccupancyMap map;
  Pose2 map_T_base{7.0, 0.0, 0.0};
  Situation situation;
  std::unique_ptr<Behaviour> behaviour;
};

TEST_F(WayHome, LeadsAroundWhatTheMissionKeepsOut) {
  see(kTwoPi);
  const Polygon stairs{{3.0, -1.0}, {4.0, -1.0}, {4.0, 1.0}, {3.0, 1.0}};
  EXPECT_EQ(first_step({}).planned_path.size(), 2U) << "nothing else is in the way";
  const std::vector<Point2> way = first_step({std::nullopt, {stairs}}).planned_path;
  ASSERT_GT(way.size(), 2U);
  EXPECT_THAT(way.back(), testing::Point2Near(Point2(0.0, 0.0), 0.1));
  for (std::size_t k = 1; k < way.size(); ++k) {
    for (double t = 0.0; t <= 1.0; t += 0.05) {
      const Point2 p = way[k - 1] + t * (way[k] - way[k - 1]);
      EXPECT_FALSE(contains(stairs, p)) << p.transpose();
    }
  }
}

TEST_F(WayHome, LeadsAlongTheTravelledPathAndLeavesOutWhatIsBlockedNow) {
  see(kTwoPi);
  api::ReturnMission mission;
  mission.along = {{5.0, 2.0}, {2.0, 2.0}};
  const std::vector<Point2> way = first_step(mission).planned_path;
  ASSERT_FALSE(way.empty());
  EXPECT_THAT(way.back(), testing::Point2Near(Point2(5.0, 2.0), 0.1)) << "where it came by";
  mission.along = {{5.0, 9.0}, {2.0, 9.0}};  // behind a wall now
  (void)first_step(mission);
  std::vector<Point2> home;
  for (double now_s = 1.1; now_s < 3.0; now_s += 0.1) {
    home = step(now_s).planned_path;
  }
  ASSERT_FALSE(home.empty());
  EXPECT_THAT(home.back(), testing::Point2Near(Point2(0.0, 0.0), 0.1));
}

TEST_F(WayHome, StaysInsideTheBoundAndOnFloorThatTheRobotHasSeen) {
  see(kTwoPi);
  const Polygon east{{2.0, -3.0}, {12.0, -3.0}, {12.0, 3.0}, {2.0, 3.0}};
  const Decision outside = first_step({east, {}});
  ASSERT_TRUE(outside.end);
  EXPECT_EQ(outside.end->outcome, api::Outcome::kUnreachable);
  EXPECT_EQ(positions_of(outside.end->unreachable), std::vector<Point2>{Point2::Zero()});
  EXPECT_EQ(outside.end->unreachable.front().cause, UnreachableCause::kOutsideBound);
  map.clear();
  see(kPi);
  Decision unseen = first_step({});
  for (double now_s = 2.0; now_s < 120.0 && !unseen.end; now_s += 1.0) {
    EXPECT_EQ(unseen.command.v_m_s, 0.0) << "nobody knows what lies behind it";
    unseen = step(now_s);
  }
  ASSERT_TRUE(unseen.end);
  EXPECT_EQ(unseen.end->outcome, api::Outcome::kUnreachable);
  EXPECT_EQ(unseen.end->unreachable.front().cause, UnreachableCause::kUnknownFloor);
  EXPECT_NE(unseen.end->remedy.find("explore"), std::string::npos) << unseen.end->remedy;
}

}  // namespace
}  // namespace seeker::app
