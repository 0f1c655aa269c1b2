#include "server/app/maps/segment_log.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/maps/random_map.hpp"

namespace seeker::app {
namespace {

/// A client that only knows what the updates tell.
struct Mirror {
  std::map<std::uint64_t, MapSegment> segments;
  std::uint64_t revision = 0;

  void apply(const api::SegmentUpdate& update) {
    for (const api::SegmentUpdate& part : api::split(update)) {
      if (part.full) {
        segments.clear();
      }
      for (const std::uint64_t id : part.removed) {
        segments.erase(id);
      }
      for (const MapSegment& segment : part.changed) {
        segments[segment.id] = segment;
      }
      revision = part.revision;
    }
  }
  [[nodiscard]] std::vector<MapSegment> all() const {
    std::vector<MapSegment> out;
    for (const auto& [id, segment] : segments) {
      out.push_back(segment);
    }
    return out;
  }
};

TEST(SegmentLog, NothingChangedIsNoRevision) {
  SegmentLog log;
  const std::vector<MapSegment> room = testing::room_map().segments;
  EXPECT_FALSE(log.take({}, 0));
  EXPECT_TRUE(log.take(room, 0));
  EXPECT_FALSE(log.take(room, 0));
  EXPECT_EQ(log.revision(), 1U);
  EXPECT_TRUE(log.since(1).changed.empty());
  EXPECT_FALSE(log.since(1).full);
}

TEST(SegmentLog, TellsOnlyWhatChangedAndWhatIsGone) {
  SegmentLog log;
  std::vector<MapSegment> room = testing::room_map().segments;
  ASSERT_TRUE(log.take(room, 0));
  room[1].length_m += 0.5;
  room.erase(room.begin());
  ASSERT_TRUE(log.take(room, 0));
  const api::SegmentUpdate update = log.since(1);
  EXPECT_FALSE(update.full);
  ASSERT_EQ(update.changed.size(), 1U);
  EXPECT_EQ(update.changed.front().id, 2U);
  EXPECT_EQ(update.removed, std::vector<std::uint64_t>{1});
}

TEST(SegmentLog, NewEpochVoidsAllThatWasSent) {
  SegmentLog log;
  const std::vector<MapSegment> room = testing::room_map().segments;
  ASSERT_TRUE(log.take(room, 3));
  ASSERT_TRUE(log.take(room, 4));
  const api::SegmentUpdate update = log.since(1);
  EXPECT_TRUE(update.full);
  EXPECT_EQ(update.map_epoch, 4U);
  EXPECT_EQ(update.changed.size(), room.size());
}

TEST(SegmentLog, RevisionOfAnotherRunAndForgottenRemovalsGetAllOfIt) {
  SegmentLog log({.removals = 1});
  std::vector<MapSegment> room = testing::room_map().segments;
  ASSERT_TRUE(log.take(room, 0));
  EXPECT_TRUE(log.since(99).full);
  room.erase(room.begin(), room.begin() + 2);
  ASSERT_TRUE(log.take(room, 0));
  EXPECT_TRUE(log.since(1).full) << "two are gone, one removal is kept";
  room.erase(room.begin());
  ASSERT_TRUE(log.take(room, 0));
  EXPECT_FALSE(log.since(2).full);
  EXPECT_EQ(log.since(2).removed, std::vector<std::uint64_t>{3});
}

RC_GTEST_PROP(SegmentLog, ClientThatAsksNowAndThenHasTheMapOfTheRobot, (std::uint64_t seed)) {
  Rng rng(seed);
  SegmentLog log({.removals = 5});
  Mirror mirror;
  std::map<std::uint64_t, MapSegment> truth;
  const std::vector<MapSegment> pool = testing::random_map(rng, {.nodes = 2, .segments = 12}).segments;
  std::uint32_t epoch = 0;
  for (int step = 0; step < 40; ++step) {
    for (std::uint64_t k = rng.below(4); k > 0; --k) {
      const MapSegment& any = pool[rng.below(pool.size())];
      if (truth.erase(any.id) == 0 || rng.below(2) == 0) {
        truth[any.id] = any;
        truth[any.id].hits = static_cast<std::uint32_t>(rng.below(3));
      }
    }
    epoch += rng.below(10) == 0 ? 1 : 0;
    std::vector<MapSegment> now;
    for (const auto& [id, segment] : truth) {
      now.push_back(segment);
    }
    static_cast<void>(log.take(now, epoch));
    if (rng.below(3) == 0) {
      mirror.apply(log.since(mirror.revision));
      RC_ASSERT(mirror.all() == now);
      RC_ASSERT(mirror.revision == log.revision());
    }
  }
}

TEST(SegmentUpdate, PartsAreBoundedAndOnlyTheFirstIsFull) {
  api::SegmentUpdate update;
  update.full = true;
  update.revision = 7;
  update.changed.resize(api::kMaxSegmentsPerUpdate + 10);
  update.removed.resize(20);
  const std::vector<api::SegmentUpdate> parts = api::split(update);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_TRUE(parts[0].full);
  EXPECT_FALSE(parts[1].full);
  EXPECT_EQ(parts[0].removed.size() + parts[0].changed.size(), api::kMaxSegmentsPerUpdate);
  EXPECT_EQ(parts[1].changed.size(), 30U);
  EXPECT_EQ(api::split({}).size(), 1U);
}

}  // namespace
}  // namespace seeker::app
