#include "server/app/runtime/background.hpp"

#include <future>
#include <stdexcept>

#include <gtest/gtest.h>

#include "server/app/runtime/disk_worker.hpp"

namespace seeker::app {
namespace {

TEST(Background, InlineTheAnswerIsThereAtOnce) {
  Background<int> work(true, "it failed");
  EXPECT_FALSE(work.busy());
  work.start([] { return Result<int>(3); });
  EXPECT_TRUE(work.busy());
  EXPECT_EQ(work.take()->value(), 3);
  EXPECT_FALSE(work.busy());
  EXPECT_FALSE(work.take());
}

TEST(Background, OnAWorkerItIsBusyUntilTheAnswerWasTaken) {
  Background<int> work(false, "it failed");
  std::promise<void> begun;
  std::promise<void> go_on;
  work.start([&] {
    begun.set_value();
    go_on.get_future().wait();
    return Result<int>(4);
  });
  begun.get_future().wait();
  EXPECT_TRUE(work.busy());
  EXPECT_FALSE(work.take());
  go_on.set_value();
  std::optional<Result<int>> answer;
  while (!answer) {
    answer = work.take();
  }
  EXPECT_EQ(answer->value(), 4);
  EXPECT_FALSE(work.busy());
}

TEST(Background, WhatIsThrownIsAnErrorWithItsName) {
  for (const bool inline_mode : {true, false}) {
    Background<int> work(inline_mode, "the picture could not be looked at");
    work.start([]() -> Result<int> { throw std::runtime_error("no memory"); });
    std::optional<Result<int>> answer;
    while (!answer) {
      answer = work.take();
    }
    EXPECT_EQ(answer->error(), (Error{Errc::kInternal, "the picture could not be looked at: no memory"}));
  }
}

TEST(Background, ItsEndWaitsForTheWork) {
  std::promise<void> begun;
  bool done = false;
  {
    Background<int> work(false, "it failed");
    work.start([&] {
      begun.set_value();
      done = true;
      return Result<int>(1);
    });
    begun.get_future().wait();
  }
  EXPECT_TRUE(done);
}

TEST(DiskWorker, DoesEverythingInOrderBeforeItEnds) {
  std::vector<int> done;
  {
    DiskWorker disk(100, "maps");
    for (int n = 0; n < 50; ++n) {
      ASSERT_TRUE(disk.post([&done, n] { done.push_back(n); }));
    }
  }
  ASSERT_EQ(done.size(), 50U);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
}

TEST(DiskWorker, MoreThanItsLimitIsRefusedWithTheReason) {
  std::promise<void> begun;
  std::promise<void> go_on;
  DiskWorker disk(2, "maps");  // ends first: its thread still looks at the promises
  ASSERT_TRUE(disk.post([&] {
    begun.set_value();
    go_on.get_future().wait();
  }));
  begun.get_future().wait();
  EXPECT_TRUE(disk.post([] {}));
  EXPECT_TRUE(disk.post([] {}));
  const Status refused = disk.post([] {});
  EXPECT_EQ(refused.error(), (Error{Errc::kBusy, "too many maps are being read and written; try again"}));
  go_on.set_value();
}

}  // namespace
}  // namespace seeker::app
