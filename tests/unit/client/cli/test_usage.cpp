#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/unit/client/cli/verbs_fixture.hpp"

namespace seeker::cli {
namespace {

/// What a script branches on: exit codes, and errors as sentences and as JSON.
class Usage : public VerbsFixture {};

TEST_F(Usage, EveryErrorClassHasItsExitCodeAndOneSentence) {
  const std::vector<std::pair<Errc, int>> codes{
      {Errc::kInternal, 1},    {Errc::kNotFound, 1},   {Errc::kInvalidArgument, 2}, {Errc::kRefused, 3},
      {Errc::kBusy, 3},        {Errc::kNotReady, 3},   {Errc::kLinkLost, 4},        {Errc::kTimeout, 5},
      {Errc::kCancelled, 130}, {Errc::kUnreachable, 3}};
  for (const auto& [error, code] : codes) {
    host->edit([&, e = error](testing::FakeRobotValues& v) { v.failure = Error{e, "the cause; the remedy"}; });
    const Ran ran = run({"status", "--json"});
    EXPECT_EQ(ran.code, code) << to_string(error);
    EXPECT_EQ(ran.err, "seeker: the cause; the remedy\n");
    EXPECT_TRUE(is_json(ran.out));
    EXPECT_NE(ran.out.find("\"code\":\"" + std::string(to_string(error)) + "\""), std::string::npos);
  }
}

TEST_F(Usage, NoLinkIsFourAndNoAnswerIsFive) {
  connect_error = Error{Errc::kLinkLost, "nobody answers at 127.0.0.1:1"};
  EXPECT_EQ(run({"status"}).code, 4);
  connect_error.reset();
  host->hold_replies(true);
  EXPECT_EQ(run({"status", "--timeout", "0.1"}).code, 5);
  host->release_replies();
}

TEST_F(Usage, UsageErrorsAreFoundWithoutARobot) {
  connect_error = Error{Errc::kLinkLost, "must not be tried"};
  EXPECT_EQ(run({"goto", "3;4"}).code, 2);
  EXPECT_EQ(run({"goto"}).code, 2);
  EXPECT_EQ(run({"search", "-t", path("board.png"), "--bound", "0,0 2,2 2,0 0,2"}).code, 2);
  const Ran ran = run({"search", "-t", "nobody-knows-it", "--targets", folder_.string()});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("there is no target 'nobody-knows-it'"), std::string::npos);
}

TEST_F(Usage, WhatTheCommandLineNamesToBeReadIsUsageWhereItIsNotThere) {
  write("script.yaml", "steps:\n  - search: {targets: [nobody-knows-it]}\n");
  connect_error = Error{Errc::kLinkLost, "must not be tried"};
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"search", "-t", path("none.png")},
                                                    {"search", "-t", path("board.png"), "--bound", "@" + path("none")},
                                                    {"explore", "--keep-out", "@" + path("none")},
                                                    {"recognise", "-t", path("none.yaml")},
                                                    {"run", path("none.yaml")},
                                                    {"run", "--check", path("script.yaml")}}) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.code, 2) << arguments[0] << " " << ran.err;
  }
}

TEST_F(Usage, WrongCommandLinesAreJsonWhereItIsAskedFor) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--json", "goto", "3,0", "--time-limit", "0"},
        {"status", "--bogus", "--json"},
        {"--json", "foo"},
        {"--json"}}) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.code, 2);
    EXPECT_TRUE(is_json(ran.out)) << ran.out;
    EXPECT_EQ(ran.out.rfind("{\"error\":{\"code\":\"invalid_argument\",", 0), 0U) << ran.out;
    EXPECT_NE(ran.out.find("\"exit_code\":2"), std::string::npos) << ran.out;
    EXPECT_EQ(ran.err.rfind("seeker: ", 0), 0U) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }
  EXPECT_EQ(run({"foo"}).out, "");
}

