#include "server/app/missions/mission_executor.hpp"

#include <gtest/gtest.h>

#include "tests/unit/server/app/missions/mission_fixture.hpp"

namespace seeker::app {
namespace {

using std::chrono::seconds;

class MissionExecutorTest : public MissionFixture {
 protected:
  const api::Fault fault{.id = "sonar-silent",
                         .component = "sonar",
                         .severity = api::Severity::kError,
                         .onset = {},
                         .message = "the sonar has been silent",
                         .remedy = "check its cable"};
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
  executor.client_silent("anna", wall);
  static_cast<void>(tick());
  EXPECT_TRUE(executor.present());
  wall += seconds(6);
  static_cast<void>(tick());
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost);
}

TEST_F(MissionExecutorTest, ClientThatComesBackInTimeKeepsItsMission) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  executor.client_silent("anna", wall);
  wall += seconds(3);
  executor.client_back("anna", situation.now);
  wall += seconds(10);
  static_cast<void>(tick());
  EXPECT_TRUE(executor.present());
}

TEST_F(MissionExecutorTest, PoliciesContinueFinishStepAndReturn) {
  ASSERT_TRUE(executor.start(request("go-on", api::LinkPolicy::kContinue), "anna", situation));
  executor.client_silent("anna", wall);
  wall += seconds(6);
  static_cast<void>(tick());
  EXPECT_TRUE(executor.present());
  executor.end(api::Outcome::kOperator, "test", "", situation.now);

  ASSERT_TRUE(executor.start(request("finish", api::LinkPolicy::kFinishStep), "anna", situation));
  executor.client_silent("anna", wall);
  wall += seconds(6);
  static_cast<void>(tick());
  EXPECT_TRUE(executor.present());
  script->next.step_done = true;
  static_cast<void>(tick());
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost);

  script->next = {};
  ASSERT_TRUE(executor.start(request("home", api::LinkPolicy::kReturn), "anna", situation));
  executor.client_silent("anna", wall);
  wall += seconds(6);
  static_cast<void>(tick());
  EXPECT_EQ(made.back(), "return");
  script->next.end =
      api::MissionEnd{.outcome = api::Outcome::kComplete, .cause = "home", .remedy = "", .unreachable = {}};
  static_cast<void>(tick());
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost) << "coming home does not make the mission a success";
}

api::MissionEnd ended(api::Outcome outcome, const std::string& cause,
                      const std::vector<UnreachablePlace>& unreachable = {}) {
  return {.outcome = outcome, .cause = cause, .remedy = "", .unreachable = unreachable};
}

TEST_F(MissionExecutorTest, AMissionThatIsOverKeepsItsEndWhenTheWayHomeIsCutShort) {
  const auto lose_the_robot = [this] {
    situation.pose.quality = LocalisationQuality::kLost;
    situation.pose.cause = "the scan does not fit the map";
    static_cast<void>(tick());
    static_cast<void>(tick(11.0));
    situation.pose.quality = LocalisationQuality::kLocalised;
  };
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->pending = ended(api::Outcome::kUnreachable, "no way leads to what is left",
                          {{Point2(7.0, 1.0), UnreachableCause::kCutOff, 0.0, ""}});
  lose_the_robot();
  EXPECT_EQ(end().outcome, api::Outcome::kUnreachable);
  EXPECT_EQ(end().cause,
            "no way leads to what is left; the robot is not back at its start: the scan does not fit the map");
  EXPECT_EQ(end().unreachable.size(), 1U);

  script->pending = ended(api::Outcome::kComplete, "nothing is left");
  api::MissionRequest timed = request("two");
  timed.time_limit = seeker::seconds(1.0);
  ASSERT_TRUE(executor.start(timed, "anna", situation));
  static_cast<void>(tick());
  static_cast<void>(tick(2.0));
  static_cast<void>(tick());
  EXPECT_EQ(end().outcome, api::Outcome::kComplete);
  EXPECT_DOUBLE_EQ(executor.last()->progress, 1.0);

  ASSERT_TRUE(executor.start(request("three"), "anna", situation));
  static_cast<void>(tick());
  ASSERT_TRUE(executor.command(api::MissionCommand::kStop, situation.now));
  EXPECT_EQ(end().outcome, api::Outcome::kOperator) << "his word is the last";
}

