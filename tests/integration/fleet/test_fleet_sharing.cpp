// What robots hear of where the others go, and who belongs together when there are more than two.

#include "tests/integration/fleet/sharing_robots.hpp"

namespace seeker::testing {
namespace {

using app::FleetLeader;
using app::FleetLeaderParams;

const RobotTopology& of(const std::vector<RobotTopology>& others, const std::string& robot_id) {
  static const RobotTopology nobody;
  const auto found = std::find_if(others.begin(), others.end(),
                                  [&](const RobotTopology& other) { return other.robot_id == robot_id; });
  EXPECT_NE(found, others.end()) << robot_id;
  return found == others.end() ? nobody : *found;
}

TEST(FleetSharing, EveryRobotHearsOfTheOthersInItsOwnFrame) {
  const ToyHost main(west(), at_place("main", kPlace));
  FleetLeader leader(patient_params("share_frames"), main.host());
  join(leader, packed(east(), "r1"));
  join(leader, packed(fleet::toy_map(fleet::office(1), fleet::drive(kEast), 21), "r2"));
  const Pose2 west_T_r1 = *until(leader, "r1", placed).main_T_map;
  const Pose2 west_T_r2 = *until(leader, "r2", placed).main_T_map;
  EXPECT_EQ(answer_to(leader, "r1", at_place("r1", kPlace)).state, api::FleetState::kMerged);
  leader.refresh();

  const auto r2_hears = answer_to(leader, "r2", at_place("r2", kPlace)).others;
  ASSERT_EQ(r2_hears.size(), 2U);
  EXPECT_THAT(of(r2_hears, "r1").map_T_base, Pose2Near(Pose2{kPlace.x(), kPlace.y(), 0.0}, 0.3, 0.06))
      << "both maps begin at the same place";
  EXPECT_THAT(*of(r2_hears, "main").target_map, Point2Near(inverse(west_T_r2) * (kPlace + Point2(3.0, 0.0)), 1e-9));
  EXPECT_TRUE(of(r2_hears, "main").active);
  EXPECT_EQ(of(r2_hears, "main").velocity, (Twist2{0.3, 0.0}));
  EXPECT_EQ(of(r2_hears, "r1").topology.nodes.front().goals.size(), 1U);

  leader.refresh();
  const auto main_hears = main.view();
  ASSERT_TRUE(main_hears);
  ASSERT_EQ(main_hears->others.size(), 2U);
  EXPECT_EQ(main_hears->robot_id, "main");
  EXPECT_THAT(of(main_hears->others, "r1").topology.nodes.front().goals.front().p_map,
              Point2Near(west_T_r1 * (kPlace + Point2(3.0, 0.0)), 0.1))
      << "where r1 lies was found anew with r2's map";
}

TEST(FleetSharing, EveryRobotIsToldTheFloorOfTheOthersInItsOwnFrame) {
  const Point2 seen_by_main(4.0, 0.5);
  const Point2 seen_by_r1(2.0, -0.5);
  const ToyHost main(west(), at_place("main", kPlace), {true, floor_with(seen_by_main), {}, {}});
  FleetLeaderParams params = patient_params("share_floor");
  params.floor_period = Duration::zero();
  FleetLeader leader(params, main.host());
  EXPECT_EQ(leader.seen(seen_by("r1")).error().code, Errc::kNotFound) << "it has to announce itself first";
  join(leader, packed(east(), "r1"));
  const Pose2 west_T_r1 = *until(leader, "r1", placed).main_T_map;
  EXPECT_EQ(answer_to(leader, "r1", at_place("r1", kPlace)).state, api::FleetState::kMerged);
  leader.refresh();
  leader.refresh();

  const auto r1_hears = leader.seen({"r1", 1, true, floor_with(seen_by_r1), {}, {}});
  ASSERT_TRUE(r1_hears) << r1_hears.error().message;
  const auto of_main = assemble(r1_hears->floor);
  ASSERT_TRUE(of_main);
  const auto there = occupied_in(*of_main);
  ASSERT_TRUE(there);
  EXPECT_THAT(*there, Point2Near(inverse(west_T_r1) * seen_by_main, 2.0 * kTileResolution_m));

  leader.refresh();
  const auto main_hears = main.view();
  ASSERT_TRUE(main_hears && main_hears->floor);
  const auto here = occupied_in(*main_hears->floor);
  ASSERT_TRUE(here);
  EXPECT_THAT(*here, Point2Near(west_T_r1 * seen_by_r1, 2.0 * kTileResolution_m));
}

TEST(FleetSharing, WhatOneHasFoundAllHearOfOnceInTheirOwnFrames) {
  const Point2 by_main(4.0, 0.5);
  const Point2 by_r1(2.0, -0.5);
  const ToyHost main(west(), at_place("main", kPlace), {true, {}, {found_at(7, by_main, "ball")}, {}});
  FleetLeaderParams params = patient_params("share_found");
  params.floor_period = Duration::zero();
  FleetLeader leader(params, main.host());
  join(leader, packed(east(), "r1"));
  const Pose2 west_T_r1 = *until(leader, "r1", placed).main_T_map;
  leader.refresh();
  leader.refresh();
  const auto r1_hears = leader.seen(seen_by("r1", {found_at(1, by_r1)}));
  ASSERT_TRUE(r1_hears) << r1_hears.error().message;
  ASSERT_EQ(r1_hears->findings.size(), 1U);
  EXPECT_EQ(r1_hears->findings[0].robot_id, "main");
  EXPECT_EQ(r1_hears->findings[0].detection.target, "ball");
  EXPECT_THAT(*r1_hears->findings[0].detection.position, Point2Near(inverse(west_T_r1) * by_main, 1e-9));

  leader.refresh();
  leader.refresh();
  const auto events = main.events();
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const std::string& event) {
                            return event.find("fleet-found robot 'r1' has seen 'mug' at") != std::string::npos;
                          }),
            1);
  const api::FleetStatus status = leader.status();
  ASSERT_EQ(status.members[0].detections.size(), 1U);
  ASSERT_EQ(status.members[1].detections.size(), 1U);
  EXPECT_THAT(*status.members[1].detections[0].position, Point2Near(west_T_r1 * by_r1, 1e-9));
}

