#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/stereo_database/revisit_command.hpp"
#include "tests/support/data.hpp"

namespace seeker::lab {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Revisits : public ::testing::Test {
 protected:
  Revisits() : folder_(std::filesystem::path(::testing::TempDir()) / ("seeker_revisit_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_ / "in");
  }
  ~Revisits() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name) const {
    ASSERT_TRUE(image::write_png(folder_ / "in" / name, Image(32, 24, 1, 90)).has_value());
  }

  std::filesystem::path folder_;
};

TEST_F(Revisits, PicturesComeInTheOrderOfTheirNumbers) {
  for (const char* name : {"10.png", "2.png", "1.PNG", "a02_7.png", "a2_10.png", "a01_9.png"}) {
    write(name);
  }
  ASSERT_TRUE(files::write_file(folder_ / "in" / "notes.txt", "3").has_value());
  const auto found = ordered_pictures(folder_ / "in");
  ASSERT_TRUE(found.has_value());
  std::vector<std::string> names;
  for (const auto& path : *found) {
    names.push_back(path.filename().string());
  }
  EXPECT_THAT(names, ElementsAre("1.PNG", "2.png", "10.png", "a01_9.png", "a02_7.png", "a2_10.png"));
}

TEST_F(Revisits, AFolderWithoutPicturesIsRefusedByName) {
  const auto empty = find_revisits({.folder = folder_ / "in", .out = folder_ / "out"});
  ASSERT_FALSE(empty.has_value());
  EXPECT_EQ(empty.error().code, Errc::kNotFound);
  EXPECT_THAT(empty.error().message, HasSubstr("holds no picture"));
  EXPECT_FALSE(find_revisits({.folder = folder_ / "none", .out = folder_ / "out"}).has_value());
}

TEST_F(Revisits, ADamagedPictureIsNamed) {
  write("1.png");
  ASSERT_TRUE(files::write_file(folder_ / "in" / "2.jpg", "no picture").has_value());
  const auto found = find_revisits({.folder = folder_ / "in", .out = folder_ / "out"});
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, Errc::kCorrupt);
  EXPECT_THAT(found.error().message, HasSubstr("2.jpg"));
}

TEST_F(Revisits, BarePicturesShowNothingAgain) {
  for (const char* name : {"1.png", "2.png", "3.png"}) {
    write(name);
  }
  std::ostringstream text;
  const Status done = run_revisit({.folder = folder_ / "in", .out = folder_ / "out", .gap = 0, .json = true}, text);
  ASSERT_TRUE(done.has_value()) << done.error().message;
  EXPECT_EQ(text.str(), "{\n  \"revisits\": []\n}\n");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "revisits.csv"));
}

/// Picture i of the second lap shows what picture i - 39 of the first one shows (at the end i - 40); of the third lap
/// i - 80. See vision.md 1.4.
bool agrees_with_the_laps(int picture, int earlier) {
  constexpr double kTolerance = 2.0;
  const double one_lap = 39.0 + (picture - 41) / 38.0;
  const auto is_near = [&](double expected) { return std::abs(earlier - expected) <= kTolerance; };
  return is_near(picture - one_lap) || (picture > 80 && is_near(picture - 80.0));
}

TEST_F(Revisits, OfACorridorAreManyAndAllTrue) {
  SEEKER_REQUIRE_DATA(corridor, "vision/corridor");
  const auto found = find_revisits({.folder = corridor, .out = folder_ / "out"});
  ASSERT_TRUE(found.has_value()) << found.error().message;
  std::printf("corridor: %zu revisits\n", found->size());
  EXPECT_GE(found->size(), 30U);
  for (const Revisit& r : *found) {
    EXPECT_TRUE(agrees_with_the_laps(std::atoi(r.picture.c_str()), std::atoi(r.earlier.c_str())))
        << r.picture << " shows " << r.earlier;
    EXPECT_NE(r.picture, "22.jpg") << "the first lap has no revisits; this one was a wrong mask of inliers";
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / r.drawing));
  }
}

}  // namespace
}  // namespace seeker::lab
