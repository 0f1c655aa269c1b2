#include "server/app/mission_executor.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::app {
namespace {

using std::chrono::seconds;

/// A behaviour whose next decision the test writes.
struct Script {
  Decision next;
  int steps = 0;
  int resumed = 0;
  std::optional<Pose2> moved;
  std::optional<api::GridReport> grid;
  std::optional<SearchedFloor> searched;
  std::vector<api::Detection> detections;
  Point2 asked_about = Point2::Zero();  ///< for what it has searched
};

class ScriptedBehaviour final : public Behaviour {
 public:
  explicit ScriptedBehaviour(std::shared_ptr<Script> script) : script_(std::move(script)) {}
  Decision step(const Situation& /*situation*/) override {
    ++script_->steps;
    return script_->next;
  }
  void resumed(RobotTime /*now*/) override { ++script_->resumed; }
  void map_moved(const Pose2& new_T_old) override { script_->moved = new_T_old; }
  std::optional<api::GridReport> grid() const override { return script_->grid; }
  std::optional<SearchedFloor> searched(const Point2& middle_map, int /*side_cells*/) const override {
    script_->asked_about = middle_map;
    return script_->searched;
  }
  std::vector<api::Detection> detections() const override { return script_->detections; }

 private:
  std::shared_ptr<Script> script_;
};

SearchedFloor searched_floor() {
  return {{"mug"}, {}, std::make_shared<const Grid<std::uint8_t>>(GridFrame{}, 2, 2, std::uint8_t{100})};
}

class MissionExecutorTest : public ::testing::Test {
 protected:
  MissionExecutorTest()
      : executor(
            {},
            [this](const api::MissionTask& task, const Situation& /*situation*/) -> Result<std::unique_ptr<Behaviour>> {
              made.emplace_back(api::task_name(task));
              return std::unique_ptr<Behaviour>(std::make_unique<ScriptedBehaviour>(script));
            },
            {.event = [this](const api::Event& event) { events.push_back(event); },
             .status = [this](const api::MissionStatus& status) { reports.push_back(status); },
             .detection = [this](const api::Detection& detection) { told.push_back(detection); }}) {
    situation.pose.quality = LocalisationQuality::kLocalised;
  }

  static api::MissionRequest request(const std::string& id, api::LinkPolicy policy = api::LinkPolicy::kStop) {
    api::MissionRequest r;
    r.id = id;
    r.task = api::GotoMission{.waypoints = {Point2(1, 0)}, .final_heading_rad = std::nullopt, .keep_out = {}};
    r.link_policy = policy;
    return r;
  }

  Decision tick(double dt_s = 0.1, const api::Fault* blocking = nullptr) {
    situation.now += seeker::seconds(dt_s);
    wall += std::chrono::milliseconds(100);
    return executor.step(situation, blocking, wall);
  }

  api::MissionEnd end() const { return executor.last()->end.value_or(api::MissionEnd{}); }

  std::shared_ptr<Script> script = std::make_shared<Script>();
  std::vector<std::string> made;
  std::vector<api::Event> events;
  std::vector<api::MissionStatus> reports;
  std::vector<api::Detection> told;
  Situation situation;
  WallTime wall;
  MissionExecutor executor;
};

TEST_F(MissionExecutorTest, SecondMissionIsBusyTheSameIdIsAccepted) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  EXPECT_TRUE(executor.start(request("one"), "anna", situation));
  const Result<api::MissionId> second = executor.start(request("two"), "ben", situation);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::kBusy);
  EXPECT_EQ(made.size(), 1U);
}

TEST_F(MissionExecutorTest, BehaviourEndsTheMissionWithItsOutcome) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->next.end =
      api::MissionEnd{.outcome = api::Outcome::kComplete, .cause = "done", .remedy = "", .unreachable = {}};
  static_cast<void>(tick());
  EXPECT_FALSE(executor.present());
  EXPECT_EQ(end().outcome, api::Outcome::kComplete);
  EXPECT_EQ(events.back().kind, "mission-ended");
  EXPECT_EQ(events.back().mission_time, Duration(std::chrono::milliseconds(100)));
}

TEST_F(MissionExecutorTest, PauseHoldsTheBehaviourAndResumeTellsIt) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->next.command = {0.3, 0.0};
  ASSERT_TRUE(executor.command(api::MissionCommand::kPause, situation.now));
  EXPECT_EQ(tick().command, Twist2{});
  EXPECT_EQ(script->steps, 0);
  ASSERT_TRUE(executor.command(api::MissionCommand::kResume, situation.now));
  EXPECT_EQ(script->resumed, 1);
  EXPECT_EQ(tick().command, (Twist2{0.3, 0.0}));
}

TEST_F(MissionExecutorTest, LostClientStopsTheMissionAfterTheGrace) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  executor.client_lost("anna", wall);
  static_cast<void>(tick());
  EXPECT_TRUE(executor.present());
  wall += seconds(6);
  static_cast<void>(tick());
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost);
}