TEST(FleetSharing, WhatOneHasSearchedTheOthersAreToldInTheirOwnFrames) {
  const SearchedFloor by_main = searched_at({1.0, 0.0, 0.0}, 3, 200);
  const SearchedFloor by_r1 = searched_at({0.0, 2.0, 0.5}, 4, 100);
  const ToyHost main(west(), at_place("main", kPlace), {true, {}, {}, by_main});
  FleetLeaderParams params = patient_params("share_searched");
  params.silence_limit = params.floor_period = Duration::zero();
  FleetLeader leader(params, main.host());
  join(leader, packed(east(), "r1"));
  const Pose2 west_T_r1 = *until(leader, "r1", placed).main_T_map;
  EXPECT_EQ(answer_to(leader, "r1", at_place("r1", kPlace)).state, api::FleetState::kMerged);
  leader.refresh();
  leader.refresh();
  const auto r1_hears = leader.seen(seen_by("r1", {}, by_r1));
  ASSERT_TRUE(r1_hears) << r1_hears.error().message;
  ASSERT_EQ(r1_hears->searched.size(), 1U);
  EXPECT_EQ(*r1_hears->searched[0].probability, *by_main.probability);
  EXPECT_THAT(r1_hears->searched[0].map_T_grid, Pose2Near(inverse(west_T_r1) * by_main.map_T_grid, 1e-9, 1e-9));
  // A robot that was started anew has forgotten what it searched; the others have not.
  join(leader, packed(east(), "r1", 2));
  static_cast<void>(until(leader, "r1", placed));
  ASSERT_TRUE(leader.seen(seen_by("r1", {}, {}, 2)));
  leader.refresh();
  const auto main_hears = main.view();
  ASSERT_TRUE(main_hears && main_hears->searched);
  ASSERT_EQ(main_hears->searched->size(), 1U);
  EXPECT_THAT(main_hears->searched->front().map_T_grid, Pose2Near(west_T_r1 * by_r1.map_T_grid, 1e-9, 1e-9));
}

