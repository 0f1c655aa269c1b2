#include "server/store/landmark_file.hpp"

#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "common/files/files.hpp"
#include "server/store/store.hpp"
#include "tests/unit/server/store/killed_writer.hpp"
#include "tests/unit/server/store/landmark_samples.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

using testing::some_landmarks;

class LandmarkFileTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "lab.seekerlm"; }
  void sql(const std::string& text) const {
    sqlite3* raw = nullptr;
    ASSERT_EQ(sqlite3_open(file().c_str(), &raw), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(raw, text.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(raw);
    sqlite3_close(raw);
  }

  testing::TemporaryFolder folder_;
  LandmarkOrigin origin_{"robot-1", "1.0", "office", 100, 200};
};

TEST_F(LandmarkFileTest, ReadsWhatWasWrittenAndLeavesNoOtherFileBehind) {
  const LandmarkContent content = some_landmarks(1, 50);
  ASSERT_TRUE(write_landmark_file(file(), origin_, content));
  const auto read = read_landmark_file(file());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->content, content);
  EXPECT_EQ(read->header, read_landmark_header(file()).value());
  const auto header = read_landmark_header(file());
  ASSERT_TRUE(header) << header.error().message;
  EXPECT_EQ(header->origin, origin_);
  EXPECT_EQ(header->calibration, content.calibration);
  EXPECT_EQ(header->revision, 1U);
  EXPECT_EQ(header->landmarks, 50U);
  EXPECT_FALSE(header->can_revert);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    ++files;
  }
  EXPECT_EQ(files, 1U);
}

TEST_F(LandmarkFileTest, AnUpdateCanBeTakenBackOnce) {
  const LandmarkContent before = some_landmarks(1, 20);
  LandmarkContent after = some_landmarks(2, 30);
  ASSERT_TRUE(write_landmark_file(file(), origin_, before));
  EXPECT_EQ(revert_landmark_file(file(), 250).error().code, Errc::kNotReady);
  ASSERT_TRUE(update_landmark_file(file(), 300, after));
  EXPECT_EQ(read_landmark_file(file()).value().content, after);
  EXPECT_TRUE(read_landmark_header(file())->can_revert);
  EXPECT_EQ(read_landmark_header(file())->origin.saved_unix_s, 300);
  EXPECT_EQ(read_landmark_header(file())->origin.created_unix_s, 100);
  ASSERT_TRUE(revert_landmark_file(file(), 400));
  EXPECT_EQ(read_landmark_file(file()).value().content, before);
  EXPECT_EQ(read_landmark_header(file())->revision, 3U);
  EXPECT_EQ(revert_landmark_file(file(), 500).error().code, Errc::kNotReady);
}

TEST_F(LandmarkFileTest, OnlyTheVersionBeforeIsKept) {
  ASSERT_TRUE(write_landmark_file(file(), origin_, some_landmarks(1, 5)));
  const LandmarkContent second = some_landmarks(2, 6);
  ASSERT_TRUE(update_landmark_file(file(), 300, second));
  ASSERT_TRUE(update_landmark_file(file(), 301, some_landmarks(3, 7)));
  ASSERT_TRUE(revert_landmark_file(file(), 302));
  EXPECT_EQ(read_landmark_file(file()).value().content, second);
}

TEST_F(LandmarkFileTest, WhatIsNoNumberIsRefusedAndChangesNothing) {
  const LandmarkContent before = some_landmarks(1, 5);
  ASSERT_TRUE(write_landmark_file(file(), origin_, before));
  LandmarkContent broken = some_landmarks(2, 5);
  broken.landmarks[3].p_map[1] = std::numeric_limits<double>::quiet_NaN();
  const Status refused = update_landmark_file(file(), 300, broken);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("landmark 7"), std::string::npos) << refused.error().message;
  EXPECT_EQ(read_landmark_file(file()).value().content, before);
  EXPECT_FALSE(read_landmark_header(file())->can_revert);
}

TEST_F(LandmarkFileTest, AFileOfANewerProgramIsRefusedWithBothVersions) {
  ASSERT_TRUE(write_landmark_file(file(), origin_, some_landmarks(1, 5)));
  sql("PRAGMA user_version = 7");
  const auto read = read_landmark_file(file());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, Errc::kUnsupportedVersion);
  EXPECT_NE(read.error().message.find("version 7"), std::string::npos);
  EXPECT_NE(read.error().message.find("up to 1"), std::string::npos);
  EXPECT_EQ(update_landmark_file(file(), 300, some_landmarks(2, 5)).error().code, Errc::kUnsupportedVersion);
}