TEST_F(Usage, ACheckedScriptIsADocumentWithJson) {
  write("ok.yaml", "name: tea\nsteps:\n  - goto: {waypoints: [[1, 2]]}\n");
  const Ran ran = run({"run", "--check", path("ok.yaml"), "--json"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, "{\"script\":\"tea\",\"ok\":true,\"steps_planned\":1,\"steps\":[]}\n");
  EXPECT_NE(run({"run", "--check", path("ok.yaml")}).err.find("is sound: 1 step\n"), std::string::npos);
}

TEST_F(Usage, AScriptSaysWhichRobotAndWorldItIsFor) {
  write("office.yaml", "");
  write("ok.yaml", "name: tea\nworld: ./office.yaml\nsteps:\n  - goto: {waypoints: [[1, 2]]}\n");
  const Ran ran = run({"run", "--check", path("ok.yaml"), "--json"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, "{\"script\":\"tea\",\"ok\":true,\"world\":\"" + path("office.yaml") +
                         "\",\"steps_planned\":1,\"steps\":[]}\n");
}

TEST_F(Usage, AScriptForARobotThatIsNotThereIsRefused) {
  write("lost.yaml", "robot: ../none.yaml\nsteps:\n  - goto: {waypoints: [[1, 2]]}\n");
  const Ran ran = run({"run", "--check", path("lost.yaml")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("robot: there is no file"), std::string::npos) << ran.err;
}

TEST_F(Usage, AnEndedPipeIsNoErrorAndAFullDiskIs) {
  for (const bool ended : {true, false}) {
    std::ostringstream out;
    std::ostringstream err;
    out.setstate(std::ios::badbit);
    Process process;
    process.out = &out;
    process.err = &err;
    process.out_ended = [ended] { return ended; };
    const Connector none = [](const ConnectRequest&) -> Result<Connection> { return fail(Errc::kLinkLost, "none"); };
    EXPECT_EQ(run_program({"version"}, process, none), ended ? ExitCode::kOk : ExitCode::kFailed);
    EXPECT_EQ(err.str(), ended ? "" : "seeker: stdout cannot be written\n");
  }
}

TEST_F(Usage, VerbsThatMayStopTheRobotSaySoWhenTheyConnect) {
  const auto stops = [](const std::vector<std::string>& verb) {
    std::ostringstream discarded;
    Process process;
    process.out = &discarded;
    process.err = &discarded;
    std::optional<bool> asked;
    const Connector none = [&asked](const ConnectRequest& request) -> Result<Connection> {
      asked = request.stops;
      return fail(Errc::kLinkLost, "none");
    };
    EXPECT_EQ(run_program(verb, process, none), ExitCode::kNoLink);
    return asked;
  };
  for (const std::vector<std::string>& verb : {std::vector<std::string>{"explore"}, {"goto", "1,0"}}) {
    EXPECT_EQ(stops(verb), true) << verb.front();
  }
  for (const std::vector<std::string>& verb : {std::vector<std::string>{"status"}, {"watch"}, {"stop"}}) {
    EXPECT_EQ(stops(verb), false) << verb.front();
  }
}

TEST_F(Usage, ASaveThatCannotBeWrittenIsToldBeforeTheMission) {
  write("file", "in the way");
  std::filesystem::create_directories(folder_ / "taken.png");
  for (const std::string& save : {path("file/floor"), path("taken")}) {
    for (const std::vector<std::string>& verb :
         {std::vector<std::string>{"explore"}, {"search", "-t", path("board.png")}}) {
      std::vector<std::string> arguments = verb;
      arguments.insert(arguments.end(), {"--save", save});
      const Ran ran = run(arguments);
      EXPECT_EQ(ran.code, 1) << save;
      EXPECT_NE(ran.err.find("--save: cannot "), std::string::npos) << ran.err;
    }
  }
  const Ran picture = run({"search", "-t", path("board.png"), "--save", path("board")});
  EXPECT_EQ(picture.code, 1);
  EXPECT_NE(picture.err.find("board.png is there and is no such export"), std::string::npos) << picture.err;
  EXPECT_TRUE(host->values().missions.empty());
}

}  // namespace
}  // namespace seeker::cli
