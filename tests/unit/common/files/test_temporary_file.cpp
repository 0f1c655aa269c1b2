#include "common/files/temporary_file.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::files {
namespace {

namespace fs = std::filesystem;

using testing::TemporaryFolder;

TEST(TemporaryFile, IsGoneAtItsEndOrHasTakenThePlaceOfItsFile) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a";
  fs::path beside;
  {
    const Result<TemporaryFile> temporary = TemporaryFile::beside(file);
    ASSERT_TRUE(temporary);
    beside = temporary->path();
    EXPECT_TRUE(fs::exists(beside));
  }
  EXPECT_FALSE(fs::exists(beside));
  Result<TemporaryFile> temporary = TemporaryFile::beside(file, ReadableBy::kOwner);
  ASSERT_TRUE(temporary);
  ASSERT_TRUE(temporary->move_to(file));
  EXPECT_TRUE(fs::exists(file));
  EXPECT_FALSE(fs::exists(temporary->path()));
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(TemporaryFile, WhatAKillHasLeftIsRemovedAndNothingElse) {
  const TemporaryFolder folder;
  const fs::path below = folder.path() / "maps";
  fs::create_directory(below);
  const std::vector<fs::path> left{folder.path() / "a.seekermap.tmp-Ab3dEf", below / "b.tmp-000000",
                                   below / "c.seekerlm.tmp-zzzzzz-journal"};
  const std::vector<fs::path> others{folder.path() / "a.seekermap", below / "map.backup", below / "tmp-Ab3dEf",
                                     below / "b.tmp-12", below / "seeker.db-journal"};
  for (const auto& files : {left, others}) {
    for (const fs::path& file : files) {
      std::ofstream(file) << "content";
    }
  }
  const Result<TemporaryFile> written = TemporaryFile::beside(below / "in-hand");
  ASSERT_TRUE(written);
  EXPECT_EQ(remove_left_over(folder.path()), left.size());
  for (const fs::path& file : left) {
    EXPECT_FALSE(fs::exists(file)) << file;
  }
  for (const fs::path& file : others) {
    EXPECT_TRUE(fs::exists(file)) << file;
  }
  EXPECT_TRUE(fs::exists(written->path())) << "another program is writing it";
  EXPECT_EQ(remove_left_over(folder.path() / "absent"), 0U);
}

}  // namespace
}  // namespace seeker::files
