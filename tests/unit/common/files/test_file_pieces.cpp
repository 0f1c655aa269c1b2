#include "common/files/file_pieces.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/files/files.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::files {
namespace {

using testing::TemporaryFolder;

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }
std::string text_in(const std::filesystem::path& file) {
  const auto bytes = read_file(file);
  return bytes ? std::string(bytes->begin(), bytes->end()) : bytes.error().message;
}

TEST(FilePieces, AreReadFromWhereOneAsks) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file";
  ASSERT_TRUE(write_file(file, "0123456789"));
  const Result<FileReader> reader = FileReader::open(file);
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->read(3, 4).value(), bytes_of("3456"));
  EXPECT_EQ(reader->read(8, 4).value(), bytes_of("89")) << "fewer at the end";
  EXPECT_TRUE(reader->read(10, 4)->empty());
  EXPECT_EQ(reader->identity()->size_bytes, 10U);
  EXPECT_EQ(FileReader::open(folder.path() / "absent").error().code, Errc::kNotFound);
  EXPECT_EQ(FileReader::open(folder.path()).error().code, Errc::kIo);
}

TEST(FilePieces, AreWrittenOneAfterTheOtherAndWhatIsBehindIsCutOff) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file";
  ASSERT_TRUE(write_piece(file, 0, {}));
  ASSERT_TRUE(write_piece(file, 0, bytes_of("first")));
  ASSERT_TRUE(write_piece(file, 5, bytes_of("second")));
  EXPECT_EQ(text_in(file), "firstsecond");
  ASSERT_TRUE(write_piece(file, 5, bytes_of("2")));
  EXPECT_EQ(text_in(file), "first2");
  EXPECT_EQ(write_piece(folder.path() / "absent", 5, bytes_of("x")).error().code, Errc::kIo);
}

TEST(FilePieces, FullDiskLeavesWhatWasThere) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file";
  ASSERT_TRUE(write_piece(file, 0, bytes_of("kept")));
  {
    const testing::FileSizeLimit full(6);
    const Status written = write_piece(file, 4, bytes_of("too much"));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, Errc::kIo);
    EXPECT_NE(written.error().message.find("space"), std::string::npos) << written.error().message;
  }
  EXPECT_EQ(text_in(file), "kept");
}

TEST(FilePieces, PutInPlaceReplacesAWholeFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder.path() / "to", "old"));
  ASSERT_TRUE(write_piece(folder.path() / "from", 0, bytes_of("new")));
  ASSERT_TRUE(put_in_place(folder.path() / "from", folder.path() / "to"));
  EXPECT_EQ(text_in(folder.path() / "to"), "new");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "from"));
  EXPECT_EQ(put_in_place(folder.path() / "from", folder.path() / "to").error().code, Errc::kIo);
}

}  // namespace
}  // namespace seeker::files
