#include <memory>

#include <gtest/gtest.h>

#include "common/core/rng.hpp"
#include "server/store/store.hpp"
#include "tests/unit/server/store/killed_writer.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

using testing::TemporaryFolder;

constexpr std::uint64_t kSeed = 20261121;

/// Writes events 1, 2, 3... with a setting after each.
class EventWriter {
 public:
  explicit EventWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  bool operator()(std::uint64_t n) {
    if (!store_) {
      store_ = std::make_shared<Result<Store>>(Store::open(folder_));
      if (!*store_ || !(*store_)->begin_mission({"m", "search", Blob(100, 1), 0, std::nullopt})) {
        return false;
      }
    }
    const auto byte = static_cast<std::uint8_t>(n);
    return (*store_)->record_event({"m", n, 0, 0, "INFO", "cell-searched", std::string(50, 'x')}).has_value() &&
           (*store_)->put("state", Blob(20000, byte)).has_value();
  }

 private:
  std::filesystem::path folder_;
  std::shared_ptr<Result<Store>> store_;
};

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
    const auto state = store->get("state");
    ASSERT_TRUE(state && state->has_value());
    ASSERT_GE((*state)->front(), static_cast<std::uint8_t>(told));
    ASSERT_EQ(**state, Blob(20000, (*state)->front())) << "half a setting";
  }
}

TEST(Store, KilledAtAnyPointHoldsAPrefixOfWhatWasWritten) {
  Rng rng(kSeed);
  RecordProperty("seed", std::to_string(kSeed));
  constexpr int kKills = 25;
  for (int round = 0; round < kKills; ++round) {
    const TemporaryFolder folder;
    const std::uint64_t told =
        testing::kill_a_writer(EventWriter(folder.path()), 1 + rng.below(12), rng.below(3'000'000));
    ASSERT_NO_FATAL_FAILURE(expect_a_prefix(folder.path(), told)) << "round " << round << ", seed " << kSeed;
  }
}

}  // namespace
}  // namespace seeker::store
