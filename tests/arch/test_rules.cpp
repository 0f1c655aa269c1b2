/// \file
/// The rules find what they are meant to find: a checker that accepts everything would be worthless.
#include "tests/arch/rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace seeker::arch {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kTable = R"(
library eigen Eigen/
library sqlite sqlite3.h
hidden sqlite
folder common/core :             : eigen
folder server/nav  : common/core : eigen
folder server/store : common/core : sqlite
folder server/app  : common/* server/* proto : *
folder client/cli  : common/core :
pure server/nav
)";

Layers table() { return parse_layers(kTable).value(); }

TEST(Rules, AllowedIncludesAreAccepted) {
  EXPECT_THAT(check_source(table(), {"server/nav/a.cpp",
                                     "#include \"server/nav/a.hpp\"\n#include \"common/core/x.hpp\"\n"
                                     "#include <Eigen/Core>\n#include <vector>\n// steady_clock::now()\n"}),
              IsEmpty());
  EXPECT_THAT(check_source(table(), {"server/app/a.cpp",
                                     "#include \"server/nav/a.hpp\"\n#include <sqlite3.h>\n#include <thread>\n"
                                     "#include \"seeker/v1/map.pb.h\"\n"}),
              IsEmpty());
}

TEST(Rules, EdgeOutsideTheTableIsFoundWithItsLine) {
  EXPECT_THAT(check_source(table(), {"server/nav/a.cpp", "\n#include \"server/store/store.hpp\"\n"}),
              ElementsAre("server/nav/a.cpp:2: includes server/store/store.hpp, but server/nav may not include "
                          "server/store"));
}

TEST(Rules, ServerAndClientNeverMeet) {
  EXPECT_THAT(check_source(table(), {"server/app/a.cpp", "#include \"client/cli/a.hpp\"\n"}),
              ElementsAre(HasSubstr("may not include client/cli")));
  EXPECT_THAT(check_source(table(), {"client/cli/a.cpp", "#include \"server/app/a.hpp\"\n"}),
              ElementsAre(HasSubstr("may not include server/app")));
}

TEST(Rules, ForeignLibraryProtoAndUnknownHeaderAreFound) {
  EXPECT_THAT(check_source(table(), {"server/nav/a.cpp",
                                     "#include <sqlite3.h>\n#include \"seeker/v1/map.pb.h\"\n#include <zmq.h>\n"
                                     "#include \"a.hpp\"\n"}),
              ElementsAre(HasSubstr("may not use sqlite"), HasSubstr("may not include proto"),
                          HasSubstr("a library that is not in"), HasSubstr("by their path from the top")));
}

TEST(Rules, HiddenLibraryInAHeaderIsFound) {
  EXPECT_THAT(check_source(table(), {"server/store/a.hpp", "#include <sqlite3.h>\n"}),
              ElementsAre(HasSubstr("belongs into .cpp files")));
}

TEST(Rules, ThreadFileAndClockInAnAlgorithmAreFound) {
  EXPECT_THAT(check_source(table(), {"server/nav/a.cpp",
                                     "#include <thread>\n#include <fstream>\nauto t = steady_clock::now();\n"
                                     "std::random_device d;\n"}),
              ElementsAre(HasSubstr("<thread>"), HasSubstr("<fstream>"), HasSubstr("reads a clock"),
                          HasSubstr("reads a clock")));
}

TEST(Rules, LongMainAndUnknownFolderAreFound) {
  EXPECT_THAT(check_source(table(), {"server/app/daemon/main.cpp", std::string(kMaxMainLines, '\n')}), IsEmpty());
  EXPECT_THAT(check_source(table(), {"server/app/daemon/main.cpp", std::string(kMaxMainLines + 1, '\n')}),
              ElementsAre(HasSubstr("main has 61 lines")));
  EXPECT_THAT(check_source(table(), {"server/new/a.cpp", ""}), ElementsAre(HasSubstr("lies in no folder")));
}

TEST(Rules, TargetsFollowTheTableToo) {
  const std::vector<SourceFile> lists{
      {"common/core/CMakeLists.txt", "seeker_library(core DEPS Eigen3::Eigen)"},
      {"server/nav/CMakeLists.txt", "seeker_library(nav DEPS seeker_core\n  seeker_store)"},
      {"server/store/CMakeLists.txt", "seeker_library(store DEPS seeker_core)"},
      {"server/new/CMakeLists.txt", "seeker_library(new)"}};
  EXPECT_THAT(check_targets(table(), lists),
              ElementsAre(HasSubstr("seeker_nav links seeker_store"), HasSubstr("folder of seeker_new is not in")));
}

TEST(Rules, BrokenTableIsRefused) {
  EXPECT_FALSE(parse_layers("folder a/b : c/d :"));
  EXPECT_FALSE(parse_layers("folder a/b : : nothing"));
  EXPECT_FALSE(parse_layers("folder a/b"));
  EXPECT_FALSE(parse_layers("allow everything"));
  const auto cycle = parse_layers("folder a/b : a/c :\nfolder a/c : a/b :\n");
  ASSERT_FALSE(cycle);
  EXPECT_THAT(cycle.error().message, HasSubstr("a/b -> a/c -> a/b"));
}

}  // namespace
}  // namespace seeker::arch