TEST_F(LandmarkFileTest, AnotherKindOfDatabaseIsNotTakenForOne) {
  { ASSERT_TRUE(Store::open(folder_.path())); }
  const auto read = read_landmark_file(folder_.path() / "seeker.db");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, Errc::kInvalidArgument);
  EXPECT_EQ(read_landmark_file(folder_.path() / "none").error().code, Errc::kNotFound);
}

TEST_F(LandmarkFileTest, WhatRunsWhenItIsReadIsRefusedBeforeItRuns) {
  ASSERT_TRUE(write_landmark_file(file(), origin_, some_landmarks(4, 5)));
  sql("DROP TABLE sides");
  sql("CREATE VIEW sides AS WITH RECURSIVE n(generation) AS (SELECT 0 UNION ALL SELECT 0 FROM n) SELECT generation, "
      "1 AS landmark, 1 AS side, 0.0 AS eye_x, 0.0 AS eye_y, 0.0 AS eye_z, 1 AS seen, x'00' AS descriptor FROM n");
  EXPECT_EQ(read_landmark_file(file()).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(read_landmark_header(file()).error().code, Errc::kInvalidArgument);
}

TEST_F(LandmarkFileTest, AChangedNumberIsFound) {
  ASSERT_TRUE(write_landmark_file(file(), origin_, some_landmarks(1, 5)));
  sql("UPDATE landmarks SET x = x + 0.001 WHERE id = 3");
  EXPECT_EQ(read_landmark_file(file()).error().code, Errc::kCorrupt);
  ASSERT_TRUE(write_landmark_file(file(), origin_, some_landmarks(1, 5)));
  sql("DELETE FROM landmarks WHERE id = 3");
  EXPECT_EQ(read_landmark_file(file()).error().code, Errc::kCorrupt);
  ASSERT_TRUE(write_landmark_file(file(), origin_, some_landmarks(1, 5)));
  sql("UPDATE sides SET descriptor = x'00' WHERE landmark = 3");
  EXPECT_EQ(read_landmark_file(file()).error().code, Errc::kCorrupt);
}

TEST_F(LandmarkFileTest, AFileCutOffAnywhereIsRefused) {
  ASSERT_TRUE(write_landmark_file(file(), origin_, some_landmarks(1, 40)));
  const auto whole = files::read_file(file(), 1U << 24U).value();
  for (std::size_t cut = 0; cut < whole.size(); cut += 1 + whole.size() / 60) {
    ASSERT_TRUE(files::write_file(file(), std::span(whole).first(cut)));
    const auto read = read_landmark_file(file());
    ASSERT_FALSE(read) << "cut at " << cut;
    EXPECT_NE(read.error().code, Errc::kInternal);
  }
}

TEST_F(LandmarkFileTest, KilledInAnUpdateItIsAsBeforeOrAfterNeverBetween) {
  constexpr std::uint64_t kSeed = 20261121;
  constexpr int kKills = 100;
  RecordProperty("seed", std::to_string(kSeed));
  Rng rng(kSeed);
  for (int round = 0; round < kKills; ++round) {
    ASSERT_TRUE(write_landmark_file(file(), origin_, some_landmarks(1, 60)));
    const auto update = [this](std::uint64_t n) {
      return update_landmark_file(file(), static_cast<std::int64_t>(n + 1), some_landmarks(n + 1, 60)).has_value();
    };
    const std::uint64_t told = testing::kill_a_writer(update, rng.below(3), rng.below(3'000'000));
    const auto read = read_landmark_file(file());
    ASSERT_TRUE(read) << read.error().message << ", round " << round;
    // Version n holds the landmarks of seed n, and the first one is 1.
    const std::uint64_t revision = read_landmark_header(file())->revision;
    ASSERT_GE(revision, told + 1) << "a change that was told is lost";
    ASSERT_LE(revision, told + 2);
    ASSERT_EQ(read->content, some_landmarks(revision, 60)) << "round " << round;
  }
}

}  // namespace
}  // namespace seeker::store
