#include "tests/integration/net/fixture.hpp"

namespace seeker::testing {
namespace {

struct Stream {
  Recorder<api::UpdatePtr> updates;
  std::unique_ptr<api::Subscription> subscription;

  void open(api::RobotApi& robot, const std::vector<api::TopicRequest>& topics) {
    auto made = robot.subscribe(topics, [this](const api::UpdatePtr& update) { updates.add(update); });
    ASSERT_TRUE(made) << made.error().message;
    subscription = std::move(*made);
  }
};

std::vector<std::string> texts(const std::vector<api::UpdatePtr>& updates) {
  std::vector<std::string> out;
  for (const auto& update : updates) {
    out.push_back(std::get<api::Event>(update->payload).text);
  }
  return out;
}

class StreamTest : public NetTest {
 protected:
  /// A call after subscribe() is answered after it: then the subscription is known to the server.
  void settle(rpc::RobotClient& client) {
    ASSERT_TRUE(ask<api::RobotInfo>([&](auto r) { client.get_info(r); }));
  }
};

TEST_F(StreamTest, ReliableItemsArriveInOrderAndWithoutGap) {
  start();
  const auto client = connect("tester");
  Stream events;
  events.open(*client, {{api::Topic::kEvent, 0.0, 0}});
  settle(*client);
  std::vector<std::string> sent;
  for (int k = 0; k < 500; ++k) {
    sent.push_back(std::to_string(k));
    publish_event(sent.back());
  }
  ASSERT_TRUE(events.updates.wait_count(sent.size()));
  EXPECT_EQ(texts(events.updates.items()), sent);
}

TEST_F(StreamTest, AnotherClientResumesFromANumber) {
  start();
  for (int k = 1; k <= 10; ++k) {
    publish_event(std::to_string(k));
  }
  EXPECT_TRUE(eventually([&] { return server_->stats().encoded == 10; }));
  const auto client = connect("tester");
  Stream events;
  events.open(*client, {{api::Topic::kEvent, 0.0, 7}});
  ASSERT_TRUE(events.updates.wait_count(3));
  EXPECT_EQ(texts(events.updates.items()), (std::vector<std::string>{"8", "9", "10"}));
}

TEST_F(StreamTest, WhatIsNoLongerKeptIsCounted) {
  params_.backlog.items = 4;
  start();
  for (int k = 1; k <= 10; ++k) {
    publish_event(std::to_string(k));
    EXPECT_TRUE(eventually([&] { return server_->stats().encoded == static_cast<std::uint64_t>(k); }));
  }
  const auto client = connect("tester");
  Stream events;
  events.open(*client, {{api::Topic::kEvent, 0.0, 2}});
  ASSERT_TRUE(events.updates.wait_count(4));
  EXPECT_EQ(texts(events.updates.items()), (std::vector<std::string>{"7", "8", "9", "10"}));
  EXPECT_EQ(events.updates.items().front()->dropped, 4U);
}

TEST_F(StreamTest, NothingIsLostOrDoubledWhenTheSocketIsCutAgainAndAgain) {
  start();
  ChaosProxy proxy(port_);
  const auto client = connect("tester", proxy.port());
  Stream events;
  events.open(*client, {{api::Topic::kEvent, 0.0, 0}});
  settle(*client);
  std::vector<std::string> sent;
  for (int k = 0; k < 600; ++k) {
    sent.push_back(std::to_string(k));
    publish_event(sent.back());
    if (k % 150 == 75) {
      proxy.cut();
      ASSERT_TRUE(eventually([&] { return client->link() == rpc::LinkState::kLost || links_.items().size() > 1; }));
    }
  }
  ASSERT_TRUE(events.updates.wait_count(sent.size()));
  EXPECT_EQ(texts(events.updates.items()), sent);
  EXPECT_GT(proxy.connections(), 1U);
}

TEST_F(StreamTest, AConnectionOfTheClientThatArrivesLateDoesNotEndIt) {
  start();
  ChaosProxy proxy(port_);
  rpc::ClientParams params = client_params("tester");
  params.heartbeat = milliseconds(50);
  const auto client = rpc::RobotClient::connect({"127.0.0.1", proxy.port()}, params).value();
  Stream events;
  events.open(*client, {{api::Topic::kEvent, 0.0, 0}});
  settle(*client);
  // The first connection that is made again waits until the client has given it up and another one was served.
  proxy.impair({.reorder = 1.0, .hold = kPatience});
  proxy.cut();
  ASSERT_TRUE(eventually([&] { return proxy.connections() >= 3; }));
  proxy.impair({});
  publish_event("after");
  ASSERT_TRUE(events.updates.wait_count(1));
  EXPECT_EQ(texts(events.updates.items()), (std::vector<std::string>{"after"}));
  EXPECT_TRUE(logged("the same client has connected again"));
  EXPECT_TRUE(eventually([&] { return client->link() == rpc::LinkState::kConnected; }));
  settle(*client);
}

TEST_F(StreamTest, AnotherRunOfTheRobotIsTold) {
  start();
  const std::uint16_t port = port_;
  publish_event("old 1");
  const auto client = connect("tester");
  Stream events;
  events.open(*client, {{api::Topic::kEvent, 0.0, 0}});
  settle(*client);
  publish_event("old 2");
  ASSERT_TRUE(events.updates.wait_count(1));
  server_->stop();
  params_.port = port;
  start();
  ASSERT_TRUE(links_.wait([](const auto& all) {
    return std::any_of(all.begin(), all.end(), [](const auto& event) { return event.robot_restarted; });
  }));
  settle(*client);
  publish_event("new");
  ASSERT_TRUE(events.updates.wait_count(2));
  EXPECT_EQ(texts(events.updates.items()).back(), "new");
}

TEST_F(StreamTest, ASlowLinkGetsTheNewestAndIsToldWhatItMissed) {
  start();
  const auto client = connect("tester");
  Stream status;
  status.open(*client, {{api::Topic::kStatus, 20.0, 0}});
  settle(*client);
  api::RobotStatus value = robot_.values().status;
  for (std::uint64_t k = 1; k <= 200; ++k) {
    value.map_revision = k;
    robot_.publish(api::Topic::kStatus, robot_time_s(1.0), value);
  }
  // The last one always arrives, and what was left out is counted.
  ASSERT_TRUE(status.updates.wait([](const auto& all) { return !all.empty() && all.back()->sequence == 200; }));
  const auto got = status.updates.items();
  EXPECT_LT(got.size(), 100U);
  for (std::size_t k = 1; k < got.size(); ++k) {
    EXPECT_EQ(got[k]->dropped, got[k]->sequence - got[k - 1]->sequence - 1);
  }
  EXPECT_EQ(std::get<api::RobotStatus>(got.back()->payload).map_revision, 200U);
}

TEST_F(StreamTest, TilesConvergeToTheNewestRevisionOfEach) {
  start();
  const auto client = connect("tester");
  Stream tiles;
  tiles.open(*client, {{api::Topic::kTiles, 50.0, 0}});
  settle(*client);
  for (std::uint64_t revision = 1; revision <= 300; ++revision) {
    api::TileUpdate update{revision, 1, {}};
    OccupancyTile tile;
    tile.index = {static_cast<int>(revision % 7), -1};
    tile.revision = revision;
    tile.cells.fill(static_cast<std::uint8_t>(revision));
    update.tiles.push_back(tile);
    robot_.publish(api::Topic::kTiles, robot_time_s(1.0), update);
  }
  const auto newest = [](const std::vector<api::UpdatePtr>& all) {
    std::map<int, std::uint64_t> revisions;
    for (const auto& update : all) {
      for (const auto& tile : std::get<api::TileUpdate>(update->payload).tiles) {
        revisions[tile.index.i] = tile.revision;
      }
    }
    return revisions;
  };
  const std::map<int, std::uint64_t> expected{{0, 294}, {1, 295}, {2, 296}, {3, 297}, {4, 298}, {5, 299}, {6, 300}};
  EXPECT_TRUE(tiles.updates.wait([&](const auto& all) { return newest(all) == expected; }));
}

TEST_F(StreamTest, TilesThatChangedWhileTheLinkWasDownAreCaughtUp) {
  start();
  ChaosProxy proxy(port_);
  const auto client = connect("tester", proxy.port());
  Stream tiles;
  tiles.open(*client, {{api::Topic::kTiles, 0.0, 0}});
  settle(*client);
  robot_.publish(api::Topic::kTiles, robot_time_s(1.0), robot_.values().tiles);
  ASSERT_TRUE(tiles.updates.wait_count(1));
  proxy.impair({.drop = 1.0});
  proxy.cut();
  ASSERT_TRUE(eventually([&] { return client->link() == rpc::LinkState::kLost; }));
  robot_.edit([](FakeRobotValues& v) {
    v.tiles.revision = 9;
    v.tiles.tiles[2].revision = 9;
  });
  proxy.impair({});
  ASSERT_TRUE(tiles.updates.wait_count(2));
  const auto& caught_up = std::get<api::TileUpdate>(tiles.updates.items().back()->payload);
  ASSERT_EQ(caught_up.tiles.size(), 1U);
  EXPECT_EQ(caught_up.tiles.front().revision, 9U);
}

TEST_F(StreamTest, ASilentLinkGoesStaleThenLostAndTheRobotHearsOfIt) {
  params_.heartbeat = milliseconds(100);
  params_.lost_after = milliseconds(600);
  start();
  ChaosProxy proxy(port_);
  const auto client = connect("tester", proxy.port());
  proxy.impair({.stalled = true});
  const auto seen = [](rpc::LinkState state) {
    return [state](const std::vector<rpc::LinkEvent>& all) {
      return std::any_of(all.begin(), all.end(), [state](const auto& event) { return event.state == state; });
    };
  };
  EXPECT_TRUE(links_.wait(seen(rpc::LinkState::kStale)));
  EXPECT_TRUE(links_.wait(seen(rpc::LinkState::kLost)));
  EXPECT_TRUE(eventually([&] { return !robot_.values().lost.empty(); }));
  EXPECT_EQ(robot_.values().lost.front().first.client_name, "tester");
  proxy.impair({});
  EXPECT_TRUE(links_.wait([](const auto& all) { return all.back().state == rpc::LinkState::kConnected; }));
}

TEST_F(StreamTest, ByteByByteIsAsGoodAsAtOnce) {
  start();
  ChaosProxy proxy(port_);
  proxy.impair({.piece = 1});
  const auto client = connect("tester", proxy.port());
  EXPECT_EQ(ask<api::RobotStatus>([&](auto r) { client->get_status(r); }), robot_.values().status);
}

TEST_F(StreamTest, AfterTheSubscriptionEndedTheSinkIsSilent) {
  start();
  const auto client = connect("tester");
  Stream events;
  events.open(*client, {{api::Topic::kEvent, 0.0, 0}});
  settle(*client);
  publish_event("one");
  ASSERT_TRUE(events.updates.wait_count(1));
  events.subscription.reset();
  publish_event("two");
  settle(*client);
  EXPECT_EQ(events.updates.items().size(), 1U);
}

}  // namespace
}  // namespace seeker::testing
