#include "common/rpc/lease_keeper.hpp"
#include "tests/integration/net/fixture.hpp"

namespace seeker::testing {
namespace {

TEST_F(NetTest, ValuesComeBackAsTheRobotHasThem) {
  start();
  const auto client = connect("tester");
  const FakeRobotValues v = robot_.values();
  EXPECT_EQ(client->robot(), v.info);
  EXPECT_EQ(ask<api::RobotInfo>([&](auto r) { client->get_info(r); }), v.info);
  EXPECT_EQ(ask<api::RobotStatus>([&](auto r) { client->get_status(r); }), v.status);
  EXPECT_EQ(ask<std::vector<api::ComponentInfo>>([&](auto r) { client->list_components(r); }), v.components);
  EXPECT_EQ(ask<api::TileUpdate>([&](auto r) { client->get_tiles(0, r); }), v.tiles);
  EXPECT_EQ(ask<api::TileUpdate>([&](auto r) { client->get_tiles(3, r); })->tiles.size(), 1U);
  EXPECT_EQ(ask<api::GridReport>([&](auto r) { client->get_grid(r); }), v.grid);
  EXPECT_EQ(ask<std::vector<api::Detection>>([&](auto r) { client->get_detections(r); }), v.detections);
  EXPECT_EQ(ask<std::vector<api::StampedPose>>([&](auto r) { client->get_trajectory(r); }), v.trajectory);
  EXPECT_EQ(ask<api::ImageFrame>([&](auto r) { client->grab_image("omni", r); }), v.cameras.at("omni"));
}

TEST_F(NetTest, RefusalsKeepTheirCodeAndSentence) {
  start();
  const auto client = connect("tester");
  const auto camera = ask<api::ImageFrame>([&](auto r) { client->grab_image("none", r); });
  ASSERT_FALSE(camera);
  EXPECT_EQ(camera.error(), (Error{Errc::kNotFound, "no camera 'none'"}));
  // A code that the call's own status does not have goes through the common error.
  robot_.edit([](FakeRobotValues& v) { v.failure = Error{Errc::kUnreachable, "no way"}; });
  const auto status = ask<void>([&](auto r) { client->stop(r); });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error(), (Error{Errc::kUnreachable, "no way"}));
}

TEST_F(NetTest, ComponentsAreSetSwitchedAndExchangedOverTheWire) {
  start();
  const auto client = connect("tester");
  using Settings = std::vector<api::ComponentSetting>;
  EXPECT_EQ(ask<Settings>([&](auto r) { client->get_settings("base", r); }), robot_.values().settings.at("base"));
  const auto changed = ask<Settings>([&](auto r) { client->set_settings("base", {"timeout_s=0.7"}, r); });
  ASSERT_TRUE(changed) << changed.error().message;
  ASSERT_EQ(changed->size(), 1U);
  EXPECT_EQ(changed->front().value, "0.7");
  const auto refused = ask<Settings>([&](auto r) { client->set_settings("base", {"timeout_s=bad"}, r); });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), (Error{Errc::kInvalidArgument, "loop.base_timeout_s: expected a number, got 'bad'"}));
  EXPECT_FALSE(ask<Settings>([&](auto r) { client->set_settings("base", {}, r); })) << "nothing to set";
  EXPECT_TRUE(ask<void>([&](auto r) { client->switch_component("base", false, r); }));
  EXPECT_TRUE(ask<void>([&](auto r) { client->exchange_component("base", "other", r); }));
  EXPECT_EQ(robot_.values().components.front().state, api::ComponentState::kInactive);
  EXPECT_EQ(robot_.values().components.front().type, "other");
  EXPECT_FALSE(ask<void>([&](auto r) { client->exchange_component("base", "", r); }));
}

TEST_F(NetTest, AMapOfManyTilesArrivesWhole) {
  robot_.edit([](FakeRobotValues& v) {
    v.tiles.tiles.clear();
    for (int k = 0; k < 2500; ++k) {
      OccupancyTile tile;
      tile.index = {k % 50, k / 50};
      tile.revision = 1;
      tile.cells.fill(static_cast<std::uint8_t>(k));
      v.tiles.tiles.push_back(tile);
    }
  });
  start();
  const auto client = connect("tester");
  const auto tiles = ask<api::TileUpdate>([&](auto r) { client->get_tiles(0, r); });
  ASSERT_TRUE(tiles) << tiles.error().message;
  EXPECT_EQ(*tiles, robot_.values().tiles);
}