TEST(FleetSharing, FloorThatWasSearchedTooLongAgoIsNotPassedOn) {
  const ToyHost main(west(), at_place("main", kPlace), {true, {}, {}, searched_at({}, 3, 200)});
  FleetLeaderParams params = patient_params("share_searched_old");
  params.floor_period = params.search_age = Duration::zero();
  FleetLeader leader(params, main.host());
  join(leader, packed(east(), "r1"));
  static_cast<void>(until(leader, "r1", placed));
  static_cast<void>(answer_to(leader, "r1", at_place("r1", kPlace)));
  leader.refresh();
  leader.refresh();
  const auto r1_hears = leader.seen(seen_by("r1", {found_at(1, kPlace)}, searched_at({}, 4, 100)));
  ASSERT_TRUE(r1_hears) << r1_hears.error().message;
  EXPECT_TRUE(r1_hears->searched.empty());
  leader.refresh();
  ASSERT_TRUE(main.view());
  EXPECT_FALSE(main.view()->searched);
}

TEST(FleetSharing, WhoDoesNotKnowItsPlaceTakesNothingBackAndHearsOfTheOthers) {
  const ToyHost main(west(), at_place("main", kPlace), {true, {}, {found_at(7, kPlace)}, {}});
  FleetLeaderParams params = patient_params("share_lost");
  params.floor_period = Duration::zero();
  FleetLeader leader(params, main.host());
  join(leader, packed(east(), "r1"));
  static_cast<void>(until(leader, "r1", placed));
  static_cast<void>(answer_to(leader, "r1", at_place("r1", kPlace)));
  leader.refresh();
  leader.refresh();
  ASSERT_TRUE(leader.seen({"r1", 1, true, floor_with(kPlace), {found_at(1, kPlace)}, searched_at({}, 4, 100)}));
  const auto lost_hears = leader.seen({"r1", 1, false, {}, {}, {}});
  ASSERT_TRUE(lost_hears) << lost_hears.error().message;
  EXPECT_EQ(lost_hears->findings.size(), 1U);
  EXPECT_EQ(leader.status().members[1].detections.size(), 1U);
  leader.refresh();
  ASSERT_TRUE(main.view());
  EXPECT_TRUE(main.view()->floor);
  EXPECT_TRUE(main.view()->searched);
}

TEST(FleetSharing, AMainRobotThatDoesNotKnowItsPlaceTakesNothingBackEither) {
  const auto own = std::make_shared<app::OwnSeen>(app::OwnSeen{true, {}, {found_at(7, kPlace)}, {}});
  app::FleetHost host = holds(west());
  host.give_seen = [own](const api::Reply<app::OwnSeen>& reply) { reply(app::OwnSeen(*own)); };
  FleetLeaderParams params = patient_params("share_main_lost");
  params.floor_period = Duration::zero();
  FleetLeader leader(params, host);
  leader.refresh();
  leader.refresh();
  ASSERT_EQ(leader.status().members[0].detections.size(), 1U);
  *own = {};
  leader.refresh();
  leader.refresh();
  EXPECT_EQ(leader.status().members[0].detections.size(), 1U);
}

TEST(FleetSharing, WhatLiesOutOfReachInTheFrameOfAnotherIsNotToldThere) {
  const ToyHost main(west(), at_place("main", kPlace));
  FleetLeaderParams params = patient_params("share_far");
  params.floor_period = Duration::zero();
  FleetLeader leader(params, main.host());
  join(leader, packed(east(), "r1"));
  join(leader, packed(fleet::toy_map(fleet::office(1), fleet::drive(kWest), 21), "r2"));
  const Pose2 west_T_r1 = *until(leader, "r1", placed).main_T_map;
  static_cast<void>(until(leader, "r2", placed));
  const Point2 edge_west(api::kMaxFleetReach_m + 8.0, 0.0);
  const Point2 edge_r1 = inverse(west_T_r1) * edge_west;
  ASSERT_TRUE(api::in_reach(edge_r1)) << "the robot itself may tell of it";
  SearchedFloor far = searched_at({}, 4, 100);
  far.map_T_grid = {edge_r1.x(), edge_r1.y(), 0.0};
  ASSERT_TRUE(leader.seen(seen_by("r1", {found_at(1, edge_r1), found_at(2, kPlace)}, far)));
  const auto r2_hears = leader.seen(seen_by("r2"));
  ASSERT_TRUE(r2_hears) << r2_hears.error().message;
  ASSERT_EQ(r2_hears->findings.size(), 1U);
  EXPECT_EQ(r2_hears->findings[0].detection.id, 2U);
  EXPECT_TRUE(r2_hears->searched.empty());
  const api::FleetMember r1 = until(leader, "r1", placed);
  ASSERT_EQ(r1.detections.size(), 1U);
  EXPECT_EQ(r1.detections[0].id, 2U);
}

