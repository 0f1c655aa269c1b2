#include "server/app/landmarks/landmark_library.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/unit/server/localize/landmark_room.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::app {
namespace {

namespace room = localize::testing;

class LandmarkLibraryTest : public ::testing::Test {
 protected:
  static const localize::LandmarkDatabase& database() {
    static const localize::LandmarkDatabase kDatabase =
        room::survey(room::LandmarkRoom(1, 400), StereoGeometry{}, localize::DatabaseParams{}, 3);
    return kDatabase;
  }

  testing::TemporaryFolder folder_;
  LandmarkLibrary library_{{.folder = folder_.path() / "landmarks", .robot_id = "r-1", .software_version = "1.2"}};
};

TEST_F(LandmarkLibraryTest, WhatWasKeptIsReadAsItWas) {
  const auto kept = library_.create("lab", database(), "office", false);
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_EQ(kept->robot_id, "r-1");
  EXPECT_EQ(kept->map_name, "office");
  EXPECT_EQ(kept->landmarks, database().size());
  const auto loaded = library_.load("lab");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->summary, *kept);
  ASSERT_EQ(loaded->database->size(), database().size());
  EXPECT_EQ(loaded->database->next_id(), database().next_id());
  for (const localize::Landmark& landmark : database().landmarks()) {
    ASSERT_NE(loaded->database->find(landmark.id), nullptr);
    EXPECT_EQ(*loaded->database->find(landmark.id), landmark);
  }
}

TEST_F(LandmarkLibraryTest, AnExistingOneIsOnlyReplacedWhenAskedTo) {
  ASSERT_TRUE(library_.create("lab", database(), "", false));
  EXPECT_EQ(library_.check_free("lab", false).error().code, Errc::kRefused);
  EXPECT_EQ(library_.create("lab", database(), "", false).error().code, Errc::kRefused);
  EXPECT_TRUE(library_.create("lab", database(), "", true));
}

TEST_F(LandmarkLibraryTest, PruningKeepsWhatWasSeenOftenAndCanBeTakenBack) {
  ASSERT_TRUE(library_.create("lab", database(), "", false));
  const auto pruned = library_.prune("lab", 8);
  ASSERT_TRUE(pruned) << pruned.error().message;
  EXPECT_GT(pruned->landmarks, 0U);
  EXPECT_LT(pruned->landmarks, database().size());
  const auto loaded = library_.load("lab");
  ASSERT_TRUE(loaded) << loaded.error().message;
  for (const localize::Landmark& landmark : loaded->database->landmarks()) {
    EXPECT_GE(landmark.seen, 8);
  }
  EXPECT_EQ(library_.prune("lab", 100'000).error().code, Errc::kRefused);
  EXPECT_EQ(library_.revert("lab")->landmarks, database().size());
  EXPECT_EQ(library_.revert("lab").error().code, Errc::kNotReady);
}

TEST_F(LandmarkLibraryTest, ADamagedOneIsListedWithItsProblem) {
  ASSERT_TRUE(library_.create("lab", database(), "", false));
  std::ofstream(folder_.path() / "landmarks" / "attic.seekerlm") << "no database";
  const auto all = library_.list();
  ASSERT_TRUE(all);
  ASSERT_EQ(all->size(), 2U);
  EXPECT_EQ(all->front().name, "attic");
  EXPECT_FALSE(all->front().problem.empty());
  EXPECT_TRUE(all->back().problem.empty());
  EXPECT_EQ(library_.load("attic").error().code, Errc::kCorrupt);
}

TEST_F(LandmarkLibraryTest, UnknownNamesAreToldWhatThereIs) {
  EXPECT_NE(library_.load("lab").error().message.find("seeker survey"), std::string::npos);
  ASSERT_TRUE(library_.create("lab", database(), "", false));
  const auto unknown = library_.load("cellar");
  EXPECT_EQ(unknown.error().code, Errc::kNotFound);
  EXPECT_NE(unknown.error().message.find("lab"), std::string::npos);
  EXPECT_TRUE(library_.remove("lab"));
  EXPECT_EQ(library_.remove("lab").error().code, Errc::kNotFound);
}

TEST(LandmarkLibraryWithoutAFolder, IsNotReady) {
  LandmarkLibrary library{LandmarkStorage{}};
  EXPECT_EQ(library.list().error().code, Errc::kNotReady);
  EXPECT_EQ(library.load("lab").error().code, Errc::kNotReady);
  EXPECT_EQ(library.check_free("lab", true).error().code, Errc::kNotReady);
}

}  // namespace
}  // namespace seeker::app
