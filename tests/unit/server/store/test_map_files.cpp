#include "server/store/map_files.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "common/files/files.hpp"
#include "tests/support/maps/random_map.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

MapFile room(const std::string& name) {
  MapFile file;
  file.origin.name = name;
  file.origin.robot_id = "seeker-1";
  file.map = testing::room_map();
  return file;
}

TEST(MapFiles, WrittenMapsAreListedByNameAndReadBack) {
  const testing::TemporaryFolder folder;
  const MapFiles files(folder.path() / "maps");
  EXPECT_TRUE(files.list()->empty()) << "an absent folder has no maps";
  ASSERT_TRUE(files.write(room("office"), false));
  const Result<MapListing> written = files.write(room("attic"), false);
  ASSERT_TRUE(written);
  EXPECT_EQ(written->header.segments, 4U);
  const Result<std::vector<MapListing>> list = files.list();
  ASSERT_TRUE(list);
  ASSERT_EQ(list->size(), 2U);
  EXPECT_EQ(list->front().header.origin.name, "attic");
  EXPECT_GT(list->front().file_bytes, 100U);
  EXPECT_EQ(files.read("office").value(), room("office"));
}

TEST(MapFiles, ExistingMapIsReplacedOnPurposeOnly) {
  const testing::TemporaryFolder folder;
  const MapFiles files(folder.path());
  ASSERT_TRUE(files.write(room("office"), false));
  const Result<MapListing> again = files.write(room("office"), false);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, Errc::kRefused);
  EXPECT_NE(again.error().message.find("--replace"), std::string::npos);
  EXPECT_TRUE(files.write(room("office"), true));
}

TEST(MapFiles, UnknownNameListsTheKnownOnes) {
  const testing::TemporaryFolder folder;
  const MapFiles files(folder.path());
  EXPECT_NE(files.read("office").error().message.find("seeker map save"), std::string::npos);
  ASSERT_TRUE(files.write(room("attic"), false));
  const Result<MapFile> none = files.read("office");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, Errc::kNotFound);
  EXPECT_NE(none.error().message.find("attic"), std::string::npos);
  EXPECT_EQ(files.read("../attic").error().code, Errc::kInvalidArgument);
}

TEST(MapFiles, DamagedFileIsListedWithItsProblem) {
  const testing::TemporaryFolder folder;
  const MapFiles files(folder.path());
  ASSERT_TRUE(files.write(room("good"), false));
  ASSERT_TRUE(files::write_file(files.path_of("bad"), "this is no map"));
  std::ofstream(folder.path() / "notes.txt") << "not a map either, but none that claims to be one";
  const Result<std::vector<MapListing>> list = files.list();
  ASSERT_TRUE(list);
  ASSERT_EQ(list->size(), 2U);
  EXPECT_EQ(list->front().header.origin.name, "bad");
  EXPECT_FALSE(list->front().problem.empty());
  EXPECT_TRUE(list->back().problem.empty());
  EXPECT_EQ(files.read_bytes("bad").error().code, Errc::kParse);
}

TEST(MapFiles, RemovedMapIsGone) {
  const testing::TemporaryFolder folder;
  const MapFiles files(folder.path());
  ASSERT_TRUE(files.write(room("office"), false));
  ASSERT_TRUE(files.remove("office"));
  EXPECT_EQ(files.remove("office").error().code, Errc::kNotFound);
  EXPECT_TRUE(files.list()->empty());
}

}  // namespace
}  // namespace seeker::store
