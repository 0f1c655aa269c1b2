// What subscribers get: what is new and due, everything once for a newcomer, nothing that nobody wants.

#include <map>

#include <gtest/gtest.h>

#include "server/app/loop/publisher.hpp"
#include "tests/unit/server/app/loop/fake_deck.hpp"

namespace seeker::app {
namespace {

class PublisherTest : public ::testing::Test {
 protected:
  void subscribe(std::initializer_list<api::Topic> topics) {
    std::vector<api::TopicRequest> requests;
    for (const api::Topic topic : topics) {
      requests.push_back(api::TopicRequest{.topic = topic});
    }
    subscription = deck.hub.subscribe(
        requests, [this](const std::shared_ptr<const api::Update>& update) { ++updates[update->topic]; });
  }
  void tick_with_sweep() {
    deck.base->next = testing::odometry_at(deck.clock->time, {});
    deck.lidar->next = testing::sweep_at(deck.clock->time, 3.0F);
    deck.tick();
    deck.localiser.map_readings(deck.sensing);
    publisher.publish();
  }

  testing::FakeDeck deck;
  Publisher publisher{deck.params,
                      {},
                      {deck.world, deck.sensing, deck.localiser, deck.neighbours, deck.motion, deck.executor,
                       deck.missions.resumption(), deck.diagnostics},
                      deck.hub};
  std::map<api::Topic, int> updates;
  std::unique_ptr<api::Subscription> subscription;
};

TEST_F(PublisherTest, AScanIsPublishedOnceAndAgainForANewcomer) {
  subscribe({api::Topic::kScan});
  tick_with_sweep();
  EXPECT_EQ(updates[api::Topic::kScan], 1);
  deck.tick();
  publisher.publish();
  EXPECT_EQ(updates[api::Topic::kScan], 1) << "nothing new has come";
  publisher.republish();
  publisher.publish();
  EXPECT_EQ(updates[api::Topic::kScan], 2);
  EXPECT_FALSE(publisher.republishes());
}

TEST_F(PublisherTest, TheLinesOfAScanComeWithIt) {
  subscribe({api::Topic::kLines});
  tick_with_sweep();
  EXPECT_EQ(updates[api::Topic::kLines], 1);
  deck.tick();
  publisher.publish();
  EXPECT_EQ(updates[api::Topic::kLines], 1) << "nothing new has come";
  publisher.republish();
  publisher.publish();
  EXPECT_EQ(updates[api::Topic::kLines], 2);
}

TEST_F(PublisherTest, TilesComeAtTheirOwnPace) {
  subscribe({api::Topic::kTiles, api::Topic::kStatus});
  for (int k = 0; k < 10; ++k) {
    tick_with_sweep();
  }
  EXPECT_EQ(updates[api::Topic::kStatus], 10);
  EXPECT_GE(updates[api::Topic::kTiles], 1);
  EXPECT_LE(updates[api::Topic::kTiles], 3) << "twice a second";
}

TEST_F(PublisherTest, TheTopologyNamesItsRobotAndComesAtItsOwnPace) {
  std::string robot_id;
  subscription = deck.hub.subscribe({{.topic = api::Topic::kTopology}}, [&](const auto& update) {
    ++updates[update->topic];
    robot_id = std::get<RobotTopology>(update->payload).robot_id;
  });
  for (int k = 0; k < 10; ++k) {
    tick_with_sweep();
  }
  EXPECT_EQ(updates[api::Topic::kTopology], 1) << "once a second";
  EXPECT_EQ(robot_id, deck.params.robot_id);
}

TEST_F(PublisherTest, NobodyGetsWhatNobodyHasSubscribedTo) {
  subscribe({api::Topic::kStatus});
  tick_with_sweep();
  EXPECT_EQ(updates.size(), 1U);
}

TEST_F(PublisherTest, TheStatusNamesFaultsAndTheMissionThatWasCutOff) {
  deck.diagnostics.raise("lidar-silent", "lidar", "nothing comes", "check the cable");
  deck.missions.offer_unfinished(testing::go_to("cut"));
  const api::RobotStatus status = publisher.status();
  ASSERT_EQ(status.faults.size(), 1U);
  ASSERT_TRUE(status.cut_off);
  EXPECT_EQ(status.cut_off->id, "cut");
}

}  // namespace
}  // namespace seeker::app
