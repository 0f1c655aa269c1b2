#include "server/store/write_ahead_log.hpp"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "common/core/rng.hpp"
#include "server/store/store.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

namespace fs = std::filesystem;

using testing::TemporaryFolder;

constexpr std::uint64_t kEvents = 30;

/// A database with its log, as a program that was killed leaves them: a copy of what another one has open.
void leave_journal(const fs::path& folder) {
  const TemporaryFolder open;
  Store store = Store::open(open.path()).value();
  ASSERT_TRUE(store.begin_mission({"m", "search", Blob{1}, 0, std::nullopt}));
  for (std::uint64_t k = 1; k <= kEvents; ++k) {
    ASSERT_TRUE(store.record_event({"m", k, 0, 0, "INFO", "cell-searched", std::string(50, 'x')}));
  }
  for (const char* name : {"seeker.db", "seeker.db-wal"}) {
    fs::copy(open.path() / name, folder / name, fs::copy_options::overwrite_existing);
  }
}

std::vector<std::uint8_t> content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(WriteAheadLog, WholeOneAndOneCutInItsLastTransactionForgetNoMoreThanThat) {
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(leave_journal(folder.path()));
  std::vector<std::uint8_t> log = content(folder.path() / "seeker.db-wal");
  ASSERT_GT(log.size(), 100'000U);
  EXPECT_EQ(forgotten_transactions(log), 0U);
  log[log.size() - 100] ^= 1U;
  EXPECT_EQ(forgotten_transactions(log), 1U);
  EXPECT_EQ(forgotten_transactions(std::span(log).first(10)), 0U);
  EXPECT_EQ(forgotten_transactions(std::vector<std::uint8_t>(10'000, 0xa5)), 0U) << "no log at all";
}

TEST(WriteAheadLog, BitThatFlipsAnywhereIsToldWhereMoreThanTheLastWriteIsGone) {
  constexpr std::uint64_t kLogSeed = 20261201;
  constexpr int kRounds = 150;
  Rng rng(kLogSeed);
  const TemporaryFolder whole;
  ASSERT_NO_FATAL_FAILURE(leave_journal(whole.path()));
  const std::vector<std::uint8_t> log = content(whole.path() / "seeker.db-wal");
  int told = 0;
  for (int round = 0; round < kRounds; ++round) {
    const TemporaryFolder folder;
    fs::copy(whole.path() / "seeker.db", folder.path() / "seeker.db");
    std::vector<std::uint8_t> altered = log;
    altered[rng.below(altered.size())] ^= static_cast<std::uint8_t>(1U << rng.below(8));
    std::ofstream(folder.path() / "seeker.db-wal", std::ios::binary)
        .write(reinterpret_cast<const char*>(altered.data()), static_cast<std::streamsize>(altered.size()));
    const Result<Store> store = Store::open(folder.path());
    ASSERT_TRUE(store) << store.error().message << ", round " << round << ", seed " << kLogSeed;
    const std::size_t kept = store->events("m").value().size();
    EXPECT_TRUE(kept + 1 >= kEvents || !store->lost().empty())
        << kept << " of " << kEvents << " events, round " << round << ", seed " << kLogSeed;
    told += store->lost().empty() ? 0 : 1;
  }
  EXPECT_GT(told, kRounds / 2);
}

}  // namespace
}  // namespace seeker::store
