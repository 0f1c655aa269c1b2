#include "client/cli/command_line.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "common/api/mission.hpp"

namespace seeker::cli {
namespace {

TEST(CommandLine, EveryVerbHasHelpWithAnExample) {
  const CommandTree tree = command_tree();
  std::vector<std::string> names;
  const std::function<void(const CommandTree&, std::vector<std::string>)> visit = [&](const CommandTree& node,
                                                                                      std::vector<std::string> path) {
    for (const CommandTree& command : node.commands) {
      std::vector<std::string> words = path;
      words.push_back(command.name);
      names.push_back(command.name);
      std::vector<std::string> arguments = words;
      arguments.emplace_back("--help");
      const ParsedCommandLine parsed = parse_command_line(arguments);
      EXPECT_EQ(parsed.exit_code, ExitCode::kOk) << command.name;
      EXPECT_FALSE(parsed.command);
      EXPECT_NE(parsed.out.find("Example:\n  seeker "), std::string::npos) << parsed.out;
      visit(command, words);
    }
  };
  visit(tree, {});
  EXPECT_EQ(names,
            (std::vector<std::string>{
                "status",   "doctor",     "audit",      "watch",     "map",       "export",     "save",       "load",
                "list",     "info",       "verify",     "delete",    "download",  "upload",     "relocalise", "grid",
                "topology", "detections", "lines",      "camera",    "grab",      "components", "get",        "set",
                "exchange", "activate",   "deactivate", "search",    "recognise", "explore",    "goto",       "survey",
                "localise", "landmarks",  "info",       "verify",    "export",    "prune",      "revert",     "delete",
                "download", "upload",     "fleet",      "status",    "merge",     "split",      "map",        "drive",
                "lease",    "acquire",    "request",    "take-over", "grant",     "deny",       "release",    "stop",
                "estop",    "pause",      "resume",     "pki",       "init",      "issue",      "revoke",     "show",
                "run",      "completion", "version"}));
}

TEST(CommandLine, HelpSaysWhatEachStrategyOfAnExplorationIsGoodFor) {
  const std::string help = parse_command_line({"explore", "--help"}).out;
  EXPECT_NE(help.find("=tour"), std::string::npos) << "the default: " << help;
  for (const api::ExploreStrategy strategy : api::kExploreStrategies) {
    EXPECT_NE(help.find(std::string(to_string(strategy)) + ":"), std::string::npos) << help;
  }
}

TEST(CommandLine, EveryKindOfWrongUseIsCodeTwoWithASentence) {
  const std::vector<std::vector<std::string>> wrong{
      {},
      {"no-such-verb"},
      {"status", "--no-such-option"},
      {"search"},
      {"search", "--target", "a", "--mode", "fast"},
      {"search", "--solid", "cube"},
      {"recognise"},
      {"recognise", "--solid", "sphere", "--headings", "73"},
      {"search", "--target", "a", "--time-limit", "-3"},
      {"search", "--target", "a", "--detach", "--save", "x"},
      {"explore", "--strategy", "by-chance"},
      {"explore", "--link-policy", "hope"},
      {"survey"},
      {"survey", "lab", "--headings", "0"},
      {"localise"},
      {"landmarks"},
      {"landmarks", "upload"},
      {"landmarks", "download", "lab"},
      {"fleet"},
      {"fleet", "split"},
      {"fleet", "merge", "r2", "--hypothesis", "-1"},
      {"landmarks", "prune", "lab", "--min-views", "0"},
      {"landmarks", "revert"},
      {"drive", "0.2"},
      {"drive", "fast", "0"},
      {"map"},
      {"completion", "tcsh"},
      {"--timeout", "0", "status"},
      {"-q", "-v", "status"},
      {"--timeout", "nan", "status"},
      {"--timeout", "inf", "status"},
      {"watch", "--rate", "-1"},
      {"goto", "1,2", "--heading", "nan"},
      {"search", "--target", "a", "--depth", "nan"},
      {"drive", "nan", "0"},
      {"drive", "0.1", "0", "--for", "nan"},
  };
  for (const auto& arguments : wrong) {
    const ParsedCommandLine parsed = parse_command_line(arguments);
    EXPECT_FALSE(parsed.command);
    EXPECT_EQ(parsed.exit_code, ExitCode::kUsage) << (arguments.empty() ? "nothing" : arguments.back());
    EXPECT_FALSE(parsed.err.empty());
  }
}

TEST(CommandLine, WrongUseIsOneSentenceThatSaysWhereToReadOn) {
  EXPECT_EQ(parse_command_line({"goto", "3,0", "--time-limit", "0"}).err,
            "--time-limit: must be a number above 0, not '0'; see seeker goto --help");
  EXPECT_EQ(parse_command_line({"status", "--bogus"}).err,
            "the following argument was not expected: --bogus; see seeker status --help");
  EXPECT_EQ(parse_command_line({"map", "info"}).err, "name is required; see seeker map info --help");
}

TEST(CommandLine, AWordThatIsNoVerbIsToldAlsoAfterOptions) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"foo"},
                                                    {"--json", "foo"},
                                                    {"--robot", "status", "foo"},
                                                    {"--timeout=3", "-q", "foo"}}) {
    EXPECT_EQ(parse_command_line(arguments).err, "there is no verb 'foo'; seeker --help lists them");
  }
  EXPECT_EQ(parse_command_line({"--help", "foo"}).exit_code, ExitCode::kOk);
  EXPECT_EQ(parse_command_line({"--bogus", "foo"}).err.find("no verb"), std::string::npos);
}