TEST(FleetSharing, WhatARobotFoundBeforeItWasStartedAnewStaysFound) {
  FleetLeaderParams impatient = patient_params("share_found_anew");
  impatient.silence_limit = Duration::zero();
  FleetLeader leader(impatient, holds(west()));
  join(leader, packed(east(), "r1"));
  static_cast<void>(until(leader, "r1", placed));
  ASSERT_TRUE(leader.seen(seen_by("r1", {found_at(1, kPlace), found_at(2, kPlace)})));
  ASSERT_TRUE(leader.seen(seen_by("r1", {found_at(2, kPlace)}))) << "it takes the first one back";
  join(leader, packed(east(), "r1", 2));
  ASSERT_TRUE(leader.seen(seen_by("r1", {found_at(3, kPlace)}, {}, 2)));
  const api::FleetMember r1 = until(leader, "r1", placed);
  ASSERT_EQ(r1.detections.size(), 2U);
  EXPECT_EQ(r1.detections[0].id, 2U);
  EXPECT_EQ(r1.detections[1].id, 3U);
}

TEST(FleetSharing, ARobotOfAnotherBuildingIsToldNothingOfThisOne) {
  const ToyHost main(west(), at_place("main", kPlace), {true, floor_with(kPlace), {found_at(1, kPlace)}, {}});
  FleetLeader leader(patient_params("share_floor_apart"), main.host());
  join(leader, packed(east(7), "r1"));
  static_cast<void>(
      until(leader, "r1", [](const api::FleetMember& member) { return member.state != api::FleetState::kWaiting; }));
  leader.refresh();
  leader.refresh();
  const auto received = leader.seen({"r1", 1, true, floor_with(kPlace), {found_at(1, kPlace)}, {}});
  ASSERT_TRUE(received) << received.error().message;
  EXPECT_TRUE(received->floor.empty());
  EXPECT_TRUE(received->findings.empty());
  EXPECT_TRUE(leader.status().members[1].detections.empty()) << "nobody knows where that is";
  leader.refresh();
  EXPECT_FALSE(main.view().has_value());
}

TEST(FleetSharing, ASilentRobotsGoalsAreAnybodys) {
  FleetLeaderParams impatient = patient_params("share_silent");
  impatient.silence_limit = Duration::zero();
  const ToyHost main(west(), at_place("main", kPlace));
  FleetLeader leader(impatient, main.host());
  join(leader, packed(east(), "r1"));
  static_cast<void>(until(leader, "r1", placed));
  static_cast<void>(answer_to(leader, "r1", at_place("r1", kPlace)));
  leader.refresh();
  ASSERT_TRUE(main.view());
  EXPECT_FALSE(of(main.view()->others, "r1").active);
  EXPECT_FALSE(of(main.view()->others, "r1").velocity) << "nobody knows where it is now";
  EXPECT_EQ(of(main.view()->others, "r1").topology.nodes.size(), 1U);
}

TEST(FleetSharing, ARobotThatWasTakenOutHearsNothingAndNobodyHearsOfIt) {
  const ToyHost main(west(), at_place("main", kPlace));
  FleetLeader leader(patient_params("share_split"), main.host());
  join(leader, packed(east(), "r1"));
  static_cast<void>(until(leader, "r1", placed));
  static_cast<void>(answer_to(leader, "r1", at_place("r1", kPlace)));
  leader.refresh();
  ASSERT_TRUE(main.view());
  ASSERT_TRUE(leader.decide({"r1", api::FleetVerb::kSplit, 0}));
  leader.refresh();
  EXPECT_FALSE(main.view());
  const auto hears = answer_to(leader, "r1", at_place("r1", kPlace));
  EXPECT_EQ(hears.state, api::FleetState::kSplit);
  EXPECT_TRUE(hears.others.empty());
}

TEST(FleetSharing, WhoHasNotAnnouncedItselfIsToldToDoSo) {
  FleetLeader leader(patient_params("share_stranger"), holds(west()));
  EXPECT_EQ(leader.share({"r1", 1, {}}).error().code, Errc::kNotFound);
  join(leader, packed(east(), "r1", 1));
  EXPECT_TRUE(leader.share({"r1", 1, {}}));
  EXPECT_EQ(leader.share({"r1", 2, {}}).error().code, Errc::kNotFound) << "another program of this name";
}

