// Other robots: where they are now, how long a report holds, what follows the map.

#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "server/app/loop/neighbours.hpp"

namespace seeker::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

FleetView one_other(const Pose2& map_T_base, const Twist2& velocity) {
  RobotTopology other;
  other.robot_id = "other";
  other.map_T_base = map_T_base;
  other.velocity = velocity;
  return {.robot_id = "me", .others = {other}};
}

const RobotTime kReportedAt{seconds(50)};

TEST(Neighbours, AReportedRobotIsBroughtOnByItsVelocityForTheTimeSince) {
  Neighbours neighbours(FleetMotionParams{}, "r1");
  neighbours.set_fleet(one_other(Pose2{3.0, 0.0, 0.0}, {0.5, 0.0}), kReportedAt);
  const auto movers = neighbours.movers_base(Pose2{1.0, 0.0, 0.0}, std::nullopt, kReportedAt + seconds(1));
  ASSERT_EQ(movers.size(), 1U);
  EXPECT_NEAR(movers[0].frame_T_base.x_m, 2.5, 1e-9) << "frame of the robot's base";
  const FleetMotionParams params;
  EXPECT_NEAR(movers[0].slack_m, params.slack_m + params.slack_m_s, 1e-9);
}

TEST(Neighbours, AnOldReportSaysNothing) {
  Neighbours neighbours(FleetMotionParams{}, "r1");
  neighbours.set_fleet(one_other(Pose2{3.0, 0.0, 0.0}, {0.5, 0.0}), kReportedAt);
  const RobotTime later = kReportedAt + FleetMotionParams{}.max_age + milliseconds(1);
  EXPECT_TRUE(neighbours.movers_base({}, std::nullopt, later).empty());
  EXPECT_NE(neighbours.fleet(), nullptr) << "where it was may still be asked";
}

TEST(Neighbours, AMapCorrectionMovesWhatIsKnownOfTheOthers) {
  Neighbours neighbours(FleetMotionParams{}, "r1");
  FleetView view = one_other(Pose2{3.0, 0.0, 0.0}, {});
  view.sides = std::make_shared<const std::vector<MappedSide>>(1, MappedSide{{0.0, 2.0}, {3.0, 2.0}});
  neighbours.set_fleet(std::move(view), kReportedAt);
  neighbours.map_moved(Pose2{0.0, 1.0, 0.0});
  EXPECT_NEAR(neighbours.fleet()->others[0].map_T_base.y_m, 1.0, 1e-9);
  EXPECT_NEAR(neighbours.fleet()->others[0].map_T_base.x_m, 3.0, 1e-9);
  EXPECT_EQ(neighbours.fleet()->sides->front(), (MappedSide{{0.0, 3.0}, {3.0, 3.0}}));
}

TEST(Neighbours, WithoutAnExplorationTheOwnReportIsInactive) {
  Neighbours neighbours(FleetMotionParams{}, "r1");
  neighbours.note_own(nullptr, Pose2{1.0, 2.0, 0.0}, {0.1, 0.0});
  EXPECT_FALSE(neighbours.own().active);
  EXPECT_EQ(neighbours.own().map_T_base, (Pose2{1.0, 2.0, 0.0}));
  EXPECT_EQ(neighbours.own().velocity, (Twist2{0.1, 0.0}));
}

/// Explores, and leaves to others what is their share.
class SharedExploration final : public Behaviour {
 public:
  Decision step(const Situation& /*situation*/) override { return {}; }
  [[nodiscard]] std::optional<Point2> target_map() const override { return Point2(4.0, 1.0); }
  [[nodiscard]] bool shares_exploration() const override { return true; }
};

TEST(Neighbours, AnExplorationThatIsSharedIsReportedWithItsGoalThoughItKeepsNoTopology) {
  Neighbours neighbours(FleetMotionParams{}, "r1");
  const SharedExploration exploration;
  neighbours.note_own(&exploration, Pose2{1.0, 2.0, 0.0}, {});
  EXPECT_TRUE(neighbours.own().active);
  EXPECT_EQ(neighbours.own().target_map, Point2(4.0, 1.0));
  EXPECT_FALSE(neighbours.wants_picture()) << "pictures are taken at nodes";
  neighbours.note_own(nullptr, Pose2{1.0, 2.0, 0.0}, {});
  EXPECT_FALSE(neighbours.own().active);
  EXPECT_FALSE(neighbours.own().target_map.has_value());
}

TEST(Neighbours, AnotherMapVoidsAllPlaces) {
  Neighbours neighbours(FleetMotionParams{}, "r1");
  neighbours.set_fleet(one_other(Pose2{3.0, 0.0, 0.0}, {}), kReportedAt);
  neighbours.note_own(nullptr, Pose2{1.0, 2.0, 0.0}, {});
  neighbours.forget_places();
  EXPECT_EQ(neighbours.fleet(), nullptr);
  RobotTopology nameless = neighbours.own();
  EXPECT_EQ(std::exchange(nameless.robot_id, ""), "r1");
  EXPECT_EQ(nameless, RobotTopology{});
}

/// An exploration that has made some nodes.
struct Explored final : Behaviour {
  explicit Explored(std::uint64_t nodes) {
    for (std::uint64_t id = 1; id <= nodes; ++id) {
      made.nodes.emplace_back().id = id;
    }
  }
  [[nodiscard]] Decision step(const Situation& /*situation*/) override { return {}; }
  [[nodiscard]] const Topology* topology() const override { return &made; }

  Topology made;
};

TEST(Neighbours, EachNewNodeOfEachExplorationIsPicturedOnce) {
  Neighbours neighbours(FleetMotionParams{}, "r1");
  const auto wants = [&](const Behaviour* behaviour) {
    neighbours.note_own(behaviour, Pose2{}, {});
    return neighbours.wants_picture();
  };
  const Explored one(1);
  const Explored two(2);
  EXPECT_FALSE(wants(nullptr)) << "there is no node";
  EXPECT_TRUE(wants(&one));
  neighbours.picture_begun();
  EXPECT_FALSE(wants(&one));
  EXPECT_TRUE(wants(&two));
  neighbours.picture_begun();
  EXPECT_FALSE(wants(&two));
  EXPECT_FALSE(wants(nullptr)) << "it is over";
  EXPECT_TRUE(wants(&two)) << "the nodes of the next one have the same numbers";
}

}  // namespace
}  // namespace seeker::app
