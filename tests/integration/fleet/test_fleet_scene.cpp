// What an operator is shown of all robots of a fleet.

#include <algorithm>

#include "tests/integration/fleet/sharing_robots.hpp"

namespace seeker::testing {
namespace {

using app::FleetLeader;
using app::FleetLeaderParams;

TEST(FleetScene, ShowsAllRobotsInTheFrameOfTheMainOne) {
  const Point2 seen_by_main(4.0, 0.5);
  const Point2 seen_by_r1(2.0, -0.5);
  const Point2 found_by_r1(1.0, 0.5);
  const ToyHost main(west(), at_place("main", kPlace), {true, floor_with(seen_by_main), {}, {}});
  FleetLeaderParams params = patient_params("share_scene");
  params.floor_period = Duration::zero();
  FleetLeader leader(params, main.host());
  EXPECT_EQ(leader.scene().error().code, Errc::kNotReady) << "nobody has reported anything";
  join(leader, packed(east(), "r1"));
  const Pose2 west_T_r1 = *until(leader, "r1", placed).main_T_map;
  EXPECT_EQ(answer_to(leader, "r1", at_place("r1", kPlace)).state, api::FleetState::kMerged);
  ASSERT_TRUE(leader.seen({"r1", 1, true, floor_with(seen_by_r1), {found_at(1, found_by_r1)}, {}}));
  leader.refresh();
  leader.refresh();

  const Result<api::FleetScene> scene = leader.scene();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->robots.size(), 2U);
  EXPECT_EQ(scene->robots[0].robot_id, "main");
  EXPECT_THAT(scene->robots[0].map_T_base, Pose2Near(Pose2{kPlace.x(), kPlace.y(), 0.0}, 1e-9, 1e-9));
  EXPECT_THAT(scene->robots[1].topology.nodes.front().goals.front().p_map,
              Point2Near(west_T_r1 * (kPlace + Point2(3.0, 0.0)), 0.1));
  const auto floor = assemble(scene->floor);
  ASSERT_TRUE(floor);
  for (const Point2& p : {seen_by_main, Point2(west_T_r1 * seen_by_r1)}) {
    // Carried cell by cell into the frame of the main robot: the cell itself or one beside it.
    int most = 0;
    const CellIndex c = floor->frame().cell_of(p);
    for (int j = c.j - 1; j <= c.j + 1; ++j) {
      for (int i = c.i - 1; i <= c.i + 1; ++i) {
        const int value = floor->contains({i, j}) ? (*floor)[{i, j}] : kUnknownCell;
        most = std::max(most, value == kUnknownCell ? 0 : value);
      }
    }
    EXPECT_EQ(most, kOccupiedCell) << p.transpose();
  }
  ASSERT_EQ(scene->findings.size(), 1U);
  EXPECT_EQ(scene->findings[0].robot_id, "r1");
  EXPECT_THAT(*scene->findings[0].detection.position, Point2Near(west_T_r1 * found_by_r1, 1e-9));
}

}  // namespace
}  // namespace seeker::testing
