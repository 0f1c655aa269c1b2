#include "common/files/config_folder.hpp"

#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/process.hpp"

namespace seeker::files {
namespace {

namespace fs = std::filesystem;

/// For a program of /usr/bin or of a tree, where these folders are configurations.
fs::path found(const char* working, const char* program, const std::set<fs::path>& configurations) {
  return config_folder(working, program, [&](const fs::path& folder) { return configurations.contains(folder); });
}

const fs::path kInstalled = "/usr/share/seeker/config";
const fs::path kOfTree = "/src/seeker/config";

TEST(ConfigFolder, IsThatOfTheWorkingFolderOrOfOneAboveIt) {
  EXPECT_EQ(found("/src/seeker", "/usr/bin", {kOfTree, kInstalled}), kOfTree);
  EXPECT_EQ(found("/src/seeker/docs/pictures", "/usr/bin", {kOfTree, kInstalled}), kOfTree);
}

TEST(ConfigFolder, IsThatOfTheTreeInWhichTheProgramWasBuilt) {
  EXPECT_EQ(found("/elsewhere", "/src/seeker/build/release/bin", {kOfTree, kInstalled}), kOfTree);
}

TEST(ConfigFolder, IsThatOfThePackageWhereNoTreeIsNear) {
  EXPECT_EQ(found("/elsewhere", "/usr/bin", {kInstalled}), kInstalled);
  EXPECT_EQ(found("/", "/usr/bin", {kOfTree, kInstalled}), kInstalled);
  EXPECT_EQ(found("/", "/opt/seeker/bin", {"/opt/seeker/share/seeker/config"}), "/opt/seeker/share/seeker/config");
}

TEST(ConfigFolder, ThatIsNowhereIsNamedAsInATree) { EXPECT_EQ(found("/elsewhere", "/usr/bin", {}), "config"); }

TEST(ConfigFolder, OfThisTestIsThatOfTheTree) {
  EXPECT_TRUE(fs::is_regular_file(config_folder() / "robots/sim.yaml")) << config_folder();
}

TEST(NamedFile, HasItsEndingOrNot) {
  EXPECT_EQ(named_file("no-such", "/robots"), "/robots/no-such.yaml");
  EXPECT_EQ(named_file("no-such.yaml", "/robots"), "/robots/no-such.yaml");
}

TEST(NamedFile, GivesWayToWhatIsAPath) {
  const fs::path folder = testing::fresh_folder("named-file");
  std::ofstream(folder / "mine.yaml") << "robot_id: mine\n";
  EXPECT_EQ(named_file(folder / "mine.yaml", "/robots"), folder / "mine.yaml");
  EXPECT_EQ(named_file("no/such", "/robots"), "no/such") << "a path stays as it is, so that an error names it";
}

TEST(NamedFile, IsNoFolderOfThatName) {
  const fs::path folder = testing::fresh_folder("named-folder");
  const fs::path before = fs::current_path();
  fs::create_directory(folder / "office");
  fs::current_path(folder);
  EXPECT_EQ(named_file("office", "/worlds"), "/worlds/office.yaml");
  fs::current_path(before);
}

}  // namespace
}  // namespace seeker::files