TEST_F(NetTest, MissionStartAnswersAtOnceAndRepeatingItIsHarmless) {
  start();
  const auto client = connect("tester");
  api::MissionRequest request{"m-1", api::GotoMission{{Point2(1.0, 2.0)}, 0.5, {}}, api::LinkPolicy::kReturn, {}};
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(ask<api::MissionAccepted>([&](auto r) { client->start_mission(request, r); })->id, "m-1");
  }
  ASSERT_EQ(robot_.values().missions.size(), 1U);
  EXPECT_EQ(robot_.values().missions.front(), request);
  request.id = "m-2";
  const auto second = ask<api::MissionAccepted>([&](auto r) { client->start_mission(request, r); });
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::kBusy);
  EXPECT_TRUE(ask<void>([&](auto r) { client->command_mission(api::MissionCommand::kStop, r); }));
  EXPECT_EQ(ask<api::MissionStatus>([&](auto r) { client->get_mission(r); })->end->outcome, api::Outcome::kOperator);
}

TEST_F(NetTest, ObserversReadAndStopButDoNotCommand) {
  params_.max_role = api::Role::kObserver;
  start();
  const auto client = connect("guest");
  EXPECT_EQ(client->role(), api::Role::kObserver);
  EXPECT_TRUE(ask<api::RobotStatus>([&](auto r) { client->get_status(r); }));
  EXPECT_TRUE(ask<void>([&](auto r) { client->stop(r); }));
  EXPECT_TRUE(ask<void>([&](auto r) { client->set_estop(true, r); }));
  EXPECT_EQ(ask<void>([&](auto r) { client->set_estop(false, r); }).error().code, Errc::kRefused);
  EXPECT_EQ(ask<api::LeaseState>([&](auto r) {
              client->command_lease({api::LeaseAction::kAcquire, false}, r);
            })
                .error()
                .code,
            Errc::kRefused);
}

TEST_F(NetTest, LeaseKeeperRefreshesAStaleLease) {
  start();
  const auto client = connect("first");
  Recorder<api::LeaseState> lost;
  rpc::LeaseKeeperParams keep;
  keep.client_name = "first";
  keep.on_lost = [&](const api::LeaseState& lease) { lost.add(lease); };
  const auto keeper = rpc::LeaseKeeper::acquire(client, keep);
  ASSERT_TRUE(keeper) << keeper.error().message;
  robot_.edit([](FakeRobotValues& v) {
    v.lease.stale = true;
    ++v.lease.epoch;
  });
  EXPECT_TRUE(eventually([&] {
    api::RobotStatus status = robot_.values().status;
    status.lease = robot_.values().lease;
    robot_.publish(api::Topic::kStatus, robot_time_s(2.0), status);
    return !robot_.values().lease.stale && (*keeper)->epoch() == robot_.values().lease.epoch;
  }));
  EXPECT_TRUE((*keeper)->held());
  EXPECT_TRUE(lost.items().empty());
}

TEST_F(NetTest, LeaseKeeperHoldsAndReleasesAndHearsOfATakeOver) {
  start();
  const auto first = connect("first");
  const auto second = connect("second");
  Recorder<api::LeaseState> lost;
  rpc::LeaseKeeperParams keep;
  keep.client_name = "first";
  keep.on_lost = [&](const api::LeaseState& lease) { lost.add(lease); };
  auto keeper = rpc::LeaseKeeper::acquire(first, keep);
  ASSERT_TRUE(keeper) << keeper.error().message;
  EXPECT_TRUE(ask<void>([&](auto r) { first->drive({{0.1, 0.0}, milliseconds(300), (*keeper)->epoch()}, r); }));
  rpc::LeaseKeeperParams other;
  other.client_name = "second";
  EXPECT_EQ(rpc::LeaseKeeper::acquire(second, other).error().code, Errc::kBusy);
  other.take_over = true;
  auto taker = rpc::LeaseKeeper::acquire(second, other);
  ASSERT_TRUE(taker);
  EXPECT_TRUE(eventually([&] {
    api::RobotStatus status = robot_.values().status;
    status.lease = robot_.values().lease;
    robot_.publish(api::Topic::kStatus, robot_time_s(2.0), status);
    return !(*keeper)->held();
  }));
  ASSERT_TRUE(lost.wait_count(1));
  EXPECT_EQ(lost.items().front().owner, "second");
  taker->reset();
  EXPECT_EQ(robot_.values().lease.owner, "");
}

