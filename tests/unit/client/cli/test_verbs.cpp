#include <filesystem>

#include <gtest/gtest.h>

#include "client/cli/targets.hpp"
#include "common/image/pgm.hpp"
#include "common/image/png.hpp"
#include "tests/unit/client/cli/verbs_fixture.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

class Verbs : public VerbsFixture {};

TEST_F(Verbs, ReportsAreOneJsonDocumentWithTheDocumentedKeys) {
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> cases{
      {{"status"}, {"robot_id", "status", "pose", "quality", "estop", "faults", "mission"}},
      {{"components"}, {"components", "state", "rate_hz"}},
      {{"detections"}, {"detections", "target", "position", "sigma_m", "range_source"}},
      {{"grid"}, {"searched", "unsearched", "unreachable", "coverage", "gaps"}},
      {{"stop"}, {"ok", "message"}},
      {{"version"}, {"version", "protocol"}},
      {{"camera", "grab", "--out", path("view.png")}, {"file", "width_px"}},
      {{"map", "export", path("map")}, {"files"}},
  };
  for (const auto& [verb, keys] : cases) {
    std::vector<std::string> arguments = verb;
    arguments.emplace_back("--json");
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.code, 0) << verb[0] << ran.err;
    EXPECT_TRUE(is_json(ran.out)) << ran.out;
    for (const std::string& key : keys) {
      EXPECT_NE(ran.out.find("\"" + key + "\":"), std::string::npos) << verb[0] << " " << key << " in " << ran.out;
    }
  }
}

TEST_F(Verbs, GridDrawsTheEvidenceAsTheNameOfTheFileSays) {
  for (const auto& [file, beginning] : {std::pair("seen.png", "\x89PNG"), std::pair("seen.svg", "<?xml")}) {
    const Ran ran = run({"grid", "--evidence", path(file)});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(read(file).substr(0, std::string(beginning).size()), beginning);
  }
}

TEST_F(Verbs, ARobotThatIsLookedForHasNoPose) {
  EXPECT_EQ(run({"status"}).out.find("not known"), std::string::npos);
  for (const LocalisationQuality quality : {LocalisationQuality::kUnknown, LocalisationQuality::kLost}) {
    host->edit([&](testing::FakeRobotValues& v) {
      v.status.pose.quality = quality;
      v.status.pose.cause = "nothing looks like this";
    });
    const std::string text = run({"status"}).out;
    EXPECT_NE(text.find("not known in the map, " + std::string(to_string(quality)) + ": nothing looks like this"),
              std::string::npos)
        << text;
    const std::string json = run({"status", "--json"}).out;
    EXPECT_NE(json.find(R"("pose":{"x_m":null,"y_m":null,"theta_rad":null,"sigma_m":null,"quality")"),
              std::string::npos)
        << json;
  }
}

TEST_F(Verbs, AMissionThatWasCutOffIsPartOfTheStatus) {
  EXPECT_EQ(run({"status"}).out.find("cut off"), std::string::npos);
  host->edit([](testing::FakeRobotValues& v) { v.status.cut_off = api::CutOffMission{"round-1", "explore"}; });
  EXPECT_NE(run({"status"}).out.find("round-1; 'seeker resume' goes on with it"), std::string::npos);
  EXPECT_NE(run({"status", "--json"}).out.find("\"cut_off\":{\"id\":\"round-1\",\"kind\":\"explore\"}"),
            std::string::npos);
}

TEST_F(Verbs, SearchReportsTheEndAndItsExitCode) {
  const std::vector<std::pair<api::Outcome, int>> outcomes{{api::Outcome::kTargetFound, 0},
                                                           {api::Outcome::kNotFoundAreaCovered, 6},
                                                           {api::Outcome::kTimeLimit, 5},
                                                           {api::Outcome::kFault, 1}};
  for (const auto& [outcome, code] : outcomes) {
    const Ran ran = run({"search", "-t", path("board.png"), "--json"}, [&, o = outcome] { end_mission(o); });
    EXPECT_EQ(ran.code, code) << ran.err;
    EXPECT_TRUE(is_json(ran.out)) << ran.out;
    for (const char* key : {"mission", "outcome", "cause", "remedy", "detections", "coverage", "gaps", "path_length_m",
                            "robot_time_s", "wall_time_s", "exit_code"}) {
      EXPECT_NE(ran.out.find("\"" + std::string(key) + "\":"), std::string::npos) << key;
    }
    EXPECT_NE(ran.out.find("\"robot_time_s\":42.0,"), std::string::npos);
  }
  EXPECT_EQ(host->values().missions.size(), 4U);
}