TEST_F(MissionExecutorTest, AMissionWhoseBoundTheRobotStandsFarOutsideOfIsRefused) {
  api::MissionRequest bounded = request("bounded");
  api::ExploreMission explore;
  explore.bound = Polygon{{10.0, 0.0}, {12.0, 0.0}, {12.0, 2.0}, {10.0, 2.0}};
  bounded.task = explore;
  const Result<api::MissionId> refused = executor.start(bounded, "anna", situation);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kRefused);
  EXPECT_NE(refused.error().message.find("outside the bound"), std::string::npos) << refused.error().message;
  MissionSoFar before;
  before.start_map = Point2(11.0, 1.0);
  EXPECT_TRUE(executor.start(bounded, "anna", situation, before)) << "one that was cut off goes on";
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  situation.pose.map_T_base = {9.5, 1.0, 0.0};
  bounded.id = "near";
  EXPECT_TRUE(executor.start(bounded, "anna", situation)) << "half a metre outside";
}

TEST_F(MissionExecutorTest, AWayHomeForAClientThatIsGoneIsToldWhateverCutsItShort) {
  ASSERT_TRUE(executor.start(request("home", api::LinkPolicy::kReturn), "anna", situation));
  executor.client_silent("anna", wall);
  wall += seconds(6);
  static_cast<void>(tick());
  ASSERT_EQ(made.back(), "return");
  static_cast<void>(tick(0.1, &fault));
  static_cast<void>(tick(11.0, &fault));
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost);
  EXPECT_NE(end().cause.find("not back at its start: " + fault.message), std::string::npos) << end().cause;
  EXPECT_NE(end().remedy.find("check its cable"), std::string::npos) << end().remedy;
}

TEST_F(MissionExecutorTest, AMissionThatEndsUndoneDoesNotClaimToBeDone) {
  for (const auto& [outcome, progress] : {std::pair{api::Outcome::kComplete, 1.0},
                                          {api::Outcome::kBoundReached, 1.0},
                                          {api::Outcome::kBattery, 0.4},
                                          {api::Outcome::kUnreachable, 0.4}}) {
    script->next = {};
    ASSERT_TRUE(executor.start(request("m" + std::to_string(static_cast<int>(outcome))), "anna", situation));
    script->next.progress = 0.4;
    script->next.end = ended(outcome, "because");
    static_cast<void>(tick());
    EXPECT_DOUBLE_EQ(executor.last()->progress, progress) << to_string(outcome);
  }
}

TEST_F(MissionExecutorTest, APauseIsNoTimeOfTrouble) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  static_cast<void>(tick(0.1, &fault));
  ASSERT_TRUE(executor.command(api::MissionCommand::kPause, situation.now));
  static_cast<void>(tick(60.0, &fault));
  ASSERT_TRUE(executor.command(api::MissionCommand::kResume, situation.now));
  static_cast<void>(tick(0.1, &fault));
  EXPECT_TRUE(executor.present()) << "the fault has its grace again";
  static_cast<void>(tick(11.0, &fault));
  EXPECT_EQ(end().outcome, api::Outcome::kFault);
}

TEST_F(MissionExecutorTest, OneTroubleAfterAnotherHasItsOwnGrace) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  static_cast<void>(tick(0.1, &fault));
  static_cast<void>(tick(6.0, &fault));
  situation.pose.quality = LocalisationQuality::kLost;
  static_cast<void>(tick(6.0));
  static_cast<void>(tick(0.1, &fault));
  EXPECT_TRUE(executor.present()) << "that fault has only just begun";
}

