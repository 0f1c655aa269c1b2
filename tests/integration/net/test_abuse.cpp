#include "common/core/rng.hpp"
#include "tests/integration/net/fixture.hpp"

namespace seeker::testing {
namespace {

pb::Envelope request(std::uint64_t id) {
  pb::Envelope envelope;
  envelope.mutable_request()->mutable_header()->set_request_id(id);
  return envelope;
}

class AbuseTest : public NetTest {
 protected:
  void expect_unharmed() {
    const auto client = connect("good");
    EXPECT_TRUE(ask<api::RobotStatus>([&](auto r) { client->get_status(r); }));
  }
  void expect_closed(RawClient& client, pb::Close::Reason reason) {
    const auto close = client.receive(pb::Envelope::kClose);
    ASSERT_TRUE(close);
    EXPECT_EQ(close->close().reason(), reason) << close->close().message();
    EXPECT_FALSE(client.receive());
  }
};

TEST_F(AbuseTest, GarbageIsClosedWithAReason) {
  start();
  RawClient client(port_);
  client.send_bytes(std::string("\0\0\0\4\xff\xff\xff\xff", 8));
  expect_closed(client, pb::Close::REASON_PROTOCOL_ERROR);
  expect_unharmed();
}

TEST_F(AbuseTest, RefusalsAreLoggedOnceASecondAtMost) {
  start();
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 50; ++k) {
    RawClient client(port_);
    client.send_bytes(std::string("\0\0\0\4\xff\xff\xff\xff", 8));
    expect_closed(client, pb::Close::REASON_PROTOCOL_ERROR);
  }
  EXPECT_TRUE(logged("connections were refused, the last: ")) << "they are counted";
  const double took_s = to_seconds(std::chrono::steady_clock::now() - begin);
  const std::vector<std::string> lines = log_.items();
  const auto about = std::count_if(lines.begin(), lines.end(),
                                   [](const std::string& line) { return line.find("refused") != std::string::npos; });
  EXPECT_LE(static_cast<double>(about), took_s + 2.0);
}

TEST_F(AbuseTest, AnOversizedFrameIsClosedBeforeItsBytesCome) {
  start();
  RawClient client(port_);
  client.hello("big");
  ASSERT_TRUE(client.receive(pb::Envelope::kHelloReply));
  client.send_bytes("\x7f\xff\xff\xff");
  expect_closed(client, pb::Close::REASON_FRAME_TOO_LARGE);
  expect_unharmed();
}

TEST_F(AbuseTest, AnotherMajorVersionIsRefusedWithBothNamed) {
  start();
  RawClient client(port_);
  client.hello("future", 9);
  const auto reply = client.receive();
  ASSERT_TRUE(reply && reply->has_hello_reply());
  EXPECT_EQ(reply->hello_reply().status(), pb::HelloReply::STATUS_UNSUPPORTED_VERSION);
  EXPECT_EQ(reply->hello_reply().protocol_major(), api::kProtocolMajor);
  EXPECT_NE(reply->hello_reply().message().find("9.0"), std::string::npos);
  EXPECT_FALSE(client.receive());
  EXPECT_TRUE(robot_.values().lost.empty());
}

TEST_F(AbuseTest, RequestsBeforeHelloAreRefused) {
  start();
  RawClient client(port_);
  auto early = request(1);
  early.mutable_request()->mutable_stop();
  client.send(early);
  expect_closed(client, pb::Close::REASON_PROTOCOL_ERROR);
}

TEST_F(AbuseTest, SilenceBeforeHelloIsClosed) {
  params_.session.hello_timeout = milliseconds(30);
  params_.heartbeat = milliseconds(50);
  start();
  RawClient client(port_);
  expect_closed(client, pb::Close::REASON_SILENT);
}

TEST_F(AbuseTest, AFloodIsHeldBackButItsStopGetsThrough) {
  params_.session.requests_per_s = 10.0;
  params_.session.request_burst = 5.0;
  start();
  RawClient client(port_);
  client.hello("flood");
  ASSERT_TRUE(client.receive(pb::Envelope::kHelloReply));
  std::uint64_t id = 0;
  for (int k = 0; k < 300; ++k) {
    auto ask_status = request(++id);
    ask_status.mutable_request()->mutable_get_status();
    client.send(ask_status);
  }
  auto stop = request(++id);
  stop.mutable_request()->mutable_stop();
  client.send(stop);
  std::size_t limited = 0;
  for (;;) {
    const auto answer = client.receive(pb::Envelope::kResponse);
    ASSERT_TRUE(answer);
    limited += answer->response().header().error().code() == pb::CommonError::CODE_RATE_LIMITED ? 1 : 0;
    if (answer->response().header().request_id() == id) {
      EXPECT_EQ(answer->response().stop().status(), pb::StopResponse::STATUS_OK);
      break;
    }
  }
  EXPECT_GT(limited, 250U);
  expect_unharmed();
}

TEST_F(AbuseTest, AFloodWithoutEndIsClosed) {
  params_.session.requests_per_s = 1.0;
  params_.session.request_burst = 1.0;
  params_.session.refused_requests = 100;
  start();
  RawClient client(port_);
  client.hello("flood");
  for (std::uint64_t id = 1; id <= 200; ++id) {
    auto ask_status = request(id);
    ask_status.mutable_request()->mutable_get_status();
    client.send(ask_status);
  }
  expect_closed(client, pb::Close::REASON_FLOODING);
  expect_unharmed();
}

TEST_F(AbuseTest, TooManySessionsAreRefusedInWords) {
  params_.max_sessions = 1;
  start();
  const auto first = connect("first");
  RawClient second(port_);
  second.hello("second");
  const auto reply = second.receive();
  ASSERT_TRUE(reply && reply->has_hello_reply());
  EXPECT_EQ(reply->hello_reply().status(), pb::HelloReply::STATUS_BUSY);
}

TEST_F(AbuseTest, SilentConnectionsMakeRoomForOthersAndForgetNoSession) {
  params_.max_sessions = 4;
  Recorder<std::string> lines;
  const log::ScopedSink sink([&](const log::Line& line) {
    if (line.level >= log::Level::kInfo) {
      lines.add(line.text);
    }
  });
  start();
  const auto first = connect("first");
  std::vector<std::unique_ptr<RawClient>> silent;
  for (int k = 0; k < 12; ++k) {
    silent.push_back(std::make_unique<RawClient>(port_));
  }
  EXPECT_FALSE(silent.front()->receive()) << "it has waited longest";
  const auto late = connect("late");
  ASSERT_TRUE(late);
  EXPECT_TRUE(ask<api::RobotStatus>([&](auto r) { late->get_status(r); }));
  EXPECT_TRUE(ask<api::RobotStatus>([&](auto r) { first->get_status(r); }));
  EXPECT_TRUE(robot_.values().lost.empty());
  for (const std::string& line : lines.items()) {
    EXPECT_EQ(line.find("hello"), std::string::npos) << line;
  }
}

TEST_F(AbuseTest, AReconnectReplacesTheHalfOpenSessionOfTheSameClient) {
  start();
  RawClient half_open(port_);
  half_open.hello("tester");
  ASSERT_TRUE(half_open.receive(pb::Envelope::kHelloReply));
  RawClient again(port_);
  again.hello("tester");
  ASSERT_TRUE(again.receive(pb::Envelope::kHelloReply));
  expect_closed(half_open, pb::Close::REASON_REPLACED);
  EXPECT_TRUE(robot_.values().lost.empty());
}

TEST_F(AbuseTest, ClientsThatNeverReadHarmNobody) {
  constexpr int kClients = 100;
  constexpr int kDeaf = 10;
  constexpr int kEvents = 100;
  params_.session.write_timeout = std::chrono::seconds(1);
  start();
  std::vector<std::unique_ptr<RawClient>> deaf;
  for (int k = 0; k < kDeaf; ++k) {
    auto client = std::make_unique<RawClient>(port_);
    client->hello("deaf-" + std::to_string(k));
    auto subscribe = request(1);
    auto* topics = subscribe.mutable_request()->mutable_subscribe();
    topics->set_subscription_id(1);
    topics->add_topics()->set_topic(pb::TOPIC_IMAGE);
    topics->add_topics()->set_topic(pb::TOPIC_EVENT);
    client->send(subscribe);
    deaf.push_back(std::move(client));
  }
  std::vector<std::shared_ptr<rpc::RobotClient>> clients;
  std::vector<std::unique_ptr<Recorder<std::uint64_t>>> received;
  std::vector<std::unique_ptr<api::Subscription>> subscriptions;
  for (int k = kDeaf; k < kClients; ++k) {
    clients.push_back(connect("good-" + std::to_string(k)));
    received.push_back(std::make_unique<Recorder<std::uint64_t>>());
    auto subscription = clients.back()->subscribe(
        {{api::Topic::kEvent, 0.0, 0}},
        [recorder = received.back().get()](const api::UpdatePtr& update) { recorder->add(update->sequence); });
    ASSERT_TRUE(subscription);
    subscriptions.push_back(std::move(*subscription));
  }
  for (const auto& client : clients) {
    ASSERT_TRUE(ask<api::RobotInfo>([&](auto r) { client->get_info(r); }));
  }
  api::ImageFrame image = robot_.values().cameras.at("omni");
  image.frame.image = Image(640, 480, 3);
  Rng rng(7);
  for (auto& byte : image.frame.image.data()) {
    byte = static_cast<std::uint8_t>(rng.below(256));
  }
  for (int k = 0; k < kEvents; ++k) {
    publish_event(std::to_string(k));
    if (k % 10 == 0) {
      robot_.publish(api::Topic::kImage, robot_time_s(1.0), image);
    }
  }
  for (const auto& recorder : received) {
    ASSERT_TRUE(recorder->wait_count(kEvents));
  }
  EXPECT_TRUE(eventually([&] { return robot_.values().lost.size() == kDeaf; }));
  for (const auto& client : clients) {
    EXPECT_EQ(client->link(), rpc::LinkState::kConnected);
  }
}

}  // namespace
}  // namespace seeker::testing
