#include "server/store/outgoing_files.hpp"

#include <gtest/gtest.h>

#include "common/files/files.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

class Outgoing : public ::testing::Test {
 protected:
  Outgoing() { EXPECT_TRUE(files::write_file(file_, "0123456789")); }
  Result<OutgoingPiece> read(const OutgoingRange& range) {
    return outgoing_.read(file_, range, [this] {
      ++checks_;
      return sound_;
    });
  }
  static std::string text_of(const Result<OutgoingPiece>& piece) {
    return piece ? std::string(piece->bytes.begin(), piece->bytes.end()) : piece.error().message;
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "office.seekermap";
  OutgoingFiles outgoing_;
  Status sound_;
  int checks_ = 0;
};

TEST_F(Outgoing, PiecesJoinToTheFileWhichIsCheckedOnce) {
  const Result<OutgoingPiece> about = read({0, 0, std::nullopt});
  ASSERT_TRUE(about);
  EXPECT_EQ(about->size_bytes, 10U);
  EXPECT_TRUE(about->bytes.empty());
  EXPECT_EQ(text_of(read({0, 6, about->hash})), "012345");
  EXPECT_EQ(text_of(read({6, 6, about->hash})), "6789");
  EXPECT_EQ(text_of(read({10, 6, about->hash})), "");
  EXPECT_EQ(read({11, 6, about->hash}).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(checks_, 1);
}

TEST_F(Outgoing, FileThatHasChangedIsTold) {
  const Result<OutgoingPiece> about = read({0, 4, std::nullopt});
  ASSERT_TRUE(about);
  ASSERT_TRUE(files::write_file(file_, "abcdefghij"));
  const Result<OutgoingPiece> next = read({4, 4, about->hash});
  ASSERT_FALSE(next);
  EXPECT_EQ(next.error().code, Errc::kRefused);
  EXPECT_NE(next.error().message.find("'office' has changed"), std::string::npos) << next.error().message;
  EXPECT_EQ(text_of(read({4, 4, std::nullopt})), "efgh");
  EXPECT_EQ(checks_, 2);
}

TEST_F(Outgoing, DamagedFileIsNotGivenOut) {
  sound_ = fail(Errc::kCorrupt, "the map file is damaged");
  EXPECT_EQ(read({0, 4, std::nullopt}).error().code, Errc::kCorrupt);
  sound_ = {};
  EXPECT_TRUE(read({0, 4, std::nullopt})) << "it is checked again";
}

}  // namespace
}  // namespace seeker::store
