// Decisions of the strategy that plans tours.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "server/explore/place_strategy.hpp"
#include "server/explore/trail.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/explore/explorations.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::explore {
namespace {

using seeker::testing::Point2Near;

/// One decision over a known floor whose borders are given.
class TourDecision : public ::testing::Test {
 protected:
  /// 20 x 10 m of floor with the unknown all around it, and the robot at its middle, facing +x.
  TourDecision() : occupancy_(nav::ascii_map(rows(), 0.5)), robot_{10.0, 5.0, 0.0}, floors_({}, {}, 0.2, 1.0) {}

  [[nodiscard]] PlaceChoice choose(PlaceChooser& chooser, std::vector<Opening> open, const Opening* goal = nullptr,
                                   std::optional<Point2> end_map = std::nullopt) {
    const auto cost = nav::CostMap::build(occupancy_);
    const auto reachable = nav::reachable_floor(*cost, robot_.translation(), 0.2);
    const auto costs = nav::DistanceField::build(*cost, robot_.translation());
    EXPECT_TRUE(cost && reachable && costs);
    const nav::FloorView floor{occupancy_, *cost, *reachable, 1, {}};
    for (Opening& opening : open) {
      opening.cost = *costs->cost_to(opening.map_T_view.translation());
    }
    std::stable_sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
    StrategyInput input{{{}, robot_, nullptr, nullptr, floors_}, {}, covariance_, none_, 1, {}, nullptr};
    input.end_map = end_map;
    trail_.note(robot_.translation(), position_sigma_m(covariance_));
    input.trail = &trail_;
    input.fleet = fleet_ ? &*fleet_ : nullptr;
    input.now = now_;
    return chooser.choose({input, floor, *costs, open, goal});
  }

  static std::vector<std::string> rows() {
    std::vector<std::string> all(24, std::string(44, ' '));
    for (std::size_t row = 2; row < 22; ++row) {
      all[row] = "  " + std::string(40, '.') + "  ";
    }
    return all;
  }

  /// A border that was observed before, so that only the border itself shows it.
  static Opening border_at(const Point2& p_map, std::uint64_t id) {
    Opening opening;
    opening.id = id;
    opening.p_map = p_map;
    opening.size_m = 1.0;
    opening.visits = 1;
    opening.outward_map = p_map.x() > 10.0 ? Point2(1.0, 0.0) : Point2(-1.0, 0.0);
    opening.map_T_view = {p_map.x(), p_map.y(), p_map.x() > 10.0 ? 0.0 : kPi};
    return opening;
  }

  /// It is seen from 0.3 m beside it, looking along +x.
  static Opening wall_end_at(const Point2& p_map, std::uint64_t id) {
    Opening end = border_at(p_map, id);
    end.kind = OpeningKind::kWallEnd;
    end.map_T_view = {p_map.x(), p_map.y() - 0.3, 0.0};
    return end;
  }

