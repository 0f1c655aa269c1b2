#include "common/files/files.hpp"

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::files {
namespace {

using testing::TemporaryFolder;

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(Files, ReplacesTheContentAndLeavesNoTemporaryFile) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "map.yaml";
  ASSERT_TRUE(write_file(file, "first, and longer"));
  ASSERT_TRUE(write_file(file, "second"));
  const auto bytes = read_file(file, 100);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(std::string(bytes->begin(), bytes->end()), "second");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(Files, FailureKeepsTheOldFileAndCleansUp) {
  const TemporaryFolder folder;
  const std::filesystem::path taken = folder.path() / "taken";
  std::filesystem::create_directory(taken);
  std::ofstream(taken / "inside") << "a folder cannot be replaced by a file";
  const Status status = write_file(taken, "text");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, Errc::kIo);
  EXPECT_EQ(files_in(folder.path()), 1U);
  EXPECT_TRUE(std::filesystem::exists(taken / "inside"));
}

TEST(Files, MissingFolderIsATypedError) {
  const TemporaryFolder folder;
  const Status status = write_file(folder.path() / "absent" / "file", "text");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, Errc::kIo);
}

TEST(Files, ReadingTellsAbsenceAndSizeApart) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file";
  EXPECT_EQ(read_file(file, 100).error().code, Errc::kNotFound);
  ASSERT_TRUE(write_file(file, std::string(200'000, 'x')));
  EXPECT_EQ(read_file(file, 199'999).error().code, Errc::kTooLarge);
  EXPECT_EQ(read_file(file, 200'000)->size(), 200'000U);
}

TEST(Files, AreReadWholeWhateverTheirSize) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file";
  constexpr std::size_t kPiece_bytes = 65536;
  for (const std::size_t size_bytes : {std::size_t{0}, std::size_t{1}, kPiece_bytes, kPiece_bytes + 1}) {
    std::vector<std::uint8_t> bytes(size_bytes);
    for (std::size_t k = 0; k < bytes.size(); ++k) {
      bytes[k] = static_cast<std::uint8_t>(k % 251);
    }
    ASSERT_TRUE(write_file(file, bytes));
    EXPECT_EQ(read_file(file, size_bytes), bytes) << size_bytes;
  }
  EXPECT_EQ(read_file(folder.path(), 100).error().code, Errc::kIo) << "a folder is no file";
  EXPECT_FALSE(read_file("/proc/self/status")->empty()) << "its size is 0 until it is read";
}

}  // namespace
}  // namespace seeker::files
