#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "server/search/search_mission.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/search/toy_world.hpp"

namespace seeker::search {
namespace {

using seeker::testing::Point2Near;

ToyWorld one_room() {
  ToyWorld world;
  world.walls = box(0, 0, 5, 5);
  for (const Wall& wall : box(2.2, 2.2, 2.8, 2.8)) {
    world.walls.push_back(wall);
  }
  return world;
}

TEST(SearchMission, PlanCoversTwoRoomsWithoutTarget) {
  auto mission = mission_of(Strategy::kPlan);
  ToyRobot robot(furnished_rooms(), {1.0, 1.0, 0.3}, true, 5);
  const ToyRun run = robot.run(mission, 1200.0);
  print("plan", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kNotFoundAreaCovered);
  EXPECT_GT(run.summary.reachable_area_m2, 35.0);
  EXPECT_GE(run.summary.covered_area_m2, 0.97 * run.summary.reachable_area_m2);
  EXPECT_GT(run.least_clearance_m, 0.2);
  EXPECT_LT(run.path_m, 60.0);
  const auto report = mission.evidence_report();
  EXPECT_EQ(report.summary.gaps, static_cast<int>(report.gaps.size()));
}

TEST(SearchMission, FloorThatAnotherRobotHasSearchedIsNotSearchedAgain) {
  const Pose2 there_T_here{3.0, -7.0, 0.8};  // the other one has a frame of its own
  ToyRobot other(furnished_rooms(), {9.0, 1.0, 2.0}, true, 7);
  auto its_mission = mission_of(Strategy::kPlan, OnFound::kApproach,
                                {.bound = Polygon{{5.1, 0.0}, {10.2, 0.0}, {10.2, 5.0}, {5.1, 5.0}}, .keep_out = {}});
  ASSERT_TRUE(other.run(its_mission, 1200.0).end.has_value());
  its_mission.transform(there_T_here);
  SearchedFloor searched;
  searched.targets = {"ball", "box"};
  searched.map_T_grid = inverse(there_T_here);
  searched.probability = std::make_shared<const Grid<std::uint8_t>>(
      its_mission.evidence().own_looks(there_T_here * Point2(5.0, 2.5), 200));

  std::vector<ToyRun> runs;
  for (const std::vector<std::string>& targets : {std::vector<std::string>{}, {"ball"}, {"ball", "box"}}) {
    auto mission = mission_of(Strategy::kPlan);
    searched.targets = targets;
    mission.set_others({searched});
    ToyRobot robot(furnished_rooms(), {1.0, 1.0, 0.3}, true, 5);
    runs.push_back(robot.run(mission, 1200.0));
    ASSERT_TRUE(runs.back().end.has_value());
    EXPECT_GE(runs.back().summary.covered_area_m2, 0.97 * runs.back().summary.reachable_area_m2);
    EXPECT_EQ(mission.evidence().own_looks({5.0, 2.5}, 200).empty(), false);
  }
  EXPECT_EQ(runs[0].path_m, runs[1].path_m) << "who looked for something else has proved nothing";
  EXPECT_LT(runs[2].path_m, 0.7 * runs[0].path_m);
  EXPECT_LT(runs[2].images, runs[0].images);
}

TEST(SearchMission, FloorThatOthersWouldRefuseIsNotSearched) {
  SearchParams params;
  EXPECT_TRUE(validate(params));
  params.evidence.cell_m = 1.5;
  EXPECT_EQ(validate(params).error().code, Errc::kInvalidArgument);
}

TEST(SearchMission, SeveralPicturesOfOnePlaceAreOneLook) {
  ToyRun runs[2];
  for (std::size_t k = 0; k < 2; ++k) {
    SearchMission mission = mission_of(Strategy::kPlan);
    ToyRobot robot(one_room(), {1.0, 1.0, 0.3}, true, 3);
    robot.pictures_at_once = k == 0 ? 1 : 12;
    runs[k] = robot.run(mission, 600.0);
  }
  ASSERT_TRUE(runs[0].end && runs[1].end);
  EXPECT_EQ(runs[0].end->kind, EndKind::kNotFoundAreaCovered);
  EXPECT_EQ(runs[0].end, runs[1].end);
  EXPECT_EQ(runs[0].images, runs[1].images);
  EXPECT_EQ(runs[0].summary, runs[1].summary);
}

TEST(SearchMission, SearchThatMapsTooVisitsEachViewOnceAndEnds) {
  auto mission = mission_of(Strategy::kPlan);
  ToyRobot robot(one_room(), {1.0, 1.0, 0.3}, true, 5);
  const std::vector<Pose2> views{{4.4, 0.7, -kPi / 2.0}, {4.4, 0.7, kPi / 2.0}, {0.6, 4.4, kPi}};
  int asked = 0;
  std::vector<double> nearest(views.size(), 10.0);
  robot.map_views = [&] {
    ++asked;
    for (std::size_t k = 0; k < views.size(); ++k) {
      if (std::abs(wrap_angle(robot.pose().theta_rad - views[k].theta_rad)) < 0.2) {
        nearest[k] = std::min(nearest[k], distance_m(robot.pose(), views[k]));
      }
    }
    return views;
  };
  const ToyRun run = robot.run(mission, 1200.0);
  print("plan, views", run);
  ASSERT_TRUE(run.end.has_value()) << "views that stay are not visited for ever";
  EXPECT_EQ(run.end->kind, EndKind::kNotFoundAreaCovered);
  EXPECT_GE(run.summary.covered_area_m2, 0.97 * run.summary.reachable_area_m2);
  EXPECT_GT(asked, 3);
  for (const double distance : nearest) {
    EXPECT_LT(distance, 0.3) << "a goal is chosen where the last one was reached, facing what was to be seen";
  }
}

TEST(SearchMission, EvidenceFollowsAMovedMap) {
  auto mission = mission_of(Strategy::kPlan);
  ToyRobot robot(one_room(), {1.0, 1.0, 0.3}, true, 5);
  ASSERT_FALSE(robot.run(mission, 12.0).end.has_value());
  const GridLists before = mission.lists();
  const Point2 inside_m(0.05, 0.05);  // the middle of a cell of the lists is a corner of cells of the evidence
  std::vector<double> probabilities;
  for (const Point2& p : before.searched) {
    probabilities.push_back(mission.evidence().probability_at(p + inside_m));
  }
  ASSERT_GT(std::count_if(probabilities.begin(), probabilities.end(), [](double p) { return p > 0.5; }), 3);
  const Pose2 new_T_old{2.4, -1.6, 0.0};  // whole cells, so that nothing is lost to rounding
  mission.transform(new_T_old);
  for (std::size_t k = 0; k < before.searched.size(); ++k) {
    const Point2 moved = new_T_old * before.searched[k];
    EXPECT_NEAR(mission.evidence().probability_at(moved + inside_m), probabilities[k], 0.05);
    EXPECT_THAT(mission.lists().searched[k], Point2Near(moved, 1e-9));
  }
  EXPECT_LT(mission.evidence().probability_at(new_T_old * Point2(-2.0, -2.0)), 0.01);
}

TEST(SearchMission, PlanFindsAndApproachesATargetInTheOtherRoom) {
  ToyWorld world = furnished_rooms();
  world.target = Point2(9.4, 0.8);
  auto mission = mission_of(Strategy::kPlan);
  ToyRobot robot(world, {1.0, 1.0, 0.3}, true, 6);
  const ToyRun run = robot.run(mission, 1200.0);
  print("plan, target", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kTargetFound);
  ASSERT_FALSE(run.detections.empty());
  const Detection& found = run.detections.front();
  ASSERT_TRUE(found.position_map.has_value());
  EXPECT_THAT(*found.position_map, Point2Near(*world.target, 0.2));
  EXPECT_EQ(found.range_source, RangeSource::kLidar);
  EXPECT_LT((run.pose.translation() - *world.target).norm(), 1.2);
  EXPECT_GT(run.least_clearance_m, 0.2);
}

TEST(SearchMission, OfSeveralTargetsTheEndNamesThoseNotFound) {
  ToyWorld world = furnished_rooms();
  world.target = Point2(4.0, 4.0);
  SearchRequest request;
  request.strategy = Strategy::kPlan;
  request.targets = {{"box", 0.3}, {"ring", 0.3}};
  auto mission = SearchMission::create(request, {}, shared_table());
  ASSERT_TRUE(mission) << mission.error().message;
  ToyRobot robot(world, {1.0, 1.0, 0.3}, true, 6);
  const ToyRun run = robot.run(*mission, 600.0);
  print("two targets", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kTargetFound);
  EXPECT_TRUE(run.end->cause.ends_with("; not found: 'ring'")) << run.end->cause;
}

TEST(SearchMission, WhatIsNotThereFromNearIsRefusedAndTheSearchGoesOn) {
  ToyWorld world = furnished_rooms();
  world.target = Point2(8.9, 4.0);
  world.recognise_range_m = 4.0;
  world.recognise_from_m = 2.2;  // beyond all places of an approach
  auto mission = mission_of(Strategy::kPlan);
  ToyRobot robot(world, {1.0, 1.0, 0.3}, true, 6);
  const ToyRun run = robot.run(mission, 1500.0);
  print("plan, mirage", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kNotFoundAreaCovered);
  const auto refuted = std::count_if(run.events.begin(), run.events.end(),
                                     [](const SearchEvent& event) { return event.kind == "refuted"; });
  EXPECT_GE(refuted, 1);
}

TEST(SearchMission, PlanWithSonarsOnlyFindsATarget) {
  ToyWorld world = one_room();
  world.target = Point2(4.2, 4.2);
  auto mission = mission_of(Strategy::kPlan);
  ToyRobot robot(world, {0.8, 0.8, 0.3}, false, 7);
  const ToyRun run = robot.run(mission, 1200.0);
  print("plan, sonars", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kTargetFound);
}

TEST(SearchMission, PaperFindsATargetBySonarAndBearing) {
  ToyWorld world = one_room();
  world.target = Point2(4.2, 4.2);
  auto mission = mission_of(Strategy::kPaper);
  ToyRobot robot(world, {0.8, 0.8, 0.0}, false, 8);
  const ToyRun run = robot.run(mission, 1800.0);
  print("paper, target", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kTargetFound);
  ASSERT_FALSE(run.detections.empty());
  ASSERT_TRUE(run.detections.front().position_map.has_value());
  EXPECT_THAT(*run.detections.front().position_map, Point2Near(*world.target, 0.4));
}

TEST(SearchMission, PaperEndsCleanlyWithoutATarget) {
  auto mission = mission_of(Strategy::kPaper);
  ToyRobot robot(one_room(), {0.8, 0.8, 0.0}, false, 9);
  const ToyRun run = robot.run(mission, 3600.0);
  print("paper", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kNotFoundAreaCovered);
  EXPECT_GE(run.lists.searched.size(), 10U);
  EXPECT_TRUE(run.lists.unsearched.empty());
}

TEST(SearchMission, PaperStaysInsideItsBound) {
  nav::ForbiddenAreas areas;
  areas.bound = Polygon{{-1, -1}, {6, -1}, {6, 1.8}, {-1, 1.8}};
  auto mission = mission_of(Strategy::kPaper, OnFound::kApproach, areas);
  ToyRobot robot(one_room(), {0.8, 0.8, 0.0}, false, 10);
  const ToyRun run = robot.run(mission, 900.0, areas.bound);
  print("paper, bound", run);
  EXPECT_FALSE(run.left_bound);
  for (const Point2& p : run.lists.searched) {
    EXPECT_TRUE(areas.allows(p));
  }
}

TEST(SearchMission, PlanKeepsOutAndListsWhy) {
  nav::ForbiddenAreas areas;
  areas.keep_out.push_back({{5.2, 0.0}, {10.2, 0.0}, {10.2, 5.0}, {5.2, 5.0}});
  auto mission = mission_of(Strategy::kPlan, OnFound::kApproach, areas);
  ToyRobot robot(furnished_rooms(), {1.0, 1.0, 0.3}, true, 11);
  const ToyRun run = robot.run(mission, 900.0);
  print("plan, keep-out", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_LT(run.pose.x_m, 5.2);
  const auto report = mission.evidence_report();
  EXPECT_TRUE(std::any_of(report.gaps.begin(), report.gaps.end(),
                          [](const Gap& gap) { return gap.reason == "keep-out" && gap.area_m2 > 1.0; }));
}

TEST(SearchMission, BaselinesEnd) {
  for (const Strategy strategy : {Strategy::kSpiral, Strategy::kFrontier}) {
    auto mission = mission_of(strategy);
    ToyRobot robot(furnished_rooms(), {1.0, 1.0, 0.3}, true, 12);
    const ToyRun run = robot.run(mission, 2400.0);
    print(std::string(to_string(strategy)).c_str(), run);
    ASSERT_TRUE(run.end.has_value());
    EXPECT_EQ(run.end->kind, EndKind::kNotFoundAreaCovered);
    EXPECT_GT(run.summary.covered_area_m2, 0.5 * run.summary.reachable_area_m2);
    EXPECT_GT(run.least_clearance_m, 0.2);
  }
}

TEST(SearchMission, GapsOnlyContinuesFromEarlierEvidence) {
  auto first = mission_of(Strategy::kPlan);
  ToyRobot robot(furnished_rooms(), {1.0, 1.0, 0.3}, true, 13);
  const ToyRun run = robot.run(first, 1200.0);
  ASSERT_TRUE(run.end.has_value());
  SearchRequest request = first.request();
  request.gaps_only = true;
  auto second = SearchMission::create(request, {}, shared_table());
  second->keep_evidence(first.evidence());
  const ToyRun again = robot.run(*second, 1200.0);
  print("gaps", again);
  ASSERT_TRUE(again.end.has_value());
  EXPECT_LT(again.images, run.images);
  EXPECT_GE(again.summary.covered_area_m2, 0.97 * again.summary.reachable_area_m2);
}

TEST(SearchMission, SameInputsGiveTheSameEvents) {
  ToyWorld world = furnished_rooms();
  world.target = Point2(9.4, 0.8);
  std::vector<ToyRun> runs;
  for (int k = 0; k < 2; ++k) {
    auto mission = mission_of(Strategy::kPlan);
    ToyRobot robot(world, {1.0, 1.0, 0.3}, true, 14);
    runs.push_back(robot.run(mission, 1200.0));
  }
  EXPECT_EQ(runs[0].events, runs[1].events);
  EXPECT_EQ(runs[0].pose, runs[1].pose);
  EXPECT_FALSE(runs[0].events.empty());
}

TEST(SearchMission, NanFromASonarStopsTheRobotAndSaysWhy) {
  auto mission = mission_of(Strategy::kPaper);
  ToyRobot robot(one_room(), {0.8, 0.8, 0.0}, false, 15);
  nav::OccupancyMap map;
  SonarScan scan = robot.sonar(robot_time_s(0.0));
  scan.readings[3].range_m = std::nanf("");
  const SearchStep step = mission.step({robot_time_s(0.0), {}, Matrix3::Zero(), &scan, nullptr, map, 0});
  EXPECT_EQ(step.command, Twist2{});
  EXPECT_EQ(step.phase, "stopped");
  EXPECT_NE(step.activity.find("sonar"), std::string::npos);
  ASSERT_FALSE(step.events.empty());
  // Silence: the reading grows old.
  scan = robot.sonar(robot_time_s(0.0));
  const SearchStep silent = mission.step({robot_time_s(2.0), {}, Matrix3::Zero(), &scan, nullptr, map, 0});
  EXPECT_EQ(silent.phase, "stopped");
}

TEST(SearchMission, PausedTimeDoesNotCount) {
  auto mission = mission_of(Strategy::kPaper);
  ToyRobot robot(one_room(), {0.8, 0.8, 0.0}, false, 16);
  nav::OccupancyMap map;
  const auto step_at = [&](double t) {
    const SonarScan scan = robot.sonar(robot_time_s(t));
    return mission.step({robot_time_s(t), {0.8, 0.8, 0.0}, Matrix3::Zero(), &scan, nullptr, map, 0});
  };
  for (int k = 0; k < 10; ++k) {
    (void)step_at(0.1 * k);
  }
  EXPECT_TRUE(step_at(1.0).wants_image);
  mission.pause();
  mission.resume(robot_time_s(500.0));
  for (int k = 0; k < 10; ++k) {
    for (const SearchEvent& event : step_at(500.0 + 0.1 * k).events) {
      EXPECT_NE(event.kind, "no_image");
    }
  }
}

TEST(SearchMission, AnUncertainPoseEndsIt) {
  auto mission = mission_of(Strategy::kPlan);
  nav::OccupancyMap map;
  const SearchStep step = mission.step({robot_time_s(0.0), {}, 25.0 * Matrix3::Identity(), nullptr, nullptr, map, 0});
  ASSERT_TRUE(step.end.has_value());
  EXPECT_EQ(step.end->kind, EndKind::kUncertain);
  EXPECT_FALSE(step.end->remedy.empty());
}

TEST(SearchMission, RefusesBadRequests) {
  SearchRequest request;
  EXPECT_FALSE(SearchMission::create(request, {}, shared_table()).has_value());
  request.targets = {{"box", -1.0, 0.4, 0.0}};
  EXPECT_FALSE(SearchMission::create(request, {}, shared_table()).has_value());
  request.targets = {{"box"}};
  request.areas.bound = Polygon{{0, 0}, {1, 1}, {1, 0}, {0, 1}};  // crosses itself
  EXPECT_FALSE(SearchMission::create(request, {}, shared_table()).has_value());
  request.areas.bound.reset();
  SearchParams params;
  params.evidence.cell_m = 0.0;
  EXPECT_FALSE(SearchMission::create(request, params, shared_table()).has_value());
  EXPECT_FALSE(SearchMission::create(request, {}, nullptr).has_value());
  EXPECT_TRUE(SearchMission::create(request, {}, shared_table()).has_value());
}

}  // namespace
}  // namespace seeker::search
