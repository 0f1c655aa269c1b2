#include "server/app/state/journal_writer.hpp"

#include <atomic>
#include <future>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::app {
namespace {

store::EventRecord event(std::uint64_t sequence) {
  return {"round", sequence, 0, std::nullopt, "INFO", "cell-searched", ""};
}

JournalWriter::Write record(std::uint64_t sequence) {
  return [sequence](store::Store& store) { return store.record_event(event(sequence)); };
}

/// A disk that takes nothing until it is told to; this side of the store, as an error of the store's would be.
class MoodyDisk {
 public:
  [[nodiscard]] JournalWriter::Write with(JournalWriter::Write write) const {
    return [this, write = std::move(write)](store::Store& store) -> Status {
      return full_ ? fail(Errc::kIo, "no space is left") : write(store);
    };
  }
  void fill() { full_ = true; }
  void free() { full_ = false; }

 private:
  std::atomic<bool> full_{false};
};

class JournalWriterTest : public ::testing::Test {
 protected:
  std::vector<std::uint64_t> kept() {
    writer.finish();
    std::vector<std::uint64_t> sequences;
    const std::vector<store::EventRecord> events = store.events("round").value();
    for (const store::EventRecord& one : events) {
      sequences.push_back(one.sequence);
    }
    return sequences;
  }

  const testing::TemporaryFolder folder;
  store::Store store = store::Store::open(folder.path()).value();
  MoodyDisk disk;
  JournalWriter writer{store};
};

TEST_F(JournalWriterTest, TellsInOrderWhenAllBeforeIsKept) {
  std::vector<int> told;
  std::promise<Status> last;
  for (int k = 0; k < 5; ++k) {
    writer.write(record(static_cast<std::uint64_t>(k)), [&, k](const Status& status) {
      EXPECT_TRUE(status);
      told.push_back(k);
    });
  }
  writer.write(nullptr, [&](const Status& status) { last.set_value(status); });
  EXPECT_TRUE(last.get_future().get());
  EXPECT_EQ(told, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(kept().size(), 5U);
}

TEST_F(JournalWriterTest, FullDiskIsToldAtOnceAndWhatWaitsIsWrittenWhenThereIsSpaceAgain) {
  std::promise<std::string> failing;
  std::promise<void> again;
  writer.set_watch({.failing = [&](const Error& error) { failing.set_value(error.message); },
                    .writes_again = [&] { again.set_value(); },
                    .lost = [](const Error& error) { ADD_FAILURE() << error.message; }});
  disk.fill();
  std::promise<Status> first;
  std::promise<Status> second;
  writer.write(disk.with(record(1)), [&](const Status& status) { first.set_value(status); });
  EXPECT_FALSE(first.get_future().get());
  EXPECT_EQ(failing.get_future().get(), "no space is left") << "once: a promise takes no second one";
  writer.write(disk.with(record(2)), [&](const Status& status) { second.set_value(status); });
  EXPECT_FALSE(second.get_future().get()) << "asked for while the disk takes nothing";
  disk.free();
  again.get_future().get();
  EXPECT_EQ(kept(), (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(JournalWriterTest, NewestOfTwoUrgentRecordsWinsOverAFullDisk) {
  const auto put = [this](std::uint8_t value) {
    return disk.with([value](store::Store& to) { return to.put("estop", store::Blob{value}); });
  };
  std::promise<void> again;
  writer.set_watch({.failing = {}, .writes_again = [&] { again.set_value(); }, .lost = {}});
  disk.fill();
  std::promise<Status> first;
  writer.write_first(put(1), [&](const Status& status) { first.set_value(status); });
  EXPECT_FALSE(first.get_future().get());
  writer.write_first(put(0), nullptr);
  disk.free();
  again.get_future().get();
  writer.finish();
  EXPECT_EQ(store.get("estop").value(), store::Blob{0});
}

TEST_F(JournalWriterTest, RecordThatTheStoreRefusesKeepsNoOtherFromBeingWritten) {
  std::vector<std::string> lost;
  writer.set_watch({.failing = [](const Error& error) { ADD_FAILURE() << error.message; },
                    .writes_again = {},
                    .lost = [&](const Error& error) { lost.push_back(error.message); }});
  writer.write(record(1), nullptr);
  for (int k = 0; k < 2; ++k) {
    writer.write([](store::Store& to) { return to.end_mission("never-begun", {}); },
                 [](const Status& status) { EXPECT_FALSE(status); });
  }
  writer.write(record(2), [](const Status& status) { EXPECT_TRUE(status); });
  EXPECT_EQ(kept(), (std::vector<std::uint64_t>{1, 2}));
  ASSERT_EQ(lost.size(), 1U) << "what follows from the first one hides the cause";
  EXPECT_NE(lost.front().find("never-begun"), std::string::npos) << lost.front();
}

TEST_F(JournalWriterTest, DiskThatDoesNotFollowLosesTheOldestWhichIsTold) {
  constexpr std::uint64_t kMany = 10'100;
  std::promise<void> goes_on;
  std::promise<std::string> lost;
  std::atomic<std::uint64_t> told{0};
  writer.set_watch(
      {.failing = {}, .writes_again = {}, .lost = [&](const Error& error) { lost.set_value(error.message); }});
  std::promise<void> begun;
  writer.write(
      [&](store::Store& /*store*/) -> Status {
        begun.set_value();
        goes_on.get_future().wait();
        return {};
      },
      nullptr);
  begun.get_future().wait();
  for (std::uint64_t k = 1; k <= kMany; ++k) {
    writer.write(record(k), [&](const Status& /*status*/) { ++told; });
  }
  EXPECT_EQ(writer.health().dropped, kMany - 10'000);
  goes_on.set_value();
  EXPECT_NE(lost.get_future().get().find("10000"), std::string::npos);
  EXPECT_EQ(kept().back(), kMany);
  EXPECT_EQ(told, kMany) << "who waits for an answer gets one";
}

TEST_F(JournalWriterTest, AtTheEndAFullDiskIsTriedOnceMore) {
  disk.fill();
  std::promise<Status> first;
  writer.write(disk.with(record(1)), [&](const Status& status) { first.set_value(status); });
  EXPECT_FALSE(first.get_future().get());
  disk.free();
  EXPECT_EQ(kept(), (std::vector<std::uint64_t>{1}));
  std::promise<Status> late;
  writer.write(record(2), [&](const Status& status) { late.set_value(status); });
  EXPECT_FALSE(late.get_future().get()) << "after the end";
}

}  // namespace
}  // namespace seeker::app