TEST_F(MissionExecutorTest, ClientThatComesBackInTimeKeepsItsMission) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  executor.client_lost("anna", wall);
  wall += seconds(3);
  executor.client_back("anna");
  wall += seconds(10);
  static_cast<void>(tick());
  EXPECT_TRUE(executor.present());
}

TEST_F(MissionExecutorTest, PoliciesContinueFinishStepAndReturn) {
  ASSERT_TRUE(executor.start(request("go-on", api::LinkPolicy::kContinue), "anna", situation));
  executor.client_lost("anna", wall);
  wall += seconds(6);
  static_cast<void>(tick());
  EXPECT_TRUE(executor.present());
  executor.end(api::Outcome::kOperator, "test", "", situation.now);

  ASSERT_TRUE(executor.start(request("finish", api::LinkPolicy::kFinishStep), "anna", situation));
  executor.client_lost("anna", wall);
  wall += seconds(6);
  static_cast<void>(tick());
  EXPECT_TRUE(executor.present());
  script->next.step_done = true;
  static_cast<void>(tick());
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost);

  script->next = {};
  ASSERT_TRUE(executor.start(request("home", api::LinkPolicy::kReturn), "anna", situation));
  executor.client_lost("anna", wall);
  wall += seconds(6);
  static_cast<void>(tick());
  EXPECT_EQ(made.back(), "return");
  script->next.end =
      api::MissionEnd{.outcome = api::Outcome::kComplete, .cause = "home", .remedy = "", .unreachable = {}};
  static_cast<void>(tick());
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost) << "coming home does not make the mission a success";
}

TEST_F(MissionExecutorTest, BlockingFaultHoldsThenEndsTheMissionWithTheRemedy) {
  const api::Fault fault{.id = "sonar-silent",
                         .component = "sonar",
                         .severity = api::Severity::kError,
                         .onset = {},
                         .message = "the sonar has been silent",
                         .remedy = "check its cable"};
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  static_cast<void>(tick(0.1, &fault));
  EXPECT_EQ(script->steps, 0);
  EXPECT_TRUE(executor.present());
  static_cast<void>(tick(11.0, &fault));
  EXPECT_EQ(end().outcome, api::Outcome::kFault);
  EXPECT_EQ(end().remedy, "check its cable");
}

TEST_F(MissionExecutorTest, LostPoseEndsTheMissionAfterTheGrace) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  situation.pose.quality = LocalisationQuality::kLost;
  situation.pose.cause = "the scan does not fit the map";
  static_cast<void>(tick());
  static_cast<void>(tick(11.0));
  EXPECT_EQ(end().outcome, api::Outcome::kLost);
}

TEST_F(MissionExecutorTest, MissionStandsUntilALostRobotIsFoundNotOnlyUntilItIsLookedFor) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->next.command = {0.3, 0.0};
  situation.pose.quality = LocalisationQuality::kLost;
  static_cast<void>(tick());
  situation.pose.quality = LocalisationQuality::kUnknown;
  situation.pose.cause = "looking for the place in the map";
  EXPECT_EQ(tick().command, Twist2{});
  EXPECT_EQ(script->steps, 0);
  EXPECT_EQ(executor.last()->activity, "waiting: looking for the place in the map");
  situation.pose.quality = LocalisationQuality::kDegraded;
  EXPECT_EQ(tick().command, (Twist2{0.3, 0.0}));
  EXPECT_EQ(events.back().kind, "mission-continues");
  situation.pose.quality = LocalisationQuality::kUnknown;
  static_cast<void>(tick());
  static_cast<void>(tick(11.0));
  EXPECT_EQ(end().outcome, api::Outcome::kLost);
}

TEST_F(MissionExecutorTest, DecisionIsReportedAtOnceAndOnlyOnceButKept) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->next.phase = "explore";
  static_cast<void>(tick());
  const std::size_t before = reports.size();
  script->next.exploration = ExploreDecision{
      .number = 1, .stamp = situation.now, .rule = "one-step", .candidates = {{}}, .chosen = 0, .why = "it is near"};
  static_cast<void>(tick());
  ASSERT_EQ(reports.size(), before + 1) << "no report period has passed";
  EXPECT_EQ(reports.back().decision, script->next.exploration);
  script->next.exploration.reset();
  static_cast<void>(tick(2.0));
  ASSERT_EQ(reports.size(), before + 2);
  EXPECT_FALSE(reports.back().decision);
  ASSERT_TRUE(executor.last()->decision);
  EXPECT_EQ(executor.last()->decision->number, 1U);
}

