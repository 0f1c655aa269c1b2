/// \file
/// How the checks read pages, commands and help texts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/docs/command.hpp"
#include "tests/docs/help.hpp"
#include "tests/docs/page.hpp"
#include "tests/docs/source_path.hpp"
#include "tests/support/data.hpp"

namespace seeker::docs {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string kProgram =
    "seeker: commands a robot\nUsage: seeker [OPTIONS] SUBCOMMAND\n\nOptions:\n"
    "  -h,--help                   Print this help message and exit\n"
    "  --robot TEXT=127.0.0.1:7471 Robot to talk to\n"
    "  -q,--quiet Excludes: --verbose\n\nSubcommands:\n"
    "  map                         Maps\n  explore                     Map the building\n\nExample:\n  seeker stop\n";
const std::string kExplore =
    "Map the building\nUsage: seeker explore [OPTIONS] shell\n\nPositionals:\n"
    "  shell TEXT:{bash,zsh} REQUIRED\n\nOptions:\n"
    "  --strategy TEXT:{active,horizon}=active\n                              How it chooses\n"
    "  --return                    Drive back\n";

std::optional<Help> help(const std::vector<std::string>& verb) {
  if (verb.empty()) {
    return parse_help(kProgram);
  }
  return verb == std::vector<std::string>{"explore"} ? std::optional(parse_help(kExplore)) : std::nullopt;
}

std::string check(const std::string& line) { return check_command(commands_in(line).at(0), help); }

TEST(DocumentPage, HasItsCodeItsLinksAndItsHeadings) {
  const Page page =
      parse_page("a.md", "# What is *it*?\nSee `one` and [two](b.md#c).\n```\nthree \\\n  four\nfive\n```\n");
  ASSERT_EQ(page.code.size(), 3U);
  EXPECT_EQ(page.code[0].text, "one");
  EXPECT_EQ(page.code[0].line, 2U);
  EXPECT_EQ(page.code[1].text, "three    four");
  EXPECT_EQ(page.code[2].line, 6U);
  ASSERT_EQ(page.links.size(), 1U);
  EXPECT_EQ(page.links[0].text, "b.md#c");
  EXPECT_THAT(page.anchors, ElementsAre("what-is-it"));
}

TEST(DocumentPage, CountsCharactersNotBytes) { EXPECT_EQ(columns("0.1° ± 2 │"), 10U); }

TEST(DocumentCommand, IsReadWithoutCommentsBracketsAndFolders) {
  const std::vector<Command> commands =
      commands_in("build/release/bin/seeker map [--format F,F] 'a b' # stop | seekerd");
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].program, "seeker");
  EXPECT_THAT(commands[0].words, ElementsAre("map", "--format", "F,F", "a b"));
}

TEST(DocumentCommand, MayBeJoinedWithOthers) {
  const std::vector<Command> commands = commands_in("./run build && seeker status | less");
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].program, "run");
  EXPECT_THAT(commands[1].words, ElementsAre("status"));
  EXPECT_THAT(commands_in("seeker_library(NAME)"), IsEmpty());
  EXPECT_THAT(commands_in("status seeker"), IsEmpty());
}

TEST(DocumentHelp, KnowsVerbsOptionsAndChoices) {
  EXPECT_EQ(check("seeker --robot 10.0.0.5 explore --strategy horizon --return -q zsh"), "");
  EXPECT_EQ(check("seeker explore --strategy S SHELL"), "");
  EXPECT_EQ(check("seeker VERB --help"), "");
  EXPECT_EQ(check("seeker eplore"), "there is no verb 'eplore'");
  EXPECT_EQ(check("seeker stop"), "there is no verb 'stop'");
  EXPECT_EQ(check("seeker explore --back"), "there is no option --back");
  EXPECT_EQ(check("seeker explore --strategy best"), "'best' is none of the choices");
  EXPECT_EQ(check("seeker explore fish"), "'fish' is none of the choices");
}

TEST(SourcePath, IsAWordThatBeginsWithAFolderOfTheTop) {
  EXPECT_THAT(source_paths_in("--config config/robots/sim.yaml (server/app), ../worlds/a.yaml out/docs/a"),
              ElementsAre("config/robots/sim.yaml", "server/app"));
}

TEST(SourcePath, MayHaveAnyNameWhereAStarOrAWordInCapitalsStands) {
  const std::filesystem::path top = testing::source_file("");
  EXPECT_TRUE(exists_in_tree(top, "tests/docs/CMakeLists.txt"));
  EXPECT_TRUE(exists_in_tree(top, "tests/fuzz/corpus/NAME/"));
  EXPECT_TRUE(exists_in_tree(top, "proto/seeker/v1/*.proto"));
  EXPECT_TRUE(exists_in_tree(top, "tests/unit/server/NAME/CMakeLists.txt"));
  EXPECT_FALSE(exists_in_tree(top, "tests/docs/no-such-file.cpp"));
  EXPECT_FALSE(exists_in_tree(top, "proto/seeker/v1/*.yaml"));
}

}  // namespace
}  // namespace seeker::docs
