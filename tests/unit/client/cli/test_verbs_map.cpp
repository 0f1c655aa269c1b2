#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "client/cli/export_files.hpp"
#include "tests/support/maps/random_map.hpp"
#include "tests/unit/client/cli/cli_fixture.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

class MapVerbs : public ::testing::Test, public CliFixture {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / ("seeker_cli_map_" + std::to_string(::getpid()) + "_" +
                                                ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    host->edit([](testing::FakeRobotValues& v) {
      v.segments = api::SegmentUpdate{3, 0, true, testing::room_map().segments, {}};
      v.maps.push_back({});
      v.maps.back().name = "office";
      v.maps.back().segments = 4;
      v.map_files["office"] = {1, 2, 3};
      v.status.line_map = api::LineMapStatus{"office", api::MapUse::kLocalise, 4, 3, false};
    });
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string read(const std::string& name) const {
    std::ifstream file(folder_ / name);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::string last_call() const { return host->values().calls.empty() ? "" : host->values().calls.back(); }

  fs::path folder_;
};

TEST_F(MapVerbs, AnswerWithTheDocumentedKeys) {
  const std::vector<std::string> summary{"name", "robot_id", "segments", "keyframes", "saved_unix_s", "problem"};
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> cases{
      {{"map", "save", "attic"}, summary},
      {{"map", "load", "office", "--localise"}, summary},
      {{"map", "info", "office"}, summary},
      {{"map", "verify", "office"}, summary},
      {{"map", "list"}, {"maps"}},
      {{"map", "download", "office", path("copy.seekermap")}, {"ok", "message"}},
      {{"map", "delete", "attic", "--yes"}, {"ok", "message"}},
      {{"relocalise"}, {"ok", "message"}},
      {{"relocalise", "--wait"}, {"quality", "cause", "pose", "sigma_m", "from_given_m", "waited_s"}},
  };
  for (const auto& [verb, keys] : cases) {
    std::vector<std::string> arguments = verb;
    arguments.emplace_back("--json");
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.code, 0) << verb[1] << ran.err;
    EXPECT_TRUE(is_json(ran.out)) << ran.out;
    for (const std::string& key : keys) {
      EXPECT_NE(ran.out.find("\"" + key + "\":"), std::string::npos) << verb[1] << " " << key << " in " << ran.out;
    }
  }
  EXPECT_EQ(read("copy.seekermap").size(), 3U);
}

TEST_F(MapVerbs, OneOfAThingIsNotToldAsMany) {
  host->edit([](testing::FakeRobotValues& v) {
    v.maps.back().loops = 1;
    v.maps.back().keyframes = 2;
  });
  const Ran ran = run({"map", "list"});
  EXPECT_NE(ran.out.find("4 segments, 2 scans, 1 loop,"), std::string::npos) << ran.out;
}

TEST_F(MapVerbs, LoadAsksForTheUseThatWasWanted) {
  EXPECT_EQ(run({"map", "load", "office", "--localise"}).code, 0);
  EXPECT_EQ(last_call(), "seeker-test load_map office localise");
  EXPECT_EQ(run({"map", "load", "office"}).code, 0);
  EXPECT_EQ(last_call(), "seeker-test load_map office continue");
}

TEST_F(MapVerbs, RefusalsHaveTheirExitCodes) {
  EXPECT_EQ(run({"map", "save", "office"}).code, 3) << "there is such a map";
  EXPECT_EQ(run({"map", "save", "office", "--replace"}).code, 0);
  const Ran unknown = run({"map", "load", "cellar"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_NE(unknown.err.find("there is no map 'cellar'"), std::string::npos);
  const Ran unsure = run({"map", "delete", "office"});
  EXPECT_EQ(unsure.code, 2);
  EXPECT_NE(unsure.err.find("--yes"), std::string::npos);
  EXPECT_EQ(run({"relocalise", "--at", "1,2"}).code, 2);
  host->edit([](testing::FakeRobotValues& v) { v.segments.reset(); });
  const Ran none = run({"map", "save", "attic"});
  EXPECT_EQ(none.code, 3);
  EXPECT_NE(none.err.find("line_slam"), std::string::npos);
}

TEST_F(MapVerbs, RelocaliseTakesDegreesAndEndsAsTheRobotEnds) {
  EXPECT_EQ(run({"relocalise", "--at", "3,4.5,90", "--wait"}).code, 0);
  const auto at = host->values().relocalisations.back();
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->theta_rad, 1.5708, 1e-4);
  EXPECT_DOUBLE_EQ(at->y_m, 4.5);
  host->edit([](testing::FakeRobotValues& v) { v.status.pose.map_T_base = {0.0, 0.5, 0.0}; });
  const Ran elsewhere = run({"relocalise", "--at", "3,4.5,90", "--wait"});
  EXPECT_NE(elsewhere.out.find(", 5.00 m from the place given"), std::string::npos) << elsewhere.out;
  host->edit([](testing::FakeRobotValues& v) {
    v.status.pose.quality = LocalisationQuality::kLost;
    v.status.pose.cause = "no place of the map looks like this";
  });
  const Ran lost = run({"relocalise", "--wait"});
  EXPECT_EQ(lost.code, 1);
  EXPECT_NE(lost.out.find("no place of the map looks like this"), std::string::npos) << lost.out;
  EXPECT_EQ(lost.out.find(" at "), std::string::npos) << lost.out;
  EXPECT_NE(run({"relocalise", "--wait", "--json"}).out.find(R"("pose":null,"sigma_m":null)"), std::string::npos);
  host->edit([](testing::FakeRobotValues& v) { v.status.line_map->relocalising = true; });
  EXPECT_EQ(run({"relocalise", "--wait", "--timeout", "0.3"}).code, 5);
}

TEST_F(MapVerbs, WaitFollowsTheRobotUntilItHasFoundItsPlace) {
  host->edit([](testing::FakeRobotValues& v) {
    v.status.pose.quality = LocalisationQuality::kUnknown;
    v.status.line_map->relocalising = true;
  });
  const Ran ran = run({"relocalise", "--wait"}, [&] {
    while (host->values().relocalisations.empty()) {
      std::this_thread::yield();
    }
    host->edit([](testing::FakeRobotValues& v) {
      v.status.pose.quality = LocalisationQuality::kLocalised;
      v.status.line_map->relocalising = false;
    });
  });
  EXPECT_EQ(ran.code, 0) << ran.err;
}

TEST_F(MapVerbs, VerifyOfAFileSendsItToBeCheckedAndUploadKeepsIt) {
  std::ofstream(folder_ / "attic.seekermap") << "bytes";
  EXPECT_EQ(run({"map", "verify", path("attic.seekermap")}).code, 0);
  EXPECT_TRUE(host->values().uploads.back().check_only);
  EXPECT_EQ(run({"map", "upload", path("attic.seekermap")}).code, 0);
  EXPECT_FALSE(host->values().uploads.back().check_only);
  EXPECT_EQ(host->values().uploads.back().name, "attic");
  EXPECT_EQ(host->values().uploads.back().bytes.size(), 5U);
  EXPECT_EQ(run({"map", "upload", path("attic.seekermap"), "--name", "A"}).code, 2);
  EXPECT_EQ(run({"map", "upload", path("absent.seekermap"), "--name", "a"}).code, 2);
  host->edit([](testing::FakeRobotValues& v) { v.failure = Error{Errc::kCorrupt, "the map file is damaged"}; });
  EXPECT_EQ(run({"map", "verify", path("attic.seekermap")}).code, 2) << "the file here is damaged";
  EXPECT_EQ(run({"map", "verify", "office"}).code, 1) << "the file of the robot is damaged";
  host->edit([](testing::FakeRobotValues& v) { v.failure = Error{Errc::kIo, "the disk is full"}; });
  EXPECT_EQ(run({"map", "upload", path("attic.seekermap")}).code, 1) << "the robot's disk";
}

TEST_F(MapVerbs, ExportWritesTheFormatsAskedForAndPicturesByDefault) {
  EXPECT_EQ(run({"map", "export", path("out/room")}).code, 0);
  for (const char* ending : {".pgm", ".yaml", ".png"}) {
    EXPECT_TRUE(fs::exists(path("out/room") + ending)) << ending;
  }
  EXPECT_FALSE(fs::exists(path("out/room.svg")));
  const Ran ran = run({"map", "export", path("out/all"), "--format", "svg,geojson,tum"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(is_json(read("out/all.geojson"))) << read("out/all.geojson");
  EXPECT_NE(read("out/all.svg").find("<path"), std::string::npos);
  EXPECT_NE(read("out/all.tum").find("1.000000 1.000000 2.000000 0 0 0 0.247"), std::string::npos)
      << read("out/all.tum");
  EXPECT_FALSE(fs::exists(path("out/all.png")));
  EXPECT_EQ(run({"map", "export", path("x"), "--format", "dxf"}).code, 2);
  host->edit([](testing::FakeRobotValues& v) { v.segments.reset(); });
  EXPECT_EQ(run({"map", "export", path("none"), "--format", "svg"}).code, 3);
}

TEST_F(MapVerbs, ExportOverwritesItsOwnFilesOnly) {
  const std::vector<std::string> all{"map", "export", path("room"), "--format", "pgm,png,svg,geojson,tum"};
  const std::vector<std::string> endings{".pgm", ".yaml", ".png", ".svg", ".geojson", ".tum"};
  ASSERT_EQ(run(all).code, 0);
  EXPECT_EQ(run(all).code, 0) << "exports of before are replaced";
  for (const std::string& ending : endings) {
    fs::remove(path("room") + ending);
  }
  for (const std::string& ending : endings) {
    std::ofstream(path("room") + ending) << "walls: []\n";
    const Ran refused = run(all);
    EXPECT_EQ(refused.code, 1) << ending;
    EXPECT_NE(refused.err.find("room" + ending + " is there"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("choose another name"), std::string::npos) << refused.err;
    EXPECT_EQ(read("room" + ending), "walls: []\n");
    for (const std::string& other : endings) {
      EXPECT_EQ(fs::exists(path("room") + other), other == ending) << "nothing is written: " << other;
    }
    fs::remove(path("room") + ending);
  }
}

TEST_F(MapVerbs, CameraPictureWithoutANameOverwritesPicturesOfTheCameraOnly) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  const Ran first = run({"camera", "grab"});
  ASSERT_EQ(first.code, 0) << first.err;
  const std::string file = first.out.substr(0, first.out.find('\n'));
  EXPECT_EQ(run({"camera", "grab"}).code, 0);
  std::ofstream(file) << "mine";
  EXPECT_EQ(run({"camera", "grab"}).code, 1);
  EXPECT_EQ(read(file), "mine");
  EXPECT_EQ(run({"camera", "grab", "--out", file}).code, 0) << "a file that was named is overwritten";
  fs::current_path(before);
}

TEST_F(MapVerbs, PictureOfLandmarksOverwritesItsOwnKindOnly) {
  host->edit([](testing::FakeRobotValues& v) {
    v.landmarks["lab"] = {{.id = 1, .p = {1.0, 2.0}, .z_m = 0.5, .sigma_m = 0.01, .views = 3},
                          {.id = 2, .p = {3.0, 1.0}, .z_m = 0.5, .sigma_m = 0.01, .views = 3}};
  });
  const std::vector<std::string> verb{"landmarks", "export", "lab", path("lab.csv")};
  ASSERT_EQ(run(verb).code, 0) << run(verb).err;
  EXPECT_EQ(run(verb).code, 0);
  fs::remove(path("lab.csv"));
  std::ofstream(path("lab.png")) << "mine";
  EXPECT_EQ(run(verb).code, 1);
  EXPECT_EQ(read("lab.png"), "mine");
  EXPECT_FALSE(fs::exists(path("lab.csv"))) << "nothing is written";
}

TEST_F(MapVerbs, MapOfTilesFarApartIsRefusedInsteadOfFillingTheMemory) {
  host->edit([](testing::FakeRobotValues& v) { v.tiles.tiles[0].index = {2'000'000'000, -2'000'000'000}; });
  const Ran ran = run({"map", "export", path("far")});
  EXPECT_NE(ran.code, 0);
  EXPECT_NE(ran.err.find("far apart"), std::string::npos);
}

TEST_F(MapVerbs, StatusTellsOfTheMap) {
  EXPECT_NE(run({"status"}).out.find("4 segments, 'office', only localised in"), std::string::npos);
  EXPECT_NE(run({"status", "--json"}).out.find("\"line_map\":{\"name\":\"office\",\"use\":\"localise\""),
            std::string::npos);
}

}  // namespace
}  // namespace seeker::cli
