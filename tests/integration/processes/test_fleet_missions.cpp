// Three robots explore one building, each with a server of its own, over real sockets: undisturbed, and over the death
// of their programs and a cut link.

#include "tests/integration/processes/fleet_team.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/net/chaos_proxy.hpp"

namespace seeker::testing {
namespace {

constexpr std::size_t kRobots = 3;
constexpr std::size_t kMain = 0;
constexpr std::size_t kKilled = 1;
constexpr std::size_t kCut = 2;
constexpr seconds kCutFor{60};  ///< of robot time: missions live in it, and the world runs faster than life
constexpr seconds kMissionLimit{300};

class Expedition {
 public:
  explicit Expedition(const std::string& name)
      : team_(name, source_file("tests/support/worlds/studio.yaml"), kRobots), watchers_(kRobots) {
    team_.start(kMain);
    link_.emplace(team_.fleet_port());
    team_.start(kKilled);
    team_.start(kCut, link_->port());
    for (std::size_t k = 0; k < kRobots; ++k) {
      watchers_[k] = std::make_unique<Watcher>(team_.robot(k));
    }
    for (std::size_t k = 0; k < kRobots; ++k) {
      team_.explore(k);
    }
  }

  void kill_and_restart(std::size_t k) {
    kill(k);
    restart(k);
  }
  /// As soon as there is something to lose, and hardly anything to find the robot by but where it stood.
  void kill_at_first_checkpoint(std::size_t k) {
    EXPECT_TRUE(wait_for_file(team_.checkpoint(k), kStart));
    stop_world_at_kept_place(k);
    kill(k);
    team_.let_world_go_on();
    restart(k);
    std::string output;
    EXPECT_EQ(seeker(team_.robot(k), {"resume"}, &output), 0) << output;
  }
  void cut_link() {
    link_->impair({.drop = 1.0});
    link_->cut();
    cut_at_ = watchers_[kCut]->status().stamp;
  }
  /// A robot that has ended its mission lets the world go on without it: then its own time says no more.
  void mend_link() {
    const api::RobotStatus now = watchers_[kCut]->until(
        [&](const api::MissionStatus& mission) { return mission.end || mission.updated - cut_at_ >= kCutFor; });
    EXPECT_GE(now.stamp - cut_at_, kCutFor);
    link_->impair({});
  }
  void expect_complete() {
    for (const auto& watcher : watchers_) {
      const api::MissionStatus mission = watcher->end(kMissionLimit);
      ASSERT_TRUE(mission.end);
      EXPECT_EQ(mission.end->outcome, api::Outcome::kComplete) << mission.end->cause;
    }
  }
  /// All merged, where they truly lie, with every local map of each.
  [[nodiscard]] FleetOutcome outcome() const {
    FleetOutcome outcome = team_.outcome();
    team_.expect_near_truth(outcome.fleet, 0.2, 2.0);
    std::uint32_t nodes = 0;
    for (const api::FleetMember& member : outcome.fleet.members) {
      nodes += member.nodes;
    }
    EXPECT_EQ(outcome.map.nodes.size(), nodes) << "every robot's local maps are in the joint one";
    return outcome;
  }
  [[nodiscard]] api::FleetStatus fleet() const {
    return team_.until([](const api::FleetMember&) { return true; });
  }

 private:
  void kill(std::size_t k) {
    watchers_[k].reset();
    team_.kill(k);
  }
  void restart(std::size_t k) {
    team_.start(k);
    watchers_[k] = std::make_unique<Watcher>(team_.robot(k));
  }
  /// The world runs faster than life, the writing of files does not: on a busy machine the robot would have left the
  /// place that is kept by as much as it never does in life.
  void stop_world_at_kept_place(std::size_t k) {
    constexpr double kNear_m = 0.3;
    const auto end = std::chrono::steady_clock::now() + kStart;
    std::optional<Pose2> seen;
    while (std::chrono::steady_clock::now() < end) {
      const std::optional<Pose2> kept = team_.kept_place(k);
      if (!kept || kept == seen) {
        std::this_thread::yield();
        continue;
      }
      seen = kept;
      team_.stop_world();
      if (team_.away_m(k, *kept) < kNear_m) {
        return;
      }
      team_.let_world_go_on();
    }
    ADD_FAILURE() << "no place was kept that the robot was near to";
  }

