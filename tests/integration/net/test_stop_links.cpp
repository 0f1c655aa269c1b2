// Copies of what stops the robot, over connections beside the first.

#include <gmock/gmock.h>

#include "tests/integration/net/fixture.hpp"

namespace seeker::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::Le;
using ::testing::StartsWith;

class StopLinks : public NetTest {
 protected:
  static constexpr int kStopLinks = 2;

  /// A client with all its connections open.
  std::shared_ptr<rpc::RobotClient> connect_all(std::uint16_t port) {
    rpc::ClientParams p = client_params("tester");
    p.stop_links = kStopLinks;
    auto client = rpc::RobotClient::connect({"127.0.0.1", port}, p);
    EXPECT_TRUE(client) << client.error().message;
    EXPECT_TRUE(eventually([&] { return opened("tester/stop1") && opened("tester/stop2"); }));
    return client ? *client : nullptr;
  }
  [[nodiscard]] bool opened(const std::string& name) const {
    const FakeRobotValues v = robot_.values();
    return std::any_of(v.opened.begin(), v.opened.end(),
                       [&](const api::Caller& caller) { return caller.client_name == name; });
  }
  [[nodiscard]] std::vector<std::string> calls_of(const std::string& call) const {
    std::vector<std::string> found;
    for (const std::string& one : robot_.values().calls) {
      if (one.ends_with(call)) {
        found.push_back(one);
      }
    }
    return found;
  }
};

TEST_F(StopLinks, TheRobotIsStoppedAndItIsRecordedOnce) {
  start();
  const auto client = connect_all(port_);
  ASSERT_TRUE(ask<void>([&](auto r) { client->stop(r); }));
  ASSERT_TRUE(ask<void>([&](auto r) { client->set_estop(true, r); }));
  // Behind the copies on each connection: their goodbye.
  client->close();
  ASSERT_TRUE(eventually([&] { return robot_.values().closed.size() == 1 + kStopLinks; }));
  EXPECT_THAT(calls_of("stop").size(), AllOf(Ge(1U), Le(2U))) << "on the first connection, and before by a copy";
  EXPECT_THAT(calls_of("set_estop on").size(), AllOf(Ge(1U), Le(2U)));
  EXPECT_EQ(robot_.values().commanded.size(), 2U);
}

TEST_F(StopLinks, AStopPassesWhileTheFirstConnectionIsHeldBack) {
  start();
  ChaosProxy proxy(port_);
  const auto client = connect_all(proxy.port());
  proxy.impair({.stalled_alone = 1});
  ASSERT_TRUE(ask<void>([&](auto r) { client->stop(r); }));
  EXPECT_THAT(calls_of("stop"), ElementsAre(StartsWith("tester/stop")));
}

TEST_F(StopLinks, WhatWasSentBeforeTheStopDoesNotOutliveIt) {
  start();
  ChaosProxy proxy(port_);
  const auto client = connect_all(proxy.port());
  ASSERT_TRUE(ask<void>([&](auto r) { client->set_estop(true, r); }));
  proxy.impair({.stalled_alone = 1});
  Recorder<Status> released;
  client->set_estop(false, [&](const Status& done) { released.add(done); });
  ASSERT_TRUE(ask<void>([&](auto r) { client->set_estop(true, r); })) << "it overtakes the release";
  proxy.impair({});
  ASSERT_TRUE(released.wait([](const auto& all) { return all.size() == 1; }));
  // Behind the request itself, which follows the release.
  ASSERT_TRUE(ask<api::RobotInfo>([&](auto r) { client->get_info(r); }));
  EXPECT_TRUE(robot_.values().estop);
}

TEST_F(StopLinks, AStopFailsWithoutAConnectionAndPassesWhenOneIsMadeAgain) {
  start();
  ChaosProxy proxy(port_);
  const auto client = connect_all(proxy.port());
  proxy.impair({.drop = 1.0});
  proxy.cut();
  ASSERT_TRUE(eventually([&] { return client->link() == rpc::LinkState::kLost; }));
  EXPECT_FALSE(ask<void>([&](auto r) { client->stop(r); })) << "there is no connection at all";
  proxy.impair({});
  EXPECT_TRUE(eventually([&] { return ask<void>([&](auto r) { client->stop(r); }).has_value(); }));
}

TEST_F(StopLinks, ARobotThatSaysNoIsNotAskedAgain) {
  start();
  const auto client = connect_all(port_);
  robot_.edit([](FakeRobotValues& v) { v.failure = Error{Errc::kNotReady, "the disk is full"}; });
  const Status refused = ask<void>([&](auto r) { client->stop(r); });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), (Error{Errc::kNotReady, "the disk is full"}));
}

TEST_F(StopLinks, WithoutThemTheFirstConnectionIsTheOnlyOne) {
  start();
  const auto client = connect("tester");
  ASSERT_TRUE(ask<void>([&](auto r) { client->stop(r); }));
  EXPECT_EQ(server_->stats().accepted, 1U);
}

}  // namespace
}  // namespace seeker::testing
