#include "client/cli/script.hpp"

#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <unistd.h>

#include "client/cli/run_script.hpp"
#include "tests/unit/client/cli/cli_fixture.hpp"

namespace seeker::cli {
namespace {

std::string error_of(const std::string& text) {
  const Result<Script> script = parse_script(text, "m.yaml");
  return script ? "" : script.error().message;
}

TEST(Script, StepsKeepTheirValues) {
  const auto script = parse_script(
      "name: night\n"
      "steps:\n"
      "  - search: {targets: [ring], on_found: stop, bound: [[0, 0], [4, 0], [4, 4]], background: true, link_policy: "
      "return}\n"
      "  - wait: 2s\n"
      "  - pause: {}\n"
      "  - resume: {}\n"
      "  - await: {}\n"
      "    expect: {outcome: TARGET_FOUND, within: 5min, found: [ring], covered: 0.5}\n"
      "  - drive: {v_m_s: 0.1, omega_deg_s: 90, for: 500ms}\n"
      "  - estop: {release: true}\n"
      "  - map_export: out/night\n"
      "  - explore: {strategy: gain, bound: [[0, 0], [4, 0], [4, 4]], keep_out: [{corners: [[1, 1], [2, 1], [2, 2]]}], "
      "return_to_start: true}\n"
      "  - search: {targets: [ring], explore: true}\n"
      "  - survey: {landmarks: lab, places: [[1, 2]], headings: 6, replace: true}\n"
      "  - localise: {landmarks: lab, time_limit: 60s}\n"
      "  - recognise: {targets: [ring], solids: [sphere], headings: 4}\n",
      "m.yaml");
  ASSERT_TRUE(script) << script.error().message;
  ASSERT_EQ(script->steps.size(), 13U);
  const auto& recognise = std::get<RecogniseStep>(script->steps[12].action);
  EXPECT_EQ(recognise.targets, std::vector<std::string>{"ring"});
  EXPECT_EQ(recognise.solids, std::vector<std::string>{"sphere"});
  EXPECT_EQ(recognise.headings, 4);
  EXPECT_TRUE(is_mission(script->steps[12].action));
  const auto& survey = std::get<SurveyStep>(script->steps[10].action);
  EXPECT_EQ(survey.landmarks, "lab");
  EXPECT_EQ(survey.places, std::vector<Point2>{Point2(1.0, 2.0)});
  EXPECT_EQ(survey.headings, 6);
  EXPECT_TRUE(survey.replace);
  EXPECT_EQ(std::get<LocaliseStep>(script->steps[11].action).landmarks, "lab");
  EXPECT_TRUE(is_mission(script->steps[11].action));
  const auto& explore = std::get<ExploreStep>(script->steps[8].action);
  EXPECT_EQ(explore.strategy, api::ExploreStrategy::kGain);
  EXPECT_EQ(explore.bound->size(), 3U);
  EXPECT_EQ(explore.keep_out.size(), 1U);
  EXPECT_TRUE(explore.return_to_start);
  EXPECT_TRUE(std::get<SearchStep>(script->steps[9].action).explore);
  EXPECT_TRUE(script->steps[0].background);
  EXPECT_EQ(script->steps[0].link_policy, api::LinkPolicy::kReturn);
  EXPECT_EQ(std::get<SearchStep>(script->steps[0].action).bound->size(), 3U);
  EXPECT_EQ(*script->steps[4].expect.within, seconds(300));
  EXPECT_NEAR(std::get<DriveStep>(script->steps[5].action).velocity.omega_rad_s, 1.5708, 1e-4);
}

TEST(Script, ErrorsNameFileLineAndPath) {
  EXPECT_NE(error_of("steps:\n  - search: {targts: [ring]}\n").find("m.yaml:2: steps[0].search"), std::string::npos);
  EXPECT_NE(error_of("steps:\n  - recognise: {solids: [cube]}\n").find("'cube' is none of"), std::string::npos);
  EXPECT_NE(error_of("steps:\n  - search: {mode: plan}\n").find("1 to 16 targets"), std::string::npos);
  EXPECT_NE(error_of("steps:\n  - wait: soon\n").find("m.yaml:2: steps[0].wait: 'soon' is no duration"),
            std::string::npos);
  EXPECT_NE(
      error_of("steps:\n  - return: {}\n    expect: {outcome: FOUND}\n").find("m.yaml:3: steps[0].expect.outcome"),
      std::string::npos);
  EXPECT_NE(error_of("steps:\n  - return: {}\n    pause: {}\n").find("exactly one"), std::string::npos);
  EXPECT_NE(error_of("steps:\n  - expect: {}\n").find("exactly one"), std::string::npos);
  EXPECT_EQ(error_of("steps:\n  - return: {}\n  - serach: {targets: [cross]}\n    expect: {outcome: TARGET_FOUND}\n")
                .find("m.yaml:3: steps[1].serach: unknown key; allowed here: search, "),
            0U);
  EXPECT_EQ(error_of("stesp:\n  - return: {}\n").find("m.yaml:1: stesp: unknown key"), 0U);
  EXPECT_NE(error_of("steps: []\n").find("1 to 1000"), std::string::npos);
  EXPECT_NE(error_of("name: x\n").find("steps: is missing"), std::string::npos);
  EXPECT_NE(error_of("steps:\n  - goto: {waypoints: [[0, 0]], keep_out: [{corners: [[0,0],[2,2],[2,0],[0,2]]}]}\n")
                .find("crosses itself"),
            std::string::npos);
}

TEST(Script, AnExplorationDrivesToursUnlessItNamesAStrategy) {
  const auto script =
      parse_script("steps:\n  - explore: {return_to_start: true}\n  - explore: {strategy: active}\n", "m.yaml");
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(std::get<ExploreStep>(script->steps[0].action).strategy, api::ExploreStrategy::kTour);
  EXPECT_EQ(std::get<ExploreStep>(script->steps[1].action).strategy, api::ExploreStrategy::kActive);
}

TEST(Script, MissionsAreMadeOfTheirSteps) {
  const auto script = parse_script(
      "steps:\n"
      "  - explore: {strategy: horizon, return_to_start: true, time_limit: 60s}\n"
      "  - search: {targets: [ring], explore: true}\n"
      "  - recognise: {targets: [sphere], solids: [ellipsoid]}\n",
      "m.yaml");
  ASSERT_TRUE(script) << script.error().message;
  const auto request = [&](std::size_t step) {
    return make_request(script->steps[step], ".", {testing::source_file("config/targets")}).value();
  };
  EXPECT_EQ(request(0).task, api::MissionTask(api::ExploreMission{api::ExploreStrategy::kHorizon, {}, {}, true}));
  EXPECT_EQ(*request(0).time_limit, seconds(60));
  EXPECT_TRUE(std::get<api::SearchMission>(request(1).task).explore);
  EXPECT_EQ(request(2).task, api::MissionTask(api::RecogniseMission{
                                 {api::solid_target(SolidKind::kSphere), api::solid_target(SolidKind::kEllipsoid)}}));
}

TEST(Script, AFleetIsWaitedForByTheNumberOfJoinedMaps) {
  const auto script = parse_script(
      "robots: 3\nsteps:\n  - explore: {strategy: topological}\n  - fleet: {merged: 3, limit: 5min}\n  - fleet: {}\n",
      "m.yaml");
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(script->robots, 3);
  const auto& fleet = std::get<FleetStep>(script->steps[1].action);
  EXPECT_EQ(fleet.merged, 3);
  EXPECT_EQ(fleet.limit, std::chrono::minutes(5));
  EXPECT_EQ(std::get<FleetStep>(script->steps[2].action).merged, 2);
  EXPECT_FALSE(is_mission(script->steps[1].action));
  EXPECT_NE(error_of("robots: 0\nsteps:\n  - stop: {}\n").find("robots: must be from 1 to 16"), std::string::npos);
  EXPECT_NE(error_of("steps:\n  - fleet: {merged: 99}\n").find("merged"), std::string::npos);
}

/// Every kind of mission there is.
template <std::size_t... kIndex>
std::set<std::string> mission_kinds(std::index_sequence<kIndex...> /*all*/) {
  return {std::string(api::task_name(api::MissionTask(std::variant_alternative_t<kIndex, api::MissionTask>{})))...};
}

TEST(Script, EveryKindOfMissionAndTheFleetHaveAShippedScript) {
  std::set<std::string> kinds = mission_kinds(std::make_index_sequence<std::variant_size_v<api::MissionTask>>());
  kinds.insert("fleet");
  for (const auto& entry : std::filesystem::directory_iterator(testing::source_file("config/missions"))) {
    const auto script = load_script(entry.path());
    ASSERT_TRUE(script) << script.error().message;
    for (const Step& step : script->steps) {
      kinds.erase(step.kind);
    }
  }
  EXPECT_TRUE(kinds.empty()) << *kinds.begin();
}

TEST(Script, ShippedMissionsAreSound) {
  const std::filesystem::path folder = testing::source_file("config/missions");
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto script = load_script(entry.path());
    ASSERT_TRUE(script) << script.error().message;
    const Status ok = check_missions(*script, folder, {testing::source_file("config/targets")});
    EXPECT_TRUE(ok) << ok.error().message;
    ++count;
  }
  EXPECT_GE(count, 4);
}

class RunScript : public ::testing::Test, public CliFixture {
 protected:
  VerbResult play(const std::string& text, const std::function<void()>& during = {}) {
    const auto script = parse_script(text, "m.yaml");
    EXPECT_TRUE(script) << script.error().message;
    Context context;
    context.robot = host->open({"seeker-test", api::Role::kOperator});
    context.out = &out;
    context.err = &err;
    context.json = true;
    std::thread helper;
    if (during) {
      helper = std::thread(during);
    }
    const VerbResult result = run_script(context, *script, ".", {testing::source_file("config/targets")}, fleet);
    if (helper.joinable()) {
      helper.join();
    }
    return result;
  }
  std::ostringstream out;
  std::ostringstream err;
  FleetCall fleet;
};

TEST_F(RunScript, AFleetStepEndsWhenTheRobotsHaveJoinedTheirMaps) {
  int asked = 0;
  fleet = [&asked]() -> Result<api::FleetStatus> {
    api::FleetStatus status;
    status.members.resize(2);
    status.members[1].state = ++asked < 2 ? api::FleetState::kWaiting : api::FleetState::kMerged;
    return status;
  };
  const auto result = play("steps:\n  - fleet: {merged: 2, limit: 1min}\n");
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, ExitCode::kOk) << out.str();
  EXPECT_EQ(asked, 2);
}

