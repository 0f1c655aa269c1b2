#include <csignal>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/core/rng.hpp"
#include "server/store/store.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

using testing::TemporaryFolder;

constexpr std::uint64_t kSeed = 20261121;

/// Writes events 1, 2, 3... with a checkpoint after each, telling the number of each on `progress` once it is written.
[[noreturn]] void write_until_killed(const std::filesystem::path& folder, int progress) {
  Result<Store> store = Store::open(folder);
  if (!store || !store->begin_mission({"m", "search", Blob(100, 1), 0, std::nullopt})) {
    _exit(1);
  }
  for (std::uint64_t n = 1;; ++n) {
    const auto byte = static_cast<std::uint8_t>(n);
    if (!store->record_event({"m", n, 0, 0, "INFO", "cell-searched", std::string(50, 'x')}) ||
        !store->save_checkpoint("m", {static_cast<std::int64_t>(n), Blob(20000, byte)}) ||
        ::write(progress, &byte, 1) != 1) {
      _exit(1);
    }
  }
}

/// Starts a writer, kills it after it told of `steps` writes and `extra` more turns of a busy wait; returns how many
/// writes it had told of in the end.
std::uint64_t kill_a_writer(const std::filesystem::path& folder, std::uint64_t steps, std::uint64_t extra) {
  int pipe_ends[2];
  EXPECT_EQ(::pipe(pipe_ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe_ends[0]);
    write_until_killed(folder, pipe_ends[1]);
  }
  ::close(pipe_ends[1]);
  std::uint64_t told = 0;
  char byte = 0;
  while (told < steps && ::read(pipe_ends[0], &byte, 1) == 1) {
    ++told;
  }
  // Lands the kill anywhere inside the next write; how long a turn takes does not matter.
  volatile std::uint64_t turns = 0;
  while (turns < extra) {
    turns = turns + 1;
  }
  EXPECT_EQ(::kill(child, SIGKILL), 0);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the writer failed by itself";
  while (::read(pipe_ends[0], &byte, 1) == 1) {
    ++told;
  }
  ::close(pipe_ends[0]);
  return told;
}

void expect_a_prefix(const std::filesystem::path& folder, std::uint64_t told) {
  const Result<Store> store = Store::open(folder);
  ASSERT_TRUE(store) << store.error().message;
  const auto events = store->events("m");
  ASSERT_TRUE(events) << events.error().message;
  ASSERT_GE(events->size(), told) << "a write that was told is lost";
  ASSERT_LE(events->size(), told + 1);
  for (std::uint64_t i = 0; i < events->size(); ++i) {
    ASSERT_EQ((*events)[i].sequence, i + 1);
  }
  const auto unfinished = store->unfinished_mission();
  ASSERT_TRUE(unfinished) << unfinished.error().message;
  ASSERT_TRUE(unfinished->has_value());
  if (told > 0) {
    ASSERT_TRUE((*unfinished)->checkpoint.has_value());
    const Checkpoint& checkpoint = *(*unfinished)->checkpoint;
    ASSERT_GE(checkpoint.robot_time_ns, static_cast<std::int64_t>(told));
    ASSERT_EQ(checkpoint.journal, Blob(20000, static_cast<std::uint8_t>(checkpoint.robot_time_ns)));
  }
}

TEST(Store, KilledAtAnyPointHoldsAPrefixOfWhatWasWritten) {
  Rng rng(kSeed);
  RecordProperty("seed", std::to_string(kSeed));
  constexpr int kKills = 25;
  for (int round = 0; round < kKills; ++round) {
    const TemporaryFolder folder;
    const std::uint64_t told = kill_a_writer(folder.path(), 1 + rng.below(12), rng.below(3'000'000));
    ASSERT_NO_FATAL_FAILURE(expect_a_prefix(folder.path(), told)) << "round " << round << ", seed " << kSeed;
  }
}

}  // namespace
}  // namespace seeker::store
