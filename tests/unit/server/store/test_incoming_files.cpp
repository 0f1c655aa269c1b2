#include "server/store/incoming_files.hpp"

#include <chrono>
#include <fstream>

#include <gtest/gtest.h>

#include "common/core/rng.hpp"
#include "common/files/files.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/random_bytes.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

namespace fs = std::filesystem;
using testing::random_bytes;
using testing::TemporaryFolder;

std::span<const std::uint8_t> part(const std::vector<std::uint8_t>& bytes, std::size_t from, std::size_t count) {
  return std::span(bytes).subspan(from, count);
}

TEST(IncomingName, IsReadBackAsItWasWritten) {
  const std::string hash(64, 'a');
  for (const IncomingName& name : {IncomingName{hash, 0, true}, IncomingName{hash, 12345, false}}) {
    EXPECT_EQ(parse_incoming_name(to_string(name)), name) << to_string(name);
  }
  for (const std::string& other :
       {std::string(), std::string(63, 'a'), std::string(64, 'g'), std::string(64, 'A'), hash + "-.part",
        hash + "-0.part", hash + "-07.part", hash + "-5", hash + "-99999999999999999999.part", hash + ".part"}) {
    EXPECT_EQ(parse_incoming_name(other), std::nullopt) << other;
  }
}

TEST(ToDrop, TakesThoseThatWereNotUsedForLongestAndNoMoreThanNeeded) {
  const std::vector<IncomingEntry> entries{{"new", 40, 30}, {"old", 30, 10}, {"middle", 20, 20}};
  using Names = std::vector<std::string>;
  EXPECT_EQ(to_drop(entries, 10, {100, 9}), Names{});
  EXPECT_EQ(to_drop(entries, 11, {100, 9}), Names{"old"});
  EXPECT_EQ(to_drop(entries, 50, {100, 9}), (Names{"old", "middle"}));
  EXPECT_EQ(to_drop(entries, 1, {100, 3}), Names{"old"}) << "too many";
  EXPECT_EQ(to_drop({}, 1, {100, 1}), Names{});
}

class Incoming : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path folder() const { return folder_.path() / "incoming"; }
  /// Files that are not used are older than those that are.
  void age(const digest::Sha256Sum& hash, int hours) const {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder())) {
      if (entry.path().filename().string().starts_with(digest::to_hex(hash))) {
        fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::hours(hours));
      }
    }
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder()), {}));
  }

  TemporaryFolder folder_;
  std::vector<std::uint8_t> bytes_ = random_bytes(1, 1000);
  digest::Sha256Sum hash_ = digest::sha256_of(bytes_);
};

TEST_F(Incoming, GoesOnAfterARestartOfTheProgramAndIsWholeInTheEnd) {
  {
    IncomingFiles first(folder());
    EXPECT_EQ(first.begin(hash_, 1000), 0U);
    EXPECT_EQ(first.append(hash_, 0, part(bytes_, 0, 400)), 400U);
    EXPECT_EQ(first.whole(hash_).error().code, Errc::kNotFound) << "it is not whole";
  }
  IncomingFiles second(folder());
  EXPECT_EQ(second.begin(hash_, 1000), 400U);
  EXPECT_EQ(second.append(hash_, 400, part(bytes_, 400, 600)), 1000U);
  const Result<fs::path> whole = second.whole(hash_);
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(files::read_file(*whole).value(), bytes_);
  EXPECT_EQ(IncomingFiles(folder()).begin(hash_, 1000), 1000U) << "nothing is left to be sent";
  EXPECT_EQ(files(), 1U);
}

TEST_F(Incoming, RepeatedPiecesChangeNothingAndOverlappingOnesAddTheirRest) {
  IncomingFiles incoming(folder());
  ASSERT_TRUE(incoming.begin(hash_, 1000));
  EXPECT_EQ(incoming.append(hash_, 0, part(bytes_, 0, 400)), 400U);
  EXPECT_EQ(incoming.append(hash_, 0, part(bytes_, 0, 400)), 400U);
  EXPECT_EQ(incoming.append(hash_, 100, part(bytes_, 100, 100)), 400U);
  EXPECT_EQ(incoming.append(hash_, 300, part(bytes_, 300, 700)), 1000U);
  EXPECT_EQ(incoming.append(hash_, 300, part(bytes_, 300, 700)), 1000U) << "its answer was lost";
  EXPECT_TRUE(incoming.whole(hash_));
}