TEST(CommandLine, TheOptionVersionIsTheVerbVersion) {
  const ParsedCommandLine parsed = parse_command_line({"--version", "--json"});
  ASSERT_TRUE(parsed.command) << parsed.err;
  EXPECT_TRUE(std::holds_alternative<VersionVerb>(parsed.command->verb));
  EXPECT_TRUE(parsed.command->global.json);
}

TEST(CommandLine, GlobalOptionsStandBeforeOrAfterTheVerb) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--json", "--robot", "r:1", "status"}, {"status", "--json", "--robot", "r:1"}}) {
    const ParsedCommandLine parsed = parse_command_line(arguments);
    ASSERT_TRUE(parsed.command) << parsed.err;
    EXPECT_TRUE(parsed.command->global.json);
    EXPECT_EQ(parsed.command->global.robot, "r:1");
  }
}

TEST(CommandLine, NegativePointsAndVelocitiesAreNoOptions) {
  const ParsedCommandLine go = parse_command_line({"goto", "-1.5,2", "3,-4"});
  ASSERT_TRUE(go.command) << go.err;
  EXPECT_EQ(std::get<GotoVerb>(go.command->verb).points, (std::vector<std::string>{"-1.5,2", "3,-4"}));
  const ParsedCommandLine drive = parse_command_line({"drive", "-0.2", "-0.5", "--for", "2"});
  ASSERT_TRUE(drive.command) << drive.err;
  EXPECT_DOUBLE_EQ(*std::get<DriveVerb>(drive.command->verb).v_m_s, -0.2);
  EXPECT_DOUBLE_EQ(*std::get<DriveVerb>(drive.command->verb).omega_rad_s, -0.5);
}

TEST(CommandLine, RepeatableOptionsTakeOneValueEach) {
  const ParsedCommandLine parsed = parse_command_line(
      {"search", "-t", "a", "--target", "b", "--keep-out", "0,0 1,0 1,1", "--keep-out", "2,2 3,2 3,3"});
  ASSERT_TRUE(parsed.command) << parsed.err;
  const auto& search = std::get<SearchVerb>(parsed.command->verb);
  EXPECT_EQ(search.targets, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(search.keep_out.size(), 2U);
}

TEST(Completion, AFlagTakesNoValueAndAnOptionDoes) {
  const CommandTree tree = command_tree();
  for (const CommandTree::Option& option : tree.options) {
    const std::string& name = option.names.front();
    const bool takes_value = name == "--robot" || name == "--as" || name == "--tls" || name == "--timeout";
    EXPECT_EQ(option.takes_value, takes_value) << name;
  }
}

TEST(Completion, NamesVerbsAndOptionsForEveryShell) {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const auto script = completion_script(shell);
    ASSERT_TRUE(script);
    for (const char* word : {"search", "components", "keep-out", "finish-step", "export"}) {
      EXPECT_NE(script->find(word), std::string::npos) << shell << " " << word;
    }
  }
  EXPECT_EQ(completion_script("tcsh").error().code, Errc::kInvalidArgument);
}

}  // namespace
}  // namespace seeker::cli