TEST_F(MissionExecutorTest, MovedMapMovesTheMissionAndResultsCarryTheirEpoch) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->grid = api::GridReport{};
  script->next.phase = "cover";
  static_cast<void>(tick());
  EXPECT_EQ(executor.grid()->map_epoch, 0U);
  situation.pose.map_epoch = 3;
  situation.pose.map_T_base.x_m = 5.0;
  executor.map_moved({.new_T_old = {5.0, 0.0, 0.0}, .from_epoch = 0, .to_epoch = 3}, situation.now);
  ASSERT_TRUE(script->moved);
  EXPECT_EQ(*script->moved, (Pose2{5.0, 0.0, 0.0}));
  EXPECT_EQ(events.back().kind, "map-moved");
  script->next.phase = "approach";
  static_cast<void>(tick());
  EXPECT_EQ(executor.grid()->map_epoch, 3U);
  EXPECT_EQ(executor.grid()->evidence.map_epoch, 3U);
  EXPECT_DOUBLE_EQ(executor.last()->path_length_m, 0.0) << "the robot did not drive where the map moved";
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  script->moved.reset();
  executor.map_moved({.new_T_old = {1.0, 0.0, 0.0}, .from_epoch = 3, .to_epoch = 4}, situation.now);
  EXPECT_FALSE(script->moved);
  EXPECT_EQ(executor.grid()->map_epoch, 3U) << "the grid of an ended mission keeps its epoch";
}

api::Detection mug_at(const Point2& p_map) {
  api::Detection mug;
  mug.id = 1;
  mug.target = "mug";
  mug.position = p_map;
  return mug;
}

TEST_F(MissionExecutorTest, WhatAnEndedMissionHasFoundAndSearchedMovesWithTheMapItBelongsTo) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->detections = {mug_at({2.0, 0.0})};
  script->searched = searched_floor();
  static_cast<void>(tick());
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  const Pose2 new_T_old{1.0, 3.0, kPi / 2.0};
  executor.map_moved({.new_T_old = new_T_old, .from_epoch = 0, .to_epoch = 2}, situation.now);
  situation.pose.map_epoch = 2;
  ASSERT_EQ(executor.detections().size(), 1U);
  EXPECT_THAT(*executor.detections()[0].position, testing::Point2Near(Point2(1.0, 5.0), 1e-9));
  EXPECT_EQ(executor.detections()[0].map_epoch, 2U);
  ASSERT_TRUE(executor.searched(situation.pose));
  EXPECT_EQ(executor.searched(situation.pose)->map_T_grid, new_T_old);
  // Another map was loaded: what is left of the one before is no part of it.
  executor.map_moved({.new_T_old = new_T_old, .from_epoch = 3, .to_epoch = 4}, situation.now);
  situation.pose.map_epoch = 4;
  EXPECT_EQ(executor.detections()[0].map_epoch, 2U);
  EXPECT_FALSE(executor.searched(situation.pose));
}

TEST_F(MissionExecutorTest, WhatARunningMissionHasFoundIsToldAsItsBehaviourHasMovedIt) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  situation.pose.map_T_base = {1.0, 0.0, 0.0};
  script->detections = {mug_at({2.0, 0.0})};
  static_cast<void>(tick(2.0));
  ASSERT_EQ(told.size(), 1U);
  script->detections = {mug_at({7.0, 0.0})};
  executor.map_moved({.new_T_old = {5.0, 0.0, 0.0}, .from_epoch = 0, .to_epoch = 1}, situation.now);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told.back().map_epoch, 1U);
  EXPECT_EQ(*executor.detections()[0].position, Point2(7.0, 0.0)) << "moved once, not twice";
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  EXPECT_EQ(script->asked_about, Point2(6.0, 0.0)) << "its last place has moved, too";
}

TEST_F(MissionExecutorTest, WhatTheLastSearchHasSearchedIsKnownAsLongAsItsMapIsUsed) {
  EXPECT_FALSE(executor.searched(situation.pose));
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->searched = searched_floor();
  static_cast<void>(tick());
  EXPECT_EQ(executor.searched(situation.pose), script->searched);
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  const auto searched = std::exchange(script->searched, std::nullopt);
  EXPECT_EQ(executor.searched(situation.pose), searched);
  ASSERT_TRUE(executor.start(request("two"), "anna", situation));
  static_cast<void>(tick());
  EXPECT_EQ(executor.searched(situation.pose), searched) << "that mission does not search";
  situation.pose.map_epoch = 1;
  EXPECT_FALSE(executor.searched(situation.pose));
}

TEST_F(MissionExecutorTest, TimeLimitEndsTheMission) {
  api::MissionRequest limited = request("one");
  limited.time_limit = seconds(5);
  ASSERT_TRUE(executor.start(limited, "anna", situation));
  static_cast<void>(tick(4.0));
  EXPECT_TRUE(executor.present());
  static_cast<void>(tick(2.0));
  EXPECT_EQ(end().outcome, api::Outcome::kTimeLimit);
}

}  // namespace
}  // namespace seeker::app
