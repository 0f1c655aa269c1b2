// Three robots explore one building, each with a server of its own, over real sockets.

#include "tests/integration/processes/fleet_team.hpp"

namespace seeker::testing {
namespace {

TEST(FleetMissions, ThreeRobotsMapOneBuildingTogether) {
  constexpr std::size_t kRobots = 3;
  Team team("fleet_three", source_file("tests/support/worlds/studio.yaml"), kRobots);
  std::vector<std::unique_ptr<Watcher>> watchers;
  for (std::size_t k = 0; k < kRobots; ++k) {
    team.start(k);
    watchers.push_back(std::make_unique<Watcher>(team.robot(k)));
  }
  for (std::size_t k = 0; k < kRobots; ++k) {
    team.explore(k);
  }
  for (const auto& watcher : watchers) {
    const api::MissionStatus mission = watcher->end(seconds(300));
    EXPECT_EQ(mission.end->outcome, api::Outcome::kComplete) << mission.end->cause;
  }
  const FleetOutcome outcome = team.outcome();
  team.expect_near_truth(outcome.fleet, 0.2, 2.0);
  std::uint32_t nodes = 0;
  for (const api::FleetMember& member : outcome.fleet.members) {
    nodes += member.nodes;
  }
  EXPECT_EQ(outcome.map.nodes.size(), nodes) << "every robot's local maps are in the joint one";
  constexpr double kOuterWalls_m = 40.0;
  EXPECT_GT(WallCells(outcome.map).length_m(), 0.8 * kOuterWalls_m);
}

}  // namespace
}  // namespace seeker::testing
