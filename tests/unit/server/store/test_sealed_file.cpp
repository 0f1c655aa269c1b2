#include "server/store/sealed_file.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/files/files.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

using Bytes = std::vector<std::uint8_t>;

RC_GTEST_PROP(SealedFile, AnyContentComesOutAsItWentIn, (const Bytes& content)) {
  RC_ASSERT(unseal("place", seal("place", content)).value() == content);
}

RC_GTEST_PROP(SealedFile, EveryAlteredByteIsNoticed, (const Bytes& content, std::uint8_t flip)) {
  Bytes bytes = seal("place", content);
  const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
  bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ std::max<std::uint8_t>(flip, 1));
  RC_ASSERT(!unseal("place", bytes).has_value());
}

RC_GTEST_PROP(SealedFile, EveryCutIsNoticed, (const Bytes& content)) {
  Bytes bytes = seal("place", content);
  bytes.resize(*rc::gen::inRange<std::size_t>(0, bytes.size()));
  RC_ASSERT(!unseal("place", bytes).has_value());
}

TEST(SealedFile, TellsWhatIsWrong) {
  Bytes newer = seal("place", {});
  newer[8] = 2;
  EXPECT_EQ(unseal("place", newer).error().code, Errc::kUnsupportedVersion);
  EXPECT_EQ(unseal("place", Bytes(40, 7)).error().code, Errc::kParse);
  EXPECT_EQ(unseal("place", seal("topology", {})).error().code, Errc::kParse);
  Bytes cut = seal("place", Bytes{1, 2, 3});
  cut.pop_back();
  EXPECT_EQ(unseal("place", cut).error().code, Errc::kCorrupt);
}

TEST(SealedFile, IsWrittenIntoAFolderThatItMakes) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "new" / "a.place";
  EXPECT_EQ(read_sealed_file(path, "place", 100).error().code, Errc::kNotFound);
  ASSERT_TRUE(write_sealed_file(path, "place", "here"));
  EXPECT_EQ(read_sealed_file(path, "place", 100).value(), (Bytes{'h', 'e', 'r', 'e'}));
  EXPECT_EQ(read_sealed_file(path, "place", 10).error().code, Errc::kTooLarge);
  ASSERT_TRUE(files::write_file(path, "garbage"));
  EXPECT_NE(read_sealed_file(path, "place", 100).error().message.find("a.place"), std::string::npos);
}

TEST(SealedFile, OneThatNeedNotOutliveAPowerCutIsReplacedAsAWholeToo) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "a.place";
  ASSERT_TRUE(write_sealed_file(path, "place", "the first, which is longer"));
  ASSERT_TRUE(write_sealed_file(path, "place", "here", files::Outlives::kItsProgram));
  EXPECT_EQ(read_sealed_file(path, "place", 100).value(), (Bytes{'h', 'e', 'r', 'e'}));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "no temporary file is left";
}

}  // namespace
}  // namespace seeker::store
