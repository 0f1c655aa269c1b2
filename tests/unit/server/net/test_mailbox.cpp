#include <gtest/gtest.h>

#include "server/net/mailbox.hpp"

namespace seeker::server_net {
namespace {

api::UpdatePtr update(api::Topic topic, std::uint64_t sequence, api::Payload payload) {
  auto out = std::make_shared<api::Update>();
  out->topic = topic;
  out->sequence = sequence;
  out->payload = std::move(payload);
  return out;
}

api::UpdatePtr tile(std::uint64_t sequence, int i, std::uint32_t epoch = 0) {
  OccupancyTile one;
  one.index = {i, 0};
  one.revision = sequence;
  return update(api::Topic::kTiles, sequence, api::TileUpdate{sequence, epoch, {one}});
}

TEST(Mailbox, OnlyTheFirstPushAfterADrainAsksForOne) {
  Mailbox box(10);
  EXPECT_TRUE(box.push(update(api::Topic::kEvent, 1, api::Event{})));
  EXPECT_FALSE(box.push(update(api::Topic::kEvent, 2, api::Event{})));
  EXPECT_EQ(box.drain().size(), 2U);
  EXPECT_TRUE(box.push(update(api::Topic::kEvent, 3, api::Event{})));
}

TEST(Mailbox, KeepsTheNewestOfALatestTopicAndAllOfAReliableOne) {
  Mailbox box(10);
  for (std::uint64_t k = 1; k <= 3; ++k) {
    (void)box.push(update(api::Topic::kStatus, k, api::RobotStatus{}));
    (void)box.push(update(api::Topic::kMission, k, api::MissionStatus{}));
  }
  const auto out = box.drain();
  ASSERT_EQ(out.size(), 4U);
  EXPECT_EQ(out[2]->sequence, 3U);
  EXPECT_EQ(out[3]->topic, api::Topic::kStatus);
  EXPECT_EQ(out[3]->sequence, 3U);
}

TEST(Mailbox, JoinsTilesAndKeepsTheNewestOfEach) {
  Mailbox box(10);
  (void)box.push(tile(1, 0));
  (void)box.push(tile(2, 1));
  (void)box.push(tile(3, 0));
  const auto out = box.drain();
  ASSERT_EQ(out.size(), 1U);
  const auto& tiles = std::get<api::TileUpdate>(out.front()->payload);
  EXPECT_EQ(tiles.revision, 3U);
  ASSERT_EQ(tiles.tiles.size(), 2U);
  EXPECT_EQ(tiles.tiles[0].revision, 3U);
  EXPECT_EQ(tiles.tiles[1].revision, 2U);
}

TEST(Mailbox, AMovedMapMakesOlderTilesWorthless) {
  Mailbox box(10);
  (void)box.push(tile(1, 0, 1));
  (void)box.push(tile(2, 1, 2));
  const auto out = box.drain();
  EXPECT_EQ(std::get<api::TileUpdate>(out.front()->payload).tiles.size(), 1U);
}

TEST(Mailbox, IsBoundedAndLosesTheOldestFirst) {
  Mailbox box(2);
  for (std::uint64_t k = 1; k <= 5; ++k) {
    (void)box.push(update(api::Topic::kEvent, k, api::Event{}));
  }
  const auto out = box.drain();
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(out.front()->sequence, 4U);
}

}  // namespace
}  // namespace seeker::server_net
