// Who is heard: clients that fall silent, a robot whose control loop is stuck, and what commands need besides a link.

#include <atomic>

#include "tests/integration/net/fixture.hpp"

namespace seeker::testing {
namespace {

constexpr std::uint32_t kMinor = api::kProtocolMinor;
/// Clients that speak it stamp no commands.
constexpr std::uint32_t kBeforeStamps = 4;

class Liveness : public NetTest {
 protected:
  /// As often as a test can wait for.
  void beat_fast() {
    params_.heartbeat = milliseconds(40);
    params_.lost_after = milliseconds(400);
  }
  /// A client that speaks `minor`, past its hello.
  std::unique_ptr<RawClient> greet(const std::string& name, std::uint32_t minor) {
    auto client = std::make_unique<RawClient>(port_);
    client->hello(name, api::kProtocolMajor, minor);
    EXPECT_TRUE(client->receive(pb::Envelope::kHelloReply));
    return client;
  }
  static pb::Response answer(RawClient& client, pb::Envelope& request) {
    static std::uint64_t id = 0;
    request.mutable_request()->mutable_header()->set_request_id(++id);
    client.send(request);
    const auto answer = client.receive(pb::Envelope::kResponse);
    EXPECT_TRUE(answer);
    return answer ? answer->response() : pb::Response();
  }
};

TEST_F(Liveness, RobotWhoseLoopIsStuckIsStaleThenLostAndLetsNobodyIn) {
  beat_fast();
  std::atomic<std::uint64_t> pass{1};
  std::atomic<bool> stuck{false};
  params_.loop_pass = [&] { return stuck ? pass.load() : ++pass; };
  start();
  const auto client = connect("tester");
  ASSERT_TRUE(client);
  stuck = true;
  const auto became = [this](rpc::LinkState state) {
    return links_.wait([state](const auto& all) {
      return std::any_of(all.begin(), all.end(), [&](const auto& link) { return link.state == state; });
    });
  };
  EXPECT_TRUE(became(rpc::LinkState::kStale));
  EXPECT_TRUE(became(rpc::LinkState::kLost));
  const auto refused = [this] {
    RawClient late(port_);
    late.hello("late");
    const auto reply = late.receive();
    return reply && reply->hello_reply().status() == pb::HelloReply::STATUS_NOT_READY &&
           reply->hello_reply().message().find("stuck") != std::string::npos;
  };
  EXPECT_TRUE(eventually(refused));
  stuck = false;
  EXPECT_TRUE(eventually([&] { return client->link() == rpc::LinkState::kConnected; }));
}

TEST_F(Liveness, HeartbeatsTellThePassOfTheLoop) {
  beat_fast();
  std::atomic<std::uint64_t> pass{1000};
  params_.loop_pass = [&] { return ++pass; };
  start();
  const auto client = greet("tester", kMinor);
  const auto first = client->receive(pb::Envelope::kHeartbeat);
  const auto second = client->receive(pb::Envelope::kHeartbeat);
  ASSERT_TRUE(first && second);
  EXPECT_GT(first->heartbeat().loop_pass(), 1000U);
  EXPECT_GT(second->heartbeat().loop_pass(), first->heartbeat().loop_pass());
}

TEST_F(Liveness, SilentClientIsToldBeforeItIsLostAndWhenItIsHeardAgain) {
  beat_fast();
  params_.lost_after = std::chrono::seconds(60);
  start();
  const auto client = greet("quiet", kMinor);
  ASSERT_TRUE(eventually([&] { return robot_.values().silent.size() == 1; }));
  EXPECT_EQ(robot_.values().silent.front().first.client_name, "quiet");
  EXPECT_GE(robot_.values().silent.front().second, Duration(milliseconds(60)));
  EXPECT_TRUE(robot_.values().lost.empty());
  pb::Envelope beat;
  beat.mutable_heartbeat();
  client->send(beat);
  EXPECT_TRUE(eventually([&] { return robot_.values().returned.size() == 1; }));
  EXPECT_TRUE(eventually([&] { return robot_.values().silent.size() == 2; })) << "each silence is told";
}

TEST_F(Liveness, CommandWithATimeNeedsComparedClocksAndAStamp) {
  start();
  const auto client = greet("tester", kMinor);
  pb::Envelope drive;
  pb::DriveCommand* command = drive.mutable_request()->mutable_drive()->mutable_command();
  command->mutable_velocity();
  command->set_ttl_ns(300'000'000);
  EXPECT_EQ(answer(*client, drive).drive().status(), pb::DriveResponse::STATUS_REFUSED);
  command->set_sent_ns(1);
  const pb::Response unsynced = answer(*client, drive);
  EXPECT_EQ(unsynced.drive().status(), pb::DriveResponse::STATUS_REFUSED);
  EXPECT_NE(unsynced.drive().message().find("time_sync"), std::string::npos);
  pb::Envelope sync;
  sync.mutable_request()->mutable_time_sync();
  (void)answer(*client, sync);
  EXPECT_EQ(answer(*client, drive).drive().message().find("time_sync"), std::string::npos);
  command->clear_sent_ns();
  EXPECT_NE(answer(*client, drive).drive().message().find("sent_ns"), std::string::npos);
  const auto old = greet("older", kBeforeStamps);
  EXPECT_EQ(answer(*old, drive).drive().message().find("time_sync"), std::string::npos)
      << "older clients know no stamp";
}

TEST_F(Liveness, RemoteClientComparesTheClocksByItself) {
  params_.robot_now = [] {
    return RobotTime(std::chrono::steady_clock::now().time_since_epoch() + std::chrono::hours(1));
  };
  start();
  const auto client = connect("tester");
  const auto lease = ask<api::LeaseState>([&](auto r) {
    client->command_lease({api::LeaseAction::kAcquire, false}, r);
  });
  ASSERT_TRUE(lease);
  const RobotTime before = params_.robot_now();
  ASSERT_TRUE(ask<void>([&](auto r) { client->drive({{0.1, 0.0}, milliseconds(300), lease->epoch}, r); }));
  ASSERT_EQ(robot_.values().drives.size(), 1U);
  const std::optional<RobotTime> sent = robot_.values().drives.front().sent;
  ASSERT_TRUE(sent);
  EXPECT_NEAR(to_seconds(*sent - before), 0.0, 5.0) << "robot time, an hour ahead of this machine's";
}

TEST_F(Liveness, EmptyRequestReleasesNoEmergencyStop) {
  start();
  robot_.edit([](FakeRobotValues& v) { v.estop = true; });
  const auto client = greet("tester", kMinor);
  pb::Envelope release;
  release.mutable_request()->mutable_set_estop();
  EXPECT_EQ(answer(*client, release).header().error().code(), pb::CommonError::CODE_INVALID_ARGUMENT);
  EXPECT_TRUE(robot_.values().estop);
  release.mutable_request()->mutable_set_estop()->set_release(true);
  EXPECT_EQ(answer(*client, release).set_estop().status(), pb::SetEstopResponse::STATUS_OK);
  EXPECT_FALSE(robot_.values().estop);
}

TEST_F(Liveness, AcceptanceOfAMissionTellsItsLinkPolicy) {
  start();
  const auto client = connect("tester");
  api::MissionRequest request{"m-1", api::GotoMission{{Point2(1.0, 2.0)}, {}, {}}, api::LinkPolicy::kStop, {}};
  request.link_steps = api::parse_link_steps("2:event,5:pause,30:return").value();
  const auto accepted = ask<api::MissionAccepted>([&](auto r) { client->start_mission(request, r); });
  ASSERT_TRUE(accepted) << accepted.error().message;
  EXPECT_EQ(accepted->link_steps, request.link_steps);
  EXPECT_EQ(robot_.values().missions.front(), request);
}

}  // namespace
}  // namespace seeker::testing