TEST(FleetSharing, PlacesAreKeptOverRestartsOfBothButNotInANewMap) {
  const FleetLeaderParams same = patient_params("share_restart");
  const app::PackedMap robot = packed(east(), "r1", 1);
  {
    FleetLeader leader(same, holds(west()));
    ASSERT_TRUE(leader.announce(robot.manifest));
    static_cast<void>(answer_to(leader, "r1", at_place("r1", kPlace)));
    join(leader, robot);
    static_cast<void>(until(leader, "r1", placed));
  }
  const ToyHost main(west(), at_place("main", kPlace));
  FleetLeader again(same, main.host());
  static_cast<void>(until(again, "r1", placed));
  ASSERT_TRUE(main.until([&](const auto& view) {
    again.refresh();
    return view.has_value();
  })) << "as soon as its own map has been looked at again";
  EXPECT_FALSE(of(main.view()->others, "r1").active) << "it has not been heard since";
  EXPECT_FALSE(of(main.view()->others, "r1").velocity);
  // The robot comes back, with its map but without a mission.
  join(again, packed(east(), "r1", 2));
  static_cast<void>(answer_to(again, "r1", {}, 2));
  again.refresh();
  EXPECT_EQ(of(main.view()->others, "r1").topology.nodes.size(), 1U);
  EXPECT_FALSE(of(main.view()->others, "r1").active);
  const app::PackedMap new_map = packed(fleet::toy_map(fleet::office(1), fleet::drive(kWest), 31), "r1", 2);
  const auto answer = again.announce(new_map.manifest);
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(answer->fleet.members[1].state, api::FleetState::kWaiting);
  EXPECT_FALSE(answer->fleet.members[1].main_T_map);
  EXPECT_NE(answer->fleet.members[1].reason.find("new map"), std::string::npos);
  again.refresh();
  EXPECT_FALSE(main.view()) << "it has begun a new map";
  join(again, new_map);
  const auto looked_at = [](const api::FleetMember& r1) { return r1.state != api::FleetState::kWaiting; };
  EXPECT_EQ(until(again, "r1", looked_at).reason.find("new map"), std::string::npos);
}

TEST(FleetChain, ARobotIsMergedOverAnotherThatItMeets) {
  FleetLeader leader(patient_params("chain"), holds(in_two_offices(kWest, 11)));
  join(leader, packed(in_two_offices(kFarEast, 13), "r2"));
  const auto apart = until(leader, "r2", [](const auto& m) { return m.state != api::FleetState::kWaiting; });
  EXPECT_NE(apart.state, api::FleetState::kMerged) << apart.reason;
  join(leader, packed(in_two_offices(kBetween, 12), "r1"));
  const api::FleetMember member = until(leader, "r2", placed);
  const Pose2 truth = inverse(fleet::drive(kWest).front()) * fleet::drive(kFarEast).front();
  // 46 m away the drift of three maps shows, 0.004 rad for each of a dozen steps: a standard deviation of 0.3 m.
  EXPECT_THAT(*member.main_T_map, Pose2Near(truth, 0.6, 0.04));
  EXPECT_NE(member.reason.find("'r1'"), std::string::npos) << member.reason;
  EXPECT_GT(member.confidence, 0.0);
}

TEST(FleetOperator, IsToldOfWhatIsNotCertainAndHasTheLastWord) {
  FleetLeaderParams strict = patient_params("operator");
  strict.merge.sure_shared_wall_m = 10'000.0;
  const ToyHost main(west(), at_place("main", kPlace));
  FleetLeader leader(strict, main.host());
  join(leader, packed(east()));
  static_cast<void>(until(leader, "r1", api::FleetState::kAmbiguous));
  ASSERT_EQ(main.events().size(), 1U);
  EXPECT_NE(main.events().front().find("fleet-ambiguous robot 'r1' is AMBIGUOUS"), std::string::npos);
  EXPECT_EQ(answer_to(leader, "r1", {}).state, api::FleetState::kAmbiguous);
  ASSERT_TRUE(leader.decide({"r1", api::FleetVerb::kMerge, 0}));
  const api::FleetMember member = until(leader, "r1", placed);
  EXPECT_TRUE(member.by_operator);
  EXPECT_THAT(*member.main_T_map, Pose2Near(west_T_east(), 0.15, 0.03));
}

}  // namespace
}  // namespace seeker::testing
