// A map that is saved, outlives the death of its robot, and is found again.

#include <fstream>
#include <iterator>

#include "tests/integration/processes/watcher.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kWithMap{"--set", "estimator=line_slam"};

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(MapProcesses, SavedMapSurvivesAKillAndTheRobotFindsItsPlaceInIt) {
  const std::filesystem::path folder = fresh_folder("maps");
  const std::filesystem::path file = folder / "state" / "maps" / "demo.seekermap";
  std::string output;
  {
    Daemon daemon(kWithMap, folder);
    ASSERT_EQ(seeker(daemon, {"goto", "2,0.5", "0.5,0"}, &output), 0) << output;
    ASSERT_EQ(seeker(daemon, {"map", "save", "demo"}, &output), 0) << output;
    EXPECT_EQ(seeker(daemon, {"map", "export", folder / "demo", "--format", "svg,geojson,tum"}, &output), 0) << output;
    EXPECT_GT(content(folder / "demo.geojson").size(), 200U);
    daemon.kill();
  }
  const std::string saved = content(file);
  ASSERT_FALSE(saved.empty());
  Daemon again(kWithMap, folder);
  EXPECT_EQ(seeker(again, {"map", "verify", "demo"}, &output), 0) << output;
  EXPECT_EQ(seeker(again, {"map", "verify", file}, &output), 0) << output;
  EXPECT_EQ(seeker(again, {"map", "download", "demo", folder / "copy.seekermap"}, &output), 0) << output;
  EXPECT_EQ(content(folder / "copy.seekermap"), saved);
  for (int times = 0; times < 2; ++times) {
    EXPECT_EQ(seeker(again, {"map", "upload", folder / "copy.seekermap"}, &output), 0) << "repeating it: " << output;
  }
  EXPECT_EQ(seeker(again, {"map", "upload", folder / "copy.seekermap", "--name", "demo"}, &output), 0) << output;
  ASSERT_EQ(seeker(again, {"map", "load", "demo", "--localise"}, &output), 0) << output;
  // The simulated robot stands at its start again: the origin of the map.
  ASSERT_EQ(seeker(again, {"relocalise", "--at", "0,0,0", "--wait", "--json"}, &output), 0) << output;
  EXPECT_NE(output.find("\"quality\":\"LOCALISED\""), std::string::npos) << output;
  EXPECT_EQ(seeker(again, {"goto", "1,0"}, &output), 0) << output;
  EXPECT_EQ(seeker(again, {"map", "save", "demo", "--replace"}, &output), 3) << output;
  EXPECT_EQ(content(file), saved) << "localising never writes the map it uses";
}

TEST(MapProcesses, SearchGoesOnWithTheFloorItHadSearchedAfterAKill) {
  const fs::path folder = fresh_folder("search_crash");
  const fs::path kept = folder / "state" / "maps" / "checkpoints" / "sim-1" / "look.search";
  const std::vector<std::string> slow{"--set", "sim.speed=15", "--set", "loop.map.checkpoint_period_s=1"};
  constexpr int kMoreCells = 20;  // checkpoints follow meanwhile
  int searched = 0;
  {
    Daemon daemon(slow, folder);
    Watcher watcher(daemon);
    ASSERT_EQ(seeker(daemon, {"search", "--target", "cross", "--explore", "--on-found", "continue", "--detach", "--id",
                              "look"}),
              0);
    ASSERT_TRUE(wait_for_file(kept, seconds(60)));
    searched = watcher.status().mission->cells_searched;
    static_cast<void>(
        watcher.until([&](const api::MissionStatus& m) { return m.cells_searched >= searched + kMoreCells; }));
    daemon.kill();
  }
  const Daemon again(slow, folder);
  Watcher watcher(again);
  std::string output;
  ASSERT_EQ(seeker(again, {"resume"}, &output), 0) << output;
  const api::RobotStatus first =
      watcher.until([](const api::MissionStatus& m) { return m.id == "look" && m.cells_searched > 0; });
  EXPECT_GE(first.mission->cells_searched, searched);
  EXPECT_LT(first.mission->path_length_m, 1.0) << "it has hardly begun to drive";
  EXPECT_EQ(seeker(again, {"stop"}), 0);
}

TEST(MapProcesses, EstimatorWithoutMapSaysWhichOneKeepsOne) {
  const Daemon daemon({"--set", "estimator=scan_match"});
  std::string output;
  EXPECT_EQ(seeker(daemon, {"map", "save", "demo"}, &output), 3);
  EXPECT_NE(output.find("line_slam"), std::string::npos) << output;
  EXPECT_EQ(seeker(daemon, {"map", "load", "demo"}, &output), 1);
  EXPECT_NE(output.find("there is no map 'demo'"), std::string::npos) << output;
  EXPECT_EQ(seeker(daemon, {"map", "list", "--json"}, &output), 0);
  EXPECT_NE(output.find("{\"maps\":[]}"), std::string::npos) << output;
}

}  // namespace
}  // namespace seeker::testing
