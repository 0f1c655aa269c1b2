// What the store has acknowledged is there after a power cut, at whatever write it comes.

#include <memory>

#include <gtest/gtest.h>

#include "server/store/store.hpp"
#include "tests/support/random_bytes.hpp"
#include "tests/unit/server/store/power_cut_disk.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

using testing::PowerCutDisk;
using testing::TemporaryFolder;

constexpr std::uint64_t kPowerSeed = 20261128;
/// More than fill the log beside the database, so that it is written into it on the way.
constexpr std::uint64_t kSteps = 50;
constexpr std::uint64_t kStepsOfOneProgram = 45;

/// Of one step; does not compress.
Blob content_of(std::uint64_t step) {
  constexpr std::size_t kBytes = 100'000;
  return testing::random_bytes(step, kBytes);
}

/// Writes event and setting 1, 2, 3... as one program after the other would; `told` counts what was acknowledged.
void write_steps(const std::filesystem::path& folder, const std::function<bool()>& over, std::uint64_t& told) {
  std::optional<Result<Store>> store;
  for (std::uint64_t step = 1; step <= kSteps && !over(); ++step) {
    if (step % kStepsOfOneProgram == 1) {
      store.reset();
      store.emplace(Store::open(folder));
      ASSERT_TRUE(*store) << store->error().message;
      ASSERT_TRUE((*store)->begin_mission({"m", "search", Blob(100, 1), 0, std::nullopt}));
    }
    ASSERT_TRUE((*store)->together([&] {
      const Status event = (*store)->record_event({"m", step, 0, 0, "INFO", "cell-searched", std::string(50, 'x')});
      return event ? (*store)->put("step", content_of(step)) : event;
    }));
    told = step;
  }
}

void expect_what_was_told(const std::filesystem::path& folder, std::uint64_t told) {
  const Result<Store> store = Store::open(folder);
  ASSERT_TRUE(store) << store.error().message;
  ASSERT_TRUE(store->lost().empty() || told == 0) << store->lost();
  const auto events = store->events("m");
  ASSERT_TRUE(events) << events.error().message;
  ASSERT_GE(events->size(), told) << "a write that was told is lost";
  ASSERT_LE(events->size(), told + 1);
  const auto kept = store->get("step");
  ASSERT_TRUE(kept) << kept.error().message;
  ASSERT_EQ(kept->has_value(), !events->empty());
  if (!events->empty()) {
    ASSERT_EQ(events->back().sequence, events->size());
    ASSERT_EQ(**kept, content_of(events->size())) << "half of what was written together";
  }
  const auto unfinished = store->unfinished_mission();
  ASSERT_TRUE(unfinished) << unfinished.error().message;
  ASSERT_TRUE(unfinished->has_value() || told == 0);
}

TEST(Store, PowerCutAtAnyWriteHoldsWhatWasAcknowledged) {
  constexpr int kCuts = 250;
  constexpr std::uint64_t kMostOperations = 3200;  // more than a writer asks for: some cuts come after the end
  Rng rng(kPowerSeed);
  RecordProperty("seed", std::to_string(kPowerSeed));
  int cut = 0;
  for (int round = 0; round < kCuts; ++round) {
    const TemporaryFolder before;
    const TemporaryFolder after;
    std::uint64_t told = 0;
    std::uint64_t told_at_cut = 0;
    {
      PowerCutDisk disk;
      disk.cut_after(1 + rng.below(kMostOperations), [&] { told_at_cut = told; });
      ASSERT_NO_FATAL_FAILURE(write_steps(
          before.path(), [&] { return disk.was_cut(); }, told));
      if (!disk.was_cut()) {
        continue;
      }
      disk.restore(after.path(), rng);
    }
    ++cut;
    ASSERT_NO_FATAL_FAILURE(expect_what_was_told(after.path(), told_at_cut))
        << "round " << round << ", seed " << kPowerSeed;
  }
  EXPECT_GT(cut, kCuts / 2);
  RecordProperty("cuts", cut);
}

}  // namespace
}  // namespace seeker::store