TEST_F(Verbs, PlacesThatWereNotReachedHaveTheirCauseAndRemedy) {
  const std::vector<UnreachablePlace> places{{{7.0, 0.5}, UnreachableCause::kOutsideBound, 0.0, ""},
                                             {{2.0, 1.0}, UnreachableCause::kCutOff, 1.2, "behind a cupboard"}};
  const auto end = [&] { end_mission(api::Outcome::kUnreachable, 42.0, places); };
  const Ran ran = run({"goto", "7,0.5", "2,1"}, end);
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_NE(ran.out.find("unreachable (7.00, 0.50) m: it lies outside the bound of the mission"), std::string::npos)
      << ran.out;
  EXPECT_NE(ran.out.find("unreachable (2.00, 1.00) m, 1.20 m wide: behind a cupboard"), std::string::npos) << ran.out;
  host->edit([](testing::FakeRobotValues& v) { v.mission.reset(); });
  const Ran json = run({"goto", "7,0.5", "2,1", "--json"}, end);
  EXPECT_TRUE(is_json(json.out)) << json.out;
  EXPECT_NE(json.out.find(R"("unreachable":[[7.0,0.5],[2.0,1.0]])"), std::string::npos) << json.out;
  EXPECT_NE(json.out.find(R"({"place":[2.0,1.0],"cause":"cut-off","size_m":1.2,"text":"behind a cupboard","remedy":")"),
            std::string::npos)
      << json.out;
}

