#include "common/digest/sha256.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/files/files.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::digest {
namespace {

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

TEST(Sha256, KnownSums) {  // FIPS 180-4, appendix B
  EXPECT_EQ(to_hex(sha256_of(bytes_of("abc"))), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(to_hex(sha256_of({})), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256, ComesToTheSameInPiecesAndFromAFile) {
  const testing::TemporaryFolder folder;
  const std::vector<std::uint8_t> bytes(700'001, 7);
  const std::span<const std::uint8_t> all(bytes);
  Sha256 sum;
  sum.add(all.first(1));
  sum.add(all.subspan(1, 300'000));
  sum.add(all.subspan(300'001));
  EXPECT_EQ(sum.finish(), sha256_of(bytes));
  ASSERT_TRUE(files::write_file(folder.path() / "file", bytes));
  EXPECT_EQ(sha256_of_file(folder.path() / "file").value(), sha256_of(bytes));
  EXPECT_EQ(sha256_of_file(folder.path() / "absent").error().code, Errc::kNotFound);
}

TEST(Sha256, IsKnownByItsLowerCaseDigitsAndTheirCount) {
  EXPECT_TRUE(is_sha256_hex(to_hex(sha256_of(bytes_of("abc")))));
  EXPECT_TRUE(is_sha256_hex("0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"));
  for (const std::string& other : {std::string(), std::string(63, 'a'), std::string(65, 'a'), std::string(64, 'A'),
                                   std::string(64, 'g'), std::string(63, 'a') + '\0', " " + std::string(63, 'a')}) {
    EXPECT_FALSE(is_sha256_hex(other)) << other;
  }
}

}  // namespace
}  // namespace seeker::digest