TEST_F(RunScript, AFleetStepFailsInTimeWithTheNumberOfThoseThatHaveJoined) {
  fleet = []() -> Result<api::FleetStatus> {
    api::FleetStatus status;
    status.members.resize(1);
    return status;
  };
  const auto result = play("steps:\n  - fleet: {merged: 2, limit: 1ms}\n");
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, ExitCode::kFailed);
  EXPECT_NE(out.str().find("1 of 2 robots"), std::string::npos) << out.str();
}

TEST_F(RunScript, PassesWhenEveryExpectationHolds) {
  const auto result = play(
      "steps:\n  - goto: {waypoints: [[1, 1]]}\n    expect: {outcome: COMPLETE, within: 60s, covered: 0.9}\n"
      "  - estop: {}\n  - estop: {release: true}\n  - pause: {}\n    expect: {error: not_found}\n",
      [&] { end_mission(api::Outcome::kComplete); });
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(*result, ExitCode::kOk) << out.str();
  EXPECT_TRUE(is_json(out.str()));
}

TEST_F(RunScript, FailsAtTheFirstExpectationThatDoesNotHold) {
  const auto result = play("steps:\n  - goto: {waypoints: [[1, 1]]}\n    expect: {within: 30s}\n  - estop: {}\n",
                           [&] { end_mission(api::Outcome::kComplete, 31.0); });
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, ExitCode::kFailed);
  EXPECT_NE(out.str().find("expected at most 30.0 s"), std::string::npos) << out.str();
  EXPECT_FALSE(host->values().estop);
}

TEST_F(RunScript, FailsBeforeTheFirstMissionWhereAnExportWouldOverwriteFilesOfOthers) {
  const std::filesystem::path world =
      std::filesystem::path(::testing::TempDir()) / ("seeker_world_" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(world) << "walls: []\n";
  const std::string name = (world.parent_path() / world.stem()).string();
  const auto result = play("steps:\n  - goto: {waypoints: [[1, 1]]}\n  - map_export: " + name + "\n");
  std::filesystem::remove(world);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Errc::kIo);
  EXPECT_NE(result.error().message.find("map_export: " + world.string()), std::string::npos) << result.error().message;
  EXPECT_TRUE(host->values().missions.empty());
}

TEST_F(RunScript, BackgroundMissionIsAwaited) {
  const auto result = play(
      "steps:\n  - goto: {waypoints: [[1, 1]], background: true}\n  - pause: {}\n  - resume: {}\n  - stop: {}\n"
      "  - await: {}\n    expect: {outcome: OPERATOR}\n");
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, ExitCode::kOk) << out.str();
}

}  // namespace
}  // namespace seeker::cli