TEST_F(NetTest, RepliesMayComeFromAnotherThreadAndLater) {
  start();
  const auto client = connect("tester");
  robot_.hold_replies(true);
  Recorder<Result<api::RobotInfo>> answers;
  for (int k = 0; k < 5; ++k) {
    client->get_info([&](const Result<api::RobotInfo>& info) { answers.add(info); });
  }
  EXPECT_TRUE(eventually([&] { return robot_.values().calls.size() >= 6; }));  // and the server's own question
  EXPECT_TRUE(answers.items().empty());
  robot_.release_replies();
  EXPECT_TRUE(answers.wait_count(5));
}

TEST_F(NetTest, ACallWithoutAnswerTimesOut) {
  start();
  auto p = client_params("tester");
  p.call_timeout = milliseconds(30);
  const auto client = rpc::RobotClient::connect({"127.0.0.1", port_}, p);
  ASSERT_TRUE(client);
  robot_.hold_replies(true);
  const auto info = ask<api::RobotInfo>([&](auto r) { (*client)->get_info(r); });
  ASSERT_FALSE(info);
  EXPECT_EQ(info.error().code, Errc::kTimeout);
}

TEST_F(NetTest, GoodbyeIsToldApartFromALoss) {
  start();
  connect("polite")->close();
  EXPECT_TRUE(eventually([&] { return robot_.values().closed.size() == 1; }));
  {
    RawClient rude(port_);
    rude.hello("rude");
    (void)rude.receive();
  }
  EXPECT_TRUE(eventually([&] { return robot_.values().lost.size() == 1; }));
  EXPECT_EQ(robot_.values().closed.front().client_name, "polite");
  EXPECT_EQ(robot_.values().lost.front().first.client_name, "rude");
}

TEST_F(NetTest, ClockOffsetIsEstimated) {
  params_.robot_now = [] {
    return RobotTime(std::chrono::steady_clock::now().time_since_epoch() + std::chrono::hours(1));
  };
  start();
  const auto client = connect("tester");
  const auto sync = ask<rpc::TimeSync>([&](auto r) { client->sync_time(r); });
  ASSERT_TRUE(sync) << sync.error().message;
  const Duration error = sync->robot_minus_local - std::chrono::hours(1);
  EXPECT_LE(std::abs(to_seconds(error)), to_seconds(sync->round_trip) / 2 + 1e-6);
}

TEST_F(NetTest, NobodyThereIsALinkErrorWithARemedy) {
  const auto client = rpc::RobotClient::connect({"127.0.0.1", 1}, client_params("tester"));
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().code, Errc::kLinkLost);
  EXPECT_NE(client.error().message.find("seekerd"), std::string::npos);
}

TEST_F(NetTest, StoppingTheServerTellsClientsAndEndsCalls) {
  start();
  auto p = client_params("tester");
  p.reconnect.enabled = false;
  const auto client = rpc::RobotClient::connect({"127.0.0.1", port_}, p);
  ASSERT_TRUE(client);
  robot_.hold_replies(true);
  Recorder<Result<api::RobotInfo>> answers;
  (*client)->get_info([&](const Result<api::RobotInfo>& info) { answers.add(info); });
  EXPECT_TRUE(eventually([&] { return robot_.values().calls.size() >= 2; }));
  server_->stop();
  ASSERT_TRUE(answers.wait_count(1));
  EXPECT_EQ(answers.items().front().error().code, Errc::kLinkLost);
  ASSERT_TRUE(links_.wait([](const auto& all) { return !all.empty() && all.back().state == rpc::LinkState::kClosed; }));
  EXPECT_NE(links_.items().back().why.find("shutting down"), std::string::npos);
}

}  // namespace
}  // namespace seeker::testing