TEST_F(MissionExecutorTest, BlockingFaultHoldsThenEndsTheMissionWithTheRemedy) {
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

TEST_F(MissionExecutorTest, TimeLimitEndsTheMission) {
  api::MissionRequest limited = request("one");
  limited.time_limit = seconds(5);
  ASSERT_TRUE(executor.start(limited, "anna", situation));
  static_cast<void>(tick(4.0));
  EXPECT_TRUE(executor.present());
  static_cast<void>(tick(2.0));
  EXPECT_EQ(end().outcome, api::Outcome::kTimeLimit);
}

TEST_F(MissionExecutorTest, OnlyTimeInWhichAMissionRunsCountsTowardsItsLimit) {
  api::MissionRequest limited = request("one");
  limited.time_limit = seconds(20);
  ASSERT_TRUE(executor.start(limited, "anna", situation));
  static_cast<void>(tick(5.0));
  EXPECT_EQ(script->time_left, Duration(seconds(15)));
  ASSERT_TRUE(executor.command(api::MissionCommand::kPause, situation.now));
  static_cast<void>(tick(600.0));
  ASSERT_TRUE(executor.command(api::MissionCommand::kResume, situation.now));
  static_cast<void>(tick(0.1));
  for (int k = 0; k < 4; ++k) {
    static_cast<void>(tick(2.0, &fault));
  }
  static_cast<void>(tick(0.1));
  ASSERT_TRUE(executor.running());
  EXPECT_GT(*script->time_left, Duration(seconds(14)));
  static_cast<void>(tick(16.0));
  EXPECT_EQ(end().outcome, api::Outcome::kTimeLimit);
}

TEST_F(MissionExecutorTest, MissionThatWasCutOffGoesOnWithItsStartAndItsTime) {
  api::MissionRequest limited = request("one");
  limited.time_limit = seconds(100);
  situation.now += seconds(500);
  const MissionSoFar so_far{Point2(3.0, 4.0), seconds(70)};
  ASSERT_TRUE(executor.start(limited, "anna", situation, so_far));
  EXPECT_EQ(script->start, so_far.start_map);
  static_cast<void>(tick(10.0));
  EXPECT_EQ(script->time_left, Duration(seconds(20)));
  EXPECT_EQ(executor.last()->updated - executor.last()->started, Duration(seconds(80)));
  executor.map_moved({.move = Pose2{1.0, 0.0, 0.0}, .from_epoch = 0, .to_epoch = 1}, situation.now);
  EXPECT_EQ(executor.so_far(), (MissionSoFar{Point2(4.0, 4.0), seconds(80)}));
}

TEST_F(MissionExecutorTest, WayHomeOfALostClientsMissionKeepsToItsGroundAndTellsHowItEnded) {
  const Polygon bound{{-1.0, -1.0}, {5.0, -1.0}, {5.0, 5.0}, {-1.0, 5.0}};
  const Polygon stairs{{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}};
  api::MissionRequest exploration = request("one", api::LinkPolicy::kReturn);
  api::ExploreMission explore;
  explore.bound = bound;
  explore.keep_out = {stairs};
  exploration.task = explore;
  ASSERT_TRUE(executor.start(exploration, "anna", situation));
  executor.client_silent("anna", wall);
  wall += seconds(6);
  static_cast<void>(tick());
  ASSERT_TRUE(std::holds_alternative<api::ReturnMission>(made_last));
  EXPECT_EQ(std::get<api::ReturnMission>(made_last).bound, bound);
  EXPECT_EQ(std::get<api::ReturnMission>(made_last).keep_out, std::vector<Polygon>{stairs});
  script->next.end = api::MissionEnd{.outcome = api::Outcome::kUnreachable,
                                     .cause = "1 of 1 places cannot be reached",
                                     .remedy = "clear the way",
                                     .unreachable = {{Point2::Zero(), UnreachableCause::kBlocked, 0.0, ""}}};
  static_cast<void>(tick());
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost);
  EXPECT_NE(end().cause.find("'anna' that started the mission is gone"), std::string::npos) << end().cause;
  EXPECT_NE(end().cause.find("1 of 1 places cannot be reached"), std::string::npos) << end().cause;
  EXPECT_EQ(positions_of(end().unreachable), std::vector<Point2>{Point2::Zero()});
}

}  // namespace
}  // namespace seeker::app