TEST_F(Verbs, SearchSendsWhatTheUserAskedFor) {
  write("board.yaml",
        "name: chess-board\npicture: board.png\nwidth_m: 0.6\nheight_m: 0.5\ndepth_m: 0.1\nrecogniser: features\n");
  const Ran ran = run({"search",      "-t",           "board",    "--targets",     folder_.string(), "--mode",
                       "paper",       "--on-found",   "continue", "--bound",       "0,0 4,0 4,3",    "--keep-out",
                       "1,1 2,1 2,2", "--time-limit", "60",       "--link-policy", "return",         "--gaps-only",
                       "--detach",    "--id",         "my-search"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, "my-search\n");
  const auto missions = host->values().missions;
  ASSERT_EQ(missions.size(), 1U);
  const auto& search = std::get<api::SearchMission>(missions[0].task);
  EXPECT_EQ(search.targets[0].name, "chess-board");
  EXPECT_DOUBLE_EQ(search.targets[0].width_m, 0.6);
  EXPECT_DOUBLE_EQ(search.targets[0].depth_m, 0.1);
  EXPECT_EQ(search.targets[0].recogniser, api::RecogniserKind::kFeatures);
  EXPECT_EQ(search.mode, api::SearchMode::kPaper);
  EXPECT_EQ(search.on_found, api::OnFound::kContinue);
  EXPECT_EQ(search.bound->size(), 3U);
  EXPECT_EQ(search.keep_out.size(), 1U);
  EXPECT_TRUE(search.gaps_only);
  EXPECT_EQ(missions[0].link_policy, api::LinkPolicy::kReturn);
  EXPECT_EQ(*missions[0].time_limit, seconds(60));
}

TEST_F(Verbs, ExploreSendsWhatTheUserAskedFor) {
  EXPECT_EQ(run({"explore", "--strategy", "horizon", "--bound", "0,0 4,0 4,3", "--keep-out", "1,1 2,1 2,2", "--return",
                 "--time-limit", "60", "--link-policy", "continue", "--detach", "--id", "look-round"})
                .out,
            "look-round\n");
  host->edit([](testing::FakeRobotValues& v) { v.mission.reset(); });
  EXPECT_EQ(run({"explore", "--detach"}).code, 0);
  host->edit([](testing::FakeRobotValues& v) { v.mission.reset(); });
  EXPECT_EQ(run({"search", "-t", path("board.png"), "--explore", "--detach"}).code, 0);
  EXPECT_EQ(run({"explore", "--bound", "0,0 2,2 2,0 0,2"}).code, 2);
  const auto missions = host->values().missions;
  ASSERT_EQ(missions.size(), 3U);
  const auto& explore = std::get<api::ExploreMission>(missions[0].task);
  EXPECT_EQ(explore.strategy, api::ExploreStrategy::kHorizon);
  EXPECT_EQ(explore.bound->size(), 3U);
  EXPECT_EQ(explore.keep_out.size(), 1U);
  EXPECT_TRUE(explore.return_to_start);
  EXPECT_EQ(missions[0].link_policy, api::LinkPolicy::kContinue);
  EXPECT_EQ(*missions[0].time_limit, seconds(60));
  EXPECT_EQ(std::get<api::ExploreMission>(missions[1].task), api::ExploreMission{});
  EXPECT_EQ(std::get<api::ExploreMission>(missions[1].task).strategy, api::ExploreStrategy::kTour);
  EXPECT_TRUE(std::get<api::SearchMission>(missions[2].task).explore);
}

TEST_F(Verbs, RecogniseAndSearchSendSolidsBesidePictures) {
  write("ball.yaml", "name: ball\nrecogniser: solid\nsolid: sphere\n");
  write("flat.yaml", "recogniser: solid\nsolid: sphere\npicture: board.png\n");
  EXPECT_EQ(run({"recognise", "-t", path("board.png"), "--solid", "ellipsoid", "--headings", "12", "--detach"}).code,
            0);
  host->edit([](testing::FakeRobotValues& v) { v.mission.reset(); });
  EXPECT_EQ(run({"search", "-t", "ball", "--targets", folder_.string(), "--solid", "triangular-prism", "--width", "0.3",
                 "--detach"})
                .code,
            0);
  const Ran flat = run({"recognise", "-t", path("flat.yaml")});
  EXPECT_EQ(flat.code, 2);
  EXPECT_NE(flat.err.find("a solid has no picture"), std::string::npos) << flat.err;
  const auto missions = host->values().missions;
  ASSERT_EQ(missions.size(), 2U);
  const auto& recognise = std::get<api::RecogniseMission>(missions[0].task);
  EXPECT_EQ(recognise.headings, 12);
  ASSERT_EQ(recognise.targets.size(), 2U);
  EXPECT_EQ(recognise.targets[0].name, "board");
  EXPECT_EQ(recognise.targets[1], api::solid_target(SolidKind::kEllipsoid));
  const auto& search = std::get<api::SearchMission>(missions[1].task);
  ASSERT_EQ(search.targets.size(), 2U);
  EXPECT_EQ(search.targets[0].name, "ball");
  EXPECT_EQ(search.targets[0].solid, SolidKind::kSphere);
  EXPECT_DOUBLE_EQ(search.targets[0].depth_m, api::kSolidSize_m);
  EXPECT_EQ(search.targets[1].name, "triangular-prism");
  EXPECT_DOUBLE_EQ(search.targets[1].width_m, 0.3);
}

TEST_F(Verbs, RecogniseThatSawNothingHasDoneItsWork) {
  const Ran ran = run({"recognise", "--solid", "sphere", "--json"}, [&] { end_mission(api::Outcome::kComplete); });
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(is_json(ran.out)) << ran.out;
  EXPECT_NE(ran.out.find("\"detections\":"), std::string::npos);
}

TEST_F(Verbs, SurveyAndLocaliseSendWhatTheUserAskedFor) {
  EXPECT_EQ(run({"survey", "lab", "--at", "1,0", "--at", "4,2.5", "--headings", "8", "--replace", "--keep-out",
                 "1,1 2,1 2,2", "--detach"})
                .code,
            0);
  host->edit([](testing::FakeRobotValues& v) { v.mission.reset(); });
  EXPECT_EQ(run({"localise", "lab", "--time-limit", "60", "--detach"}).code, 0);
  EXPECT_EQ(run({"survey", "../lab"}).code, 2);
  EXPECT_EQ(run({"survey", "lab", "--at", "here"}).code, 2);
  const auto missions = host->values().missions;
  ASSERT_EQ(missions.size(), 2U);
  const api::SurveyMission survey{"lab", {{1.0, 0.0}, {4.0, 2.5}}, 8, true, {{{1, 1}, {2, 1}, {2, 2}}}};
  EXPECT_EQ(std::get<api::SurveyMission>(missions[0].task), survey);
  EXPECT_EQ(std::get<api::LocaliseMission>(missions[1].task), (api::LocaliseMission{"lab", 12}));
  EXPECT_EQ(*missions[1].time_limit, seconds(60));
}

TEST_F(Verbs, AnExplorationThatReachedItsBoundHasSucceeded) {
  EXPECT_EQ(run({"explore"}, [&] { end_mission(api::Outcome::kBoundReached); }).code, 0);
  EXPECT_EQ(run({"explore"}, [&] { end_mission(api::Outcome::kUnreachable); }).code, 1);
  EXPECT_EQ(run({"search", "-t", path("board.png")}, [&] { end_mission(api::Outcome::kBoundReached); }).code, 6);
}

TEST_F(Verbs, EveryDecisionOfAnExplorationIsToldOnce) {
  const auto decide_twice_and_end = [&] {
    for (std::uint64_t number : {1U, 1U, 2U}) {
      while (!host->values().mission || host->values().mission->end) {
        std::this_thread::yield();
      }
      api::MissionStatus status = *host->values().mission;
      DecisionCandidate open;
      open.score = -1.5;
      DecisionCandidate shut;
      shut.refused = "a wall";
      status.decision = ExploreDecision{.number = number,
                                        .stamp = robot_time_s(3.0),
                                        .rule = "one-step",
                                        .candidates = {open, shut},
                                        .chosen = 0,
                                        .why = "the long wall grows"};
      host->publish(api::Topic::kMission, status.updated, status);
    }
    end_mission(api::Outcome::kComplete);
  };
  Ran ran = run({"explore", "--json"}, decide_twice_and_end);
  EXPECT_EQ(ran.code, 0) << ran.err;
  std::istringstream lines(ran.out);
  std::vector<std::string> documents;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(is_json(line)) << line;
    documents.push_back(line);
  }
  ASSERT_EQ(documents.size(), 3U) << ran.out;
  EXPECT_NE(documents[0].find("\"decision\":{\"number\":1,"), std::string::npos) << documents[0];
  EXPECT_NE(documents[1].find("\"score\":-1.5,\"refused\":\"\""), std::string::npos) << documents[1];
  EXPECT_NE(documents[2].find("\"outcome\":\"COMPLETE\""), std::string::npos);
  ran = run({"explore"}, decide_twice_and_end);
  EXPECT_NE(ran.err.find("decision 2 (one-step, 1 of 2 candidates open): the long wall grows"), std::string::npos)
      << ran.err;
}