TEST_F(Incoming, GapsAndBytesBeyondTheSizeAreRefused) {
  IncomingFiles incoming(folder());
  EXPECT_EQ(incoming.append(hash_, 0, part(bytes_, 0, 1)).error().code, Errc::kNotFound);
  ASSERT_TRUE(incoming.begin(hash_, 1000));
  ASSERT_TRUE(incoming.append(hash_, 0, part(bytes_, 0, 400)));
  const Result<std::uint64_t> gap = incoming.append(hash_, 401, part(bytes_, 401, 1));
  ASSERT_FALSE(gap);
  EXPECT_EQ(gap.error().code, Errc::kRefused);
  EXPECT_NE(gap.error().message.find("400"), std::string::npos) << gap.error().message;
  const std::vector<std::uint8_t> long_one(601);
  EXPECT_EQ(incoming.append(hash_, 400, long_one).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(incoming.append(hash_, ~std::uint64_t{0}, long_one).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(incoming.begin(hash_, 1000), 400U) << "what was here stays";
  EXPECT_EQ(incoming.begin(hash_, 0).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(incoming.begin(hash_, 999), 0U) << "another size is another file";
  EXPECT_EQ(files(), 1U);
}

TEST_F(Incoming, FileWithAnotherHashIsDeleted) {
  IncomingFiles incoming(folder());
  ASSERT_TRUE(incoming.begin(hash_, 1000));
  const std::vector<std::uint8_t> wrong = random_bytes(2, 1000);
  const Result<std::uint64_t> taken = incoming.append(hash_, 0, wrong);
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().code, Errc::kCorrupt);
  EXPECT_EQ(files(), 0U);
  EXPECT_EQ(incoming.begin(hash_, 1000), 0U);
}

TEST_F(Incoming, PartThatWasCompleteWhenTheProgramEndedIsChecked) {
  IncomingFiles incoming(folder());
  ASSERT_TRUE(incoming.begin(hash_, 1000));
  std::ofstream(folder() / to_string(IncomingName{digest::to_hex(hash_), 1000, false}), std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes_.data()), 1000);
  EXPECT_EQ(incoming.begin(hash_, 1000), 1000U);
  EXPECT_TRUE(incoming.whole(hash_));
}

TEST_F(Incoming, WholeFileThatWasDamagedOnTheDiskIsDeleted) {
  IncomingFiles incoming(folder());
  ASSERT_TRUE(incoming.begin(hash_, 1000));
  ASSERT_TRUE(incoming.append(hash_, 0, bytes_));
  EXPECT_EQ(incoming.begin(hash_, 999).error().code, Errc::kInvalidArgument);
  std::ofstream(folder() / digest::to_hex(hash_)) << "something else";
  EXPECT_EQ(incoming.whole(hash_).error().code, Errc::kCorrupt);
  EXPECT_EQ(files(), 0U);
}

TEST_F(Incoming, OldFilesMakeRoomForNewOnes) {
  IncomingFiles incoming(folder(), {2500, 10});
  const digest::Sha256Sum second = digest::sha256_of(random_bytes(2, 1000));
  const digest::Sha256Sum third = digest::sha256_of(random_bytes(3, 1000));
  ASSERT_TRUE(incoming.begin(hash_, 1000));
  ASSERT_TRUE(incoming.append(hash_, 0, part(bytes_, 0, 400)));
  ASSERT_TRUE(incoming.begin(second, 1000));
  age(hash_, 2);
  age(second, 1);
  ASSERT_TRUE(incoming.begin(third, 1000));
  EXPECT_EQ(files(), 2U);
  EXPECT_EQ(incoming.append(hash_, 400, part(bytes_, 400, 1)).error().code, Errc::kNotFound);
  EXPECT_EQ(incoming.append(second, 0, part(bytes_, 0, 1)), 1U);
  EXPECT_EQ(incoming.begin(hash_, 2501).error().code, Errc::kTooLarge);
  EXPECT_EQ(files(), 2U);
}

TEST_F(Incoming, FullDiskIsToldWithItsRemedyAndKeepsWhatHasArrived) {
  IncomingFiles incoming(folder());
  ASSERT_TRUE(incoming.begin(hash_, 1000));
  ASSERT_TRUE(incoming.append(hash_, 0, part(bytes_, 0, 400)));
  {
    const testing::FileSizeLimit full(500);
    const Result<std::uint64_t> taken = incoming.append(hash_, 400, part(bytes_, 400, 600));
    ASSERT_FALSE(taken);
    EXPECT_EQ(taken.error().code, Errc::kIo);
    EXPECT_NE(taken.error().message.find("free space"), std::string::npos) << taken.error().message;
  }
  EXPECT_EQ(incoming.begin(hash_, 1000), 400U);
  EXPECT_EQ(incoming.append(hash_, 400, part(bytes_, 400, 600)), 1000U);
}

}  // namespace
}  // namespace seeker::store
