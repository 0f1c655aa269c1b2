#include "common/image/export_mark.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/files/files.hpp"
#include "common/image/map_server.hpp"
#include "common/image/pgm.hpp"
#include "common/image/png.hpp"
#include "common/image/segment_export.hpp"
#include "tests/support/maps/random_map.hpp"

namespace seeker::image {
namespace {

class ExportMark : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / ("seeker_export_mark_" + std::to_string(::getpid()));
};

TEST_F(ExportMark, IsFoundInEveryFormat) {
  const Grid<std::uint8_t> floor(GridFrame{}, 3, 2, 0);
  ASSERT_TRUE(write_map_server(folder_ / "map", floor));
  ASSERT_TRUE(write_png(folder_ / "map.png", Image(4, 3, 3, 90), kMapExport));
  ASSERT_TRUE(
      files::write_file(folder_ / "map.svg", *segments_svg({"room", testing::room_map(8.0, 5.0).segments, {}})));
  ASSERT_TRUE(files::write_file(folder_ / "map.geojson", segments_geojson({})));
  for (const char* ending : {"pgm", "yaml", "png", "svg", "geojson"}) {
    EXPECT_TRUE(carries_mark(folder_ / (std::string("map.") + ending), kMapExport)) << ending;
    EXPECT_FALSE(carries_mark(folder_ / (std::string("map.") + ending), kLandmarksExport)) << ending;
  }
}

TEST_F(ExportMark, IsNotFoundInFilesOfOthers) {
  ASSERT_TRUE(write_png(folder_ / "photo.png", Image(4, 3, 3, 90)));
  ASSERT_TRUE(write_pgm(folder_ / "scan.pgm", Image(4, 3, 1, 90)));
  ASSERT_TRUE(files::write_file(folder_ / "world.yaml", "# not a Seeker map export\nwalls: []\n"));
  ASSERT_TRUE(files::write_file(folder_ / "empty.yaml", ""));
  for (const char* name : {"photo.png", "scan.pgm", "world.yaml", "empty.yaml", "absent.png", "."}) {
    EXPECT_FALSE(carries_mark(folder_ / name, kMapExport)) << name;
  }
}

TEST_F(ExportMark, LeavesThePictureReadable) {
  const Image picture(5, 4, 3, 77);
  const auto marked = encode_png(picture, kMapExport);
  ASSERT_TRUE(marked);
  const Result<Image> again = decode_png(*marked);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, picture);
  const Image grey(5, 4, 1, 77);
  EXPECT_EQ(decode_pgm(encode_pgm(grey, comment_mark(kMapExport))).value(), grey);
}

}  // namespace
}  // namespace seeker::image