TEST_F(Verbs, TargetFileErrorsNameFileAndLine) {
  write("bad.yaml", "picture: board.png\nwidth: 0.6\n");
  const Ran ran = run({"search", "-t", path("bad.yaml")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("bad.yaml:2: width: unknown key"), std::string::npos) << ran.err;
}

TEST_F(Verbs, CtrlCStopsTheMissionAndIs130) {
  const Ran ran = run({"search", "-t", path("board.png")}, [&] {
    while (host->values().missions.empty()) {
      std::this_thread::yield();
    }
    interrupted = true;
  });
  EXPECT_EQ(ran.code, 130);
  EXPECT_NE(ran.err.find("asking the robot to stop mission"), std::string::npos);
  const auto mission = host->values().mission;
  ASSERT_TRUE(mission && mission->end);
  EXPECT_EQ(mission->end->outcome, api::Outcome::kOperator);
}

TEST_F(Verbs, SearchThatDoesNotEndInTimeIsStoppedAndIsFive) {
  const Ran ran = run({"search", "-t", path("board.png"), "--timeout", "0.2"});
  EXPECT_EQ(ran.code, 5);
  EXPECT_TRUE(host->values().mission->end.has_value());
}

TEST_F(Verbs, SecondMissionWhileOneRunsIsRefused) {
  EXPECT_EQ(run({"goto", "1,1", "--detach"}).code, 0);
  const Ran ran = run({"goto", "2,2", "--detach"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("stop it first"), std::string::npos);
  EXPECT_EQ(run({"pause"}).code, 0);
  EXPECT_EQ(run({"resume"}).code, 0);
  EXPECT_EQ(run({"stop"}).code, 0);
}

TEST_F(Verbs, DriveSendsPerishableCommandsUnderALeaseAndGivesItBack) {
  const Ran ran = run({"drive", "0.2", "-0.1", "--for", "0.35"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const auto values = host->values();
  ASSERT_GE(values.drives.size(), 3U);
  EXPECT_EQ(values.drives.front().velocity, (Twist2{0.2, -0.1}));
  EXPECT_EQ(values.drives.front().ttl, std::chrono::milliseconds(300));
  EXPECT_EQ(values.drives.back().velocity, Twist2{});
  EXPECT_TRUE(values.lease.owner.empty());
}

TEST_F(Verbs, DriveTellsWhatHeldItBack) {
  EXPECT_EQ(run({"drive", "0.2", "0", "--for", "0.1"}).err, "seeker: drove and stopped\n");
  host->edit([](testing::FakeRobotValues& v) { v.status.safety = "slowed for an obstacle"; });
  EXPECT_EQ(run({"drive", "0.2", "0", "--for", "0.1"}).err,
            "seeker: drove and stopped; held back: slowed for an obstacle\n");
}

TEST_F(Verbs, DriveThatIsStoppedFromElsewhereSaysSo) {
  const Ran ran = run({"drive", "0.2", "0", "--for", "20"}, [&] {
    while (host->values().drives.empty()) {
      std::this_thread::yield();
    }
    host->open({"somebody", api::Role::kObserver})->stop([](const Result<void>&) {});
  });
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("was stopped"), std::string::npos) << ran.err;
  EXPECT_TRUE(host->values().lease.owner.empty());
}

TEST_F(Verbs, DriveIsRefusedWhileAnotherHoldsTheLease) {
  host->edit([](testing::FakeRobotValues& v) { v.lease = {"somebody", 7, ""}; });
  EXPECT_EQ(run({"drive", "0.2", "0"}).code, 3);
  EXPECT_TRUE(host->values().drives.empty());
  EXPECT_EQ(run({"drive", "0.2", "0", "--for", "0.1", "--take-over"}).code, 0);
}

TEST_F(Verbs, MapExportWritesFilesThatCanBeReadBack) {
  const Ran ran = run({"map", "export", path("out/office")});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const auto pgm = image::read_pgm(path("out/office.pgm"));
  ASSERT_TRUE(pgm);
  EXPECT_EQ(pgm->width_px(), 128);
  EXPECT_TRUE(fs::exists(path("out/office.yaml")));
  const auto picture = image::read_png(path("out/office.png"));
  ASSERT_TRUE(picture);
  EXPECT_GT(picture->width_px(), 1000);
}

TEST_F(Verbs, WatchPrintsJsonLinesUntilItsTime) {
  std::atomic<bool> done{false};
  const Ran ran = run({"watch", "--json", "--topics", "status,event", "--timeout", "0.5"}, [&] {
    for (int n = 0; n < 20; ++n) {
      host->publish(api::Topic::kEvent, robot_time_s(n), api::Event{1, robot_time_s(n), {}, "", {}, "kind", "te\"xt"});
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    done = true;
  });
  EXPECT_EQ(ran.code, 0);
  std::istringstream lines(ran.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_TRUE(is_json(line)) << line;
    EXPECT_EQ(line.rfind("{\"topic\":\"event\",\"sequence\":", 0), 0U);
  }
  EXPECT_GT(count, 5);
}

TEST_F(Verbs, LongNamesOfComponentsKeepTheirDistance) {
  host->edit([](testing::FakeRobotValues& v) {
    v.components.front().name = "a-recogniser-with-a-long-name";
    v.components.front().kind = "recogniser-of-all";
    v.components.front().type = "template+features+solids";
    v.components.front().state = api::ComponentState::kActive;
  });
  EXPECT_NE(run({"components"}).out.find("a-recogniser-with-a-long-name recogniser-of-all template+features+solids "),
            std::string::npos);
}

TEST_F(Verbs, KeyboardWithoutATerminalSaysWhatToDo) {
  ASSERT_NE(::freopen("/dev/null", "r", stdin), nullptr);
  const Ran ran = run({"drive"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("terminal"), std::string::npos);
  EXPECT_TRUE(host->values().lease.owner.empty());
}

TEST(Arguments, DurationsPointsAndPolygons) {
  EXPECT_EQ(*parse_duration("300s"), seconds(300));
  EXPECT_EQ(*parse_duration("2.5min"), seconds(150));
  EXPECT_EQ(*parse_duration("200ms"), seconds(0.2));
  EXPECT_EQ(*parse_duration("7"), seconds(7));
  for (const char* bad : {"", "s", "-3s", "nan", "1e99h", "3 apples"}) {
    EXPECT_FALSE(parse_duration(bad)) << bad;
  }
  EXPECT_EQ(*parse_point("-1.5,2"), Point2(-1.5, 2));
  EXPECT_FALSE(parse_point("1,2,3"));
  EXPECT_FALSE(parse_point("inf,0"));
  EXPECT_EQ(parse_polygon("0,0 1,0 1,1")->size(), 3U);
  EXPECT_FALSE(parse_polygon("@/no/such/file"));
}

}  // namespace
}  // namespace seeker::cli