  Grid<std::uint8_t> occupancy_;
  Pose2 robot_;
  Matrix3 covariance_ = Matrix3::Identity() * 1e-6;
  std::vector<MapSegment> none_;
  nav::FloorSource floors_;
  Trail trail_;
  std::optional<FleetView> fleet_;
  RobotTime now_;
};

RobotTopology robot_at(const Point2& p_map, std::optional<Point2> target_map = std::nullopt) {
  RobotTopology robot;
  robot.robot_id = "other";
  robot.map_T_base = {p_map.x(), p_map.y(), 0.0};
  robot.target_map = target_map;
  return robot;
}

TEST_F(TourDecision, WhatIsTheShareOfAnotherRobotIsLeftToIt) {
  const std::vector<Opening> open{border_at({5.0, 5.0}, 1), border_at({17.0, 5.0}, 2)};
  robot_.theta_rad = kPi / 2.0;
  fleet_ = FleetView{"self", {robot_at({3.0, 5.0})}};
  const PlaceChoice choice = choose(*make_tour_chooser({}), open);
  ASSERT_TRUE(choice.opening.has_value());
  EXPECT_EQ(choice.opening->id, 2U) << choice.decision.why;
  fleet_->others.front().active = false;
  const PlaceChoice alone = choose(*make_tour_chooser({}), open);
  ASSERT_TRUE(alone.opening.has_value());
  EXPECT_EQ(alone.opening->id, 1U) << "a robot that does not explore has no share";
}

TEST_F(TourDecision, WhatAnotherRobotDrivesToIsLeftToIt) {
  const std::vector<Opening> open{border_at({5.0, 5.0}, 1), border_at({17.0, 5.0}, 2)};
  robot_.theta_rad = kPi / 2.0;
  fleet_ = FleetView{"self", {robot_at({10.0, 8.0}, Point2(5.4, 5.4))}};
  const PlaceChoice choice = choose(*make_tour_chooser({}), open);
  ASSERT_TRUE(choice.opening.has_value());
  EXPECT_EQ(choice.opening->id, 2U) << choice.decision.why;
}

TEST_F(TourDecision, WallsThatAnotherRobotHasMappedBoundWhatABorderShows) {
  const std::vector<Opening> open{border_at({2.2, 5.0}, 1), border_at({17.8, 5.0}, 2)};
  robot_ = {6.0, 5.0, kPi};
  const PlaceChoice alone = choose(*make_tour_chooser({}), open);
  ASSERT_TRUE(alone.opening.has_value());
  EXPECT_EQ(alone.opening->id, 1U) << alone.decision.why;
  fleet_ = FleetView{.robot_id = "self", .others = {}};
  fleet_->sides = std::make_shared<const std::vector<MappedSide>>(std::vector<MappedSide>{
      {{1.2, 4.0}, {1.2, 6.0}}, {{1.2, 6.0}, {3.0, 6.0}}, {{3.0, 6.0}, {3.0, 4.0}}, {{3.0, 4.0}, {1.2, 4.0}}});
  const PlaceChoice merged = choose(*make_tour_chooser({}), open);
  ASSERT_TRUE(merged.opening.has_value());
  EXPECT_EQ(merged.opening->id, 2U) << "nothing but walls lies behind the near one: " << merged.decision.why;
}

TEST_F(TourDecision, WithoutAShareTheRobotWaitsAndThenHelps) {
  const auto chooser = make_tour_chooser({});
  const std::vector<Opening> open{border_at({5.0, 5.0}, 1)};
  fleet_ = FleetView{"self", {robot_at({6.0, 5.0}, Point2(5.0, 5.0))}};
  const PlaceChoice waits = choose(*chooser, open);
  EXPECT_FALSE(waits.opening.has_value());
  EXPECT_TRUE(waits.others_busy);
  EXPECT_FALSE(waits.decision.why.empty());
  now_ += seconds(TourParams{}.share_wait_s + 1.0);
  const PlaceChoice helps = choose(*chooser, open);
  ASSERT_TRUE(helps.opening.has_value()) << "the other one has not come there";
  EXPECT_FALSE(helps.others_busy);
}

TEST_F(TourDecision, TakesTheSideThatMakesTheTourShort) {
  // Five metres to the left and seven to the right: left first, then all the way.
  const auto chooser = make_tour_chooser({});
  robot_.theta_rad = kPi / 2.0;
  const PlaceChoice choice = choose(*chooser, {border_at({5.0, 5.0}, 1), border_at({17.0, 5.0}, 2)});
  ASSERT_TRUE(choice.opening.has_value());
  EXPECT_EQ(choice.opening->id, 1U) << choice.decision.why;
  EXPECT_EQ(choice.decision.rule, "tour");
  EXPECT_NE(choice.decision.why.find("tour of 2 places"), std::string::npos) << choice.decision.why;
}

TEST_F(TourDecision, TheEndIsPartOfTheTour) {
  // With the end on the left the right side comes first, though it is farther.
  const auto chooser = make_tour_chooser({});
  robot_.theta_rad = kPi / 2.0;
  const PlaceChoice choice =
      choose(*chooser, {border_at({5.0, 5.0}, 1), border_at({17.0, 5.0}, 2)}, nullptr, Point2(3.0, 5.0));
  ASSERT_TRUE(choice.opening.has_value());
  EXPECT_EQ(choice.opening->id, 2U) << choice.decision.why;
}

TEST_F(TourDecision, TurningRoundCostsPath) {
  // As near on both sides: it goes where it looks.
  const auto chooser = make_tour_chooser({});
  const PlaceChoice choice = choose(*chooser, {border_at({4.2, 5.0}, 1), border_at({15.8, 5.0}, 2)});
  ASSERT_TRUE(choice.opening.has_value());
  EXPECT_EQ(choice.opening->id, 2U) << choice.decision.why;
}

TEST_F(TourDecision, WhatLiesBesideTheWayIsNotLeftForTheWayBack) {
  // There and back again: the near place beside the robot can be visited first or last.
  const auto chooser = make_tour_chooser({});
  const PlaceChoice choice =
      choose(*chooser, {border_at({10.0, 8.0}, 1), border_at({18.0, 5.0}, 2)}, nullptr, Point2(10.0, 5.0));
  ASSERT_TRUE(choice.opening.has_value());
  EXPECT_EQ(choice.opening->id, 1U) << choice.decision.why;
}

TEST_F(TourDecision, ADetourPaysForItsRotations) {
  // Both ends of walls are as near to the way; to see the second one the robot has to look back.
  const Opening ahead = wall_end_at({13.0, 5.3}, 7);
  Opening behind = ahead;
  behind.id = 8;
  behind.map_T_view = {13.0, 5.0, kPi};
  const std::vector<Opening> border{border_at({19.0, 5.0}, 2)};
  const auto id_with = [&](const Opening& end) {
    const PlaceChoice choice = choose(*make_tour_chooser({}), {end, border.front()});
    return choice.opening ? choice.opening->id : 0U;
  };
  EXPECT_EQ(id_with(ahead), 7U);
  EXPECT_EQ(id_with(behind), 2U);
}

TEST_F(TourDecision, DoesNotWaverBetweenEqualTours) {
  const auto chooser = make_tour_chooser({});
  robot_.theta_rad = kPi / 2.0;
  const std::vector<Opening> open{border_at({4.0, 5.0}, 1), border_at({16.2, 5.0}, 2)};
  const PlaceChoice first = choose(*chooser, open);
  ASSERT_TRUE(first.opening.has_value());
  const Opening goal = *first.opening;
  robot_.x_m = 20.0 - goal.p_map.x() > 10.0 ? 10.3 : 9.7;  // a little nearer to the other one
  const PlaceChoice second = choose(*chooser, open, &goal);
  ASSERT_TRUE(second.opening.has_value());
  EXPECT_EQ(second.opening->id, goal.id);
}

/// A tour of three of four places: left of the middle the far left one is of it and the tour begins on the right, right
/// of the middle it begins on the left.
TEST_F(TourDecision, ReachesAPlaceThoughEachSideHasAnotherTour) {
  ExploreParams params;
  params.tour.max_places = 3;
  const auto chooser = make_tour_chooser(params);
  const std::vector<Opening> open{border_at({2.5, 5.0}, 1), border_at({6.5, 5.0}, 2), border_at({13.5, 5.0}, 3),
                                  border_at({17.5, 5.0}, 4)};
  robot_.x_m = 9.5;
  std::optional<Opening> goal;
  int turns = 0;
  for (int decision = 0; decision < 50 && !(goal && std::abs(goal->p_map.x() - robot_.x_m) < 0.5); ++decision) {
    const PlaceChoice choice = choose(*chooser, open, goal ? &*goal : nullptr);
    ASSERT_TRUE(choice.opening.has_value());
    turns += goal && goal->id != choice.opening->id ? 1 : 0;
    goal = choice.opening;
    const bool right = goal->p_map.x() > robot_.x_m;
    robot_ = {robot_.x_m + (right ? 0.5 : -0.5), 5.0, right ? 0.0 : kPi};
  }
  EXPECT_NEAR(robot_.x_m, goal->p_map.x(), 0.5) << "after " << turns << " turns";
  EXPECT_GT(turns, 0) << "the two sides do have other tours";
}

TEST_F(TourDecision, WhatIsTooLittleIsTakenOnTheWayOnly) {
  ExploreParams params;
  const Opening end = wall_end_at({15.0, 5.3}, 7);
  const auto chooser = make_tour_chooser(params);
  const PlaceChoice by_the_way = choose(*chooser, {end, border_at({19.0, 5.0}, 2)});
  EXPECT_FALSE(by_the_way.opening && by_the_way.opening->id == 7U) << "it is beyond passing_near_m";
  params.viewpoints.min_gain_m2 = 1000.0;
  const auto strict = make_tour_chooser(params);
  const PlaceChoice none = choose(*strict, {end, border_at({19.0, 5.0}, 2)});
  EXPECT_FALSE(none.opening.has_value()) << "none is worth a drive by itself";
  robot_.x_m = 13.0;
  const auto near = make_tour_chooser({});
  const PlaceChoice passed = choose(*near, {end, border_at({19.0, 5.0}, 2)});
  ASSERT_TRUE(passed.opening.has_value());
  EXPECT_EQ(passed.opening->id, 7U) << passed.decision.why;
}

TEST_F(TourDecision, ALittleFloorIsNotWorthALongDrive) {
  ExploreParams params;
  params.tour.room_m2 = 1000.0;
  params.tour.detour_m_m2 = 0.1;
  const std::vector<Opening> on_one_side{border_at({13.0, 5.0}, 1), border_at({15.0, 5.0}, 2)};
  const PlaceChoice none = choose(*make_tour_chooser(params), on_one_side);
  EXPECT_FALSE(none.opening.has_value()) << none.decision.why;
  EXPECT_FALSE(none.others_busy);
  params.tour.room_m2 = 1.0;  // what may be a room is worth any drive
  const PlaceChoice room = choose(*make_tour_chooser(params), on_one_side);
  ASSERT_TRUE(room.opening.has_value());
  EXPECT_EQ(room.opening->id, 1U);
}

TEST_F(TourDecision, WhatIsTakenOnTheWayIsNotGivenUpForATurn) {
  const Opening end = wall_end_at({15.0, 5.3}, 7);
  const std::vector<Opening> open{end, border_at({19.0, 5.0}, 2)};
  robot_ = {14.9, 4.6, 0.0};
  const PlaceChoice fresh = choose(*make_tour_chooser({}), open);
  ASSERT_TRUE(fresh.opening.has_value());
  EXPECT_EQ(fresh.opening->id, 2U) << "the turn to the other one is too long a detour";
  const PlaceChoice under_way = choose(*make_tour_chooser({}), open, &end);
  ASSERT_TRUE(under_way.opening.has_value());
  EXPECT_EQ(under_way.opening->id, 7U) << under_way.decision.why;
}

TEST_F(TourDecision, AnUncertainLegPassesACertainPlace) {
  ExploreParams params;
  params.guard.max_position_sigma_m = 0.06;
  params.guard.regain_position_sigma_m = 0.03;
  const auto chooser = make_tour_chooser(params);
  const std::vector<Opening> open{border_at({19.0, 5.0}, 2)};
  robot_ = {8.0, 5.0, 0.0};
  EXPECT_FALSE(choose(*chooser, {border_at({9.0, 5.0}, 1)}).via_map.has_value()) << "a short leg is certain";
  robot_ = {11.0, 5.0, 0.0};
  covariance_ = Matrix3::Identity() * 0.0025;
  const PlaceChoice choice = choose(*chooser, open);
  ASSERT_TRUE(choice.via_map.has_value());
  EXPECT_THAT(*choice.via_map, Point2Near(Point2(8.0, 5.0), 0.1));
  EXPECT_NE(choice.decision.why.find("certain"), std::string::npos) << choice.decision.why;
}

}  // namespace
}  // namespace seeker::explore