  Team team_;
  std::optional<ChaosProxy> link_;
  std::vector<std::unique_ptr<Watcher>> watchers_;
  RobotTime cut_at_;
};

/// Of those that were announced before.
void expect_no_fewer_nodes(const api::FleetStatus& before, const api::FleetStatus& after) {
  ASSERT_EQ(before.members.size(), after.members.size());
  for (std::size_t k = 0; k < before.members.size(); ++k) {
    EXPECT_EQ(before.members[k].robot_id, after.members[k].robot_id);
    EXPECT_GE(after.members[k].nodes, before.members[k].nodes) << before.members[k].robot_id;
  }
}

void expect_same_places(const api::FleetStatus& a, const api::FleetStatus& b, double within_m, double within_deg) {
  ASSERT_EQ(a.members.size(), b.members.size());
  for (std::size_t k = 0; k < a.members.size(); ++k) {
    ASSERT_TRUE(a.members[k].main_T_map && b.members[k].main_T_map) << a.members[k].robot_id;
    EXPECT_THAT(*a.members[k].main_T_map, Pose2Near(*b.members[k].main_T_map, within_m, deg_to_rad(within_deg)))
        << a.members[k].robot_id;
  }
}

/// Robots that drive other ways look at a wall from elsewhere: its ends, and the backs of things that stand about, are
/// seen by one run and not by the other. What both saw lies within a cell and its neighbours.
void expect_same_map(const LineMap& undisturbed, const LineMap& disturbed) {
  constexpr double kMostWalls = 0.9;
  constexpr double kSameWalls = 0.15;
  constexpr double kSameFloor = 0.05;
  const Cells walls = Cells::of_walls(undisturbed);
  const Cells again = Cells::of_walls(disturbed);
  EXPECT_GT(walls.share_in(again), kMostWalls) << "nothing is lost";
  EXPECT_GT(again.share_in(walls), kMostWalls) << "nothing lies where there is nothing";
  EXPECT_NEAR(again.length_m(), walls.length_m(), kSameWalls * walls.length_m());
  const double floor_m2 = Cells::of_floor(undisturbed).area_m2();
  EXPECT_NEAR(Cells::of_floor(disturbed).area_m2(), floor_m2, kSameFloor * floor_m2);
}

FleetOutcome undisturbed() {
  Expedition expedition("fleet_undisturbed");
  expedition.expect_complete();
  FleetOutcome outcome = expedition.outcome();
  constexpr double kOuterWalls_m = 40.0;
  EXPECT_GT(Cells::of_walls(outcome.map).length_m(), 0.8 * kOuterWalls_m);
  std::uint32_t seen_alike = 0;
  for (const api::FleetMember& member : outcome.fleet.members) {
    EXPECT_GT(member.pictures, 0U) << member.robot_id << " has sent no picture of a node";
    seen_alike += member.hypotheses.empty() ? 0 : member.hypotheses.front().pictures;
  }
  EXPECT_GT(seen_alike, 0U) << "no place of two robots was recognised by its picture";
  return outcome;
}

TEST(FleetMissions, KilledProgramsAndACutLinkLoseNothing) {
  const FleetOutcome undisturbed = testing::undisturbed();
  Expedition expedition("fleet_disturbed");
  expedition.kill_at_first_checkpoint(kKilled);
  expedition.cut_link();
  expedition.kill_at_first_checkpoint(kMain);
  const api::FleetStatus early = expedition.fleet();
  expedition.mend_link();
  expedition.expect_complete();
  const FleetOutcome before = expedition.outcome();
  expect_no_fewer_nodes(early, before.fleet);
  // The main robot's mission is over and has left no map to take up again: what the fleet knew is there all the same.
  expedition.kill_and_restart(kMain);
  const FleetOutcome after = expedition.outcome();
  expect_no_fewer_nodes(before.fleet, after.fleet);
  expect_same_places(before.fleet, after.fleet, 0.05, 0.5);
  expect_same_places(undisturbed.fleet, after.fleet, 0.2, 2.0);
  expect_same_map(undisturbed.map, after.map);
}

}  // namespace
}  // namespace seeker::testing
