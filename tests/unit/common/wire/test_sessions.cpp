#include <set>
#include <string>

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include "common/wire/client_session.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/server_session.hpp"

namespace seeker::wire {
namespace {

using std::chrono::milliseconds;

WallTime at(int ms) { return WallTime(milliseconds(1'000'000 + ms)); }

pb::Envelope hello(std::uint32_t major = api::kProtocolMajor, const std::string& name = "tester") {
  pb::Envelope envelope;
  envelope.mutable_hello()->set_protocol_major(major);
  envelope.mutable_hello()->set_client_name(name);
  envelope.mutable_hello()->set_role(pb::ROLE_OPERATOR);
  return envelope;
}

pb::Envelope stop_request(std::uint64_t id) {
  pb::Envelope envelope;
  envelope.mutable_request()->mutable_header()->set_request_id(id);
  envelope.mutable_request()->mutable_stop();
  return envelope;
}

pb::Envelope info_request(std::uint64_t id) {
  pb::Envelope envelope;
  envelope.mutable_request()->mutable_header()->set_request_id(id);
  envelope.mutable_request()->mutable_get_info();
  return envelope;
}

TEST(RequiredRole, CallsThatChangeSomethingNeedAnOperator) {
  const std::set<std::string> for_everybody = {
      "get_info",          "get_status",     "list_components", "get_mission",  "stop",          "get_tiles",
      "get_grid",          "get_detections", "get_trajectory",  "grab_image",   "subscribe",     "unsubscribe",
      "time_sync",         "list_maps",      "inspect_map",     "download_map", "get_segments",  "list_landmarks",
      "inspect_landmarks", "get_landmarks",  "get_settings",    "read_file",    "get_diagnosis", "get_audit"};
  const google::protobuf::OneofDescriptor* calls = pb::Request::descriptor()->FindOneofByName("call");
  ASSERT_NE(calls, nullptr);
  for (int k = 0; k < calls->field_count(); ++k) {
    pb::Request request;
    pb::Request::GetReflection()->MutableMessage(&request, calls->field(k));
    const std::string& name = calls->field(k)->name();
    EXPECT_EQ(required_role(request), for_everybody.contains(name) ? api::Role::kObserver : api::Role::kOperator)
        << name;
  }
}

TEST(RequiredRole, AnybodyMayEngageTheEmergencyStopAndAnOperatorReleasesIt) {
  pb::Request request;
  request.mutable_set_estop()->set_engaged(true);
  EXPECT_EQ(required_role(request), api::Role::kObserver);
}

class ServerSessionTest : public ::testing::Test {
 protected:
  ServerSessionTest() {
    params_.robot.robot_id = "r2";
    params_.stream_id = 42;
  }
  ServerSession make() const { return {params_, at(0)}; }
  static ServerStep put(ServerSession& session, const pb::Envelope& envelope, int ms = 0) {
    return session.on_payload(envelope.SerializeAsString(), at(ms), robot_time_s(1.0));
  }
  ServerSession opened() const {
    ServerSession session = make();
    EXPECT_TRUE(put(session, hello()).opened);
    return session;
  }
  ServerSessionParams params_;
};

TEST_F(ServerSessionTest, HelloOpensAndTellsTheRun) {
  ServerSession session = make();
  const ServerStep step = put(session, hello());
  ASSERT_TRUE(step.send);
  EXPECT_TRUE(step.opened);
  EXPECT_EQ(step.send->hello_reply().status(), pb::HelloReply::STATUS_OK);
  EXPECT_EQ(step.send->hello_reply().stream_id(), 42U);
  EXPECT_EQ(step.send->hello_reply().robot().robot_id(), "r2");
  EXPECT_EQ(session.caller(), (api::Caller{"tester", api::Role::kOperator}));
}

TEST_F(ServerSessionTest, HelloIsRefusedWithItsReason) {
  const auto status_of = [&](const pb::Envelope& envelope) {
    ServerSession session = make();
    const ServerStep step = put(session, envelope);
    EXPECT_TRUE(step.end);
    EXPECT_FALSE(session.open());
    return step.send ? step.send->hello_reply().status() : pb::HelloReply::STATUS_UNSPECIFIED;
  };
  EXPECT_EQ(status_of(hello(2)), pb::HelloReply::STATUS_UNSUPPORTED_VERSION);
  EXPECT_EQ(status_of(hello(1, "two words")), pb::HelloReply::STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(status_of(hello(1, "")), pb::HelloReply::STATUS_INVALID_ARGUMENT);
  auto other = hello();
  other.mutable_hello()->set_robot_id("r3");
  EXPECT_EQ(status_of(other), pb::HelloReply::STATUS_NOT_FOUND);
  params_.full = true;
  EXPECT_EQ(status_of(hello()), pb::HelloReply::STATUS_BUSY);
}

TEST_F(ServerSessionTest, ACertificateNamesItsClients) {
  params_.certified_name = "anna";
  const auto status_of = [&](const std::string& name) {
    ServerSession session = make();
    return put(session, hello(1, name)).send->hello_reply().status();
  };
  EXPECT_EQ(status_of("anna"), pb::HelloReply::STATUS_OK);
  EXPECT_EQ(status_of("anna/seeker-desk-12"), pb::HelloReply::STATUS_OK);
  for (const char* name : {"bob", "annabel", "ann", "bob/anna", "/anna"}) {
    EXPECT_EQ(status_of(name), pb::HelloReply::STATUS_INVALID_ARGUMENT) << name;
  }
  EXPECT_EQ(certified_client_name("anna", "seeker-1"), "anna/seeker-1");
  EXPECT_EQ(certified_client_name("anna", "anna/seeker-1"), "anna/seeker-1");
  EXPECT_EQ(certified_client_name("anna", std::string(64, 'x')).size(), 64U);
  EXPECT_EQ(certified_client_name("", "seeker-1"), "seeker-1");
}

TEST_F(ServerSessionTest, ARoleThatACertificateDoesNotAllowIsNotGranted) {
  params_.certified_name = "olga";
  params_.max_role = api::Role::kObserver;
  ServerSession session = make();
  put(session, hello(1, "olga"));
  EXPECT_EQ(session.caller().role, api::Role::kObserver);
  pb::Envelope drive = info_request(1);
  drive.mutable_request()->mutable_drive();
  const ServerStep step = put(session, drive);
  EXPECT_FALSE(step.request);
  EXPECT_NE(step.send->response().header().error().message().find("--role operator"), std::string::npos);
}

TEST_F(ServerSessionTest, TheSmallerMinorIsSpoken) {
  ServerSession session = make();
  auto newer = hello();
  newer.mutable_hello()->set_protocol_minor(api::kProtocolMinor + 5);
  EXPECT_EQ(put(session, newer).send->hello_reply().protocol_minor(), api::kProtocolMinor);
}

TEST_F(ServerSessionTest, SecondHelloIsAnError) {
  ServerSession session = opened();
  const ServerStep step = put(session, hello());
  ASSERT_TRUE(step.end);
  EXPECT_EQ(step.end->reason, pb::Close::REASON_PROTOCOL_ERROR);
}

TEST_F(ServerSessionTest, InFlightLimitHoldsBackAllButStop) {
  params_.in_flight = 1;
  ServerSession session = opened();
  EXPECT_TRUE(put(session, info_request(1)).request);
  const ServerStep second = put(session, info_request(2));
  ASSERT_TRUE(second.send);
  EXPECT_EQ(second.send->response().header().error().code(), pb::CommonError::CODE_RATE_LIMITED);
  EXPECT_EQ(second.send->response().header().request_id(), 2U);
  EXPECT_TRUE(put(session, stop_request(3)).request);
  session.answered();
  session.answered();
  EXPECT_TRUE(put(session, info_request(4)).request);
}

TEST_F(ServerSessionTest, UnknownCallsAreAnsweredNotPunished) {
  ServerSession session = opened();
  pb::Envelope unknown;
  unknown.mutable_request()->mutable_header()->set_request_id(7);
  const ServerStep step = put(session, unknown);
  ASSERT_TRUE(step.send);
  EXPECT_FALSE(step.end);
  EXPECT_EQ(step.send->response().header().error().code(), pb::CommonError::CODE_UNSUPPORTED_VERSION);
}

TEST_F(ServerSessionTest, AnotherRobotsRequestIsRefused) {
  ServerSession session = opened();
  auto request = info_request(1);
  request.mutable_request()->mutable_header()->set_robot_id("r3");
  EXPECT_EQ(put(session, request).send->response().header().error().code(), pb::CommonError::CODE_WRONG_ROBOT);
}

TEST_F(ServerSessionTest, HeartbeatsAreDueOnAQuietLinkAndSilenceEndsIt) {
  ServerSession session = opened();
  session.on_sent(at(0));
  EXPECT_FALSE(session.on_tick(at(900), {}, 1, false).send);
  const ServerStep beat = session.on_tick(at(1000), robot_time_s(5.0), 1, false);
  ASSERT_TRUE(beat.send);
  EXPECT_EQ(beat.send->heartbeat().robot_time_ns(), 5'000'000'000);
  EXPECT_FALSE(session.on_tick(at(2900), {}, 1, false).end);
  const ServerStep lost = session.on_tick(at(3000), {}, 1, false);
  ASSERT_TRUE(lost.end);
  EXPECT_EQ(lost.end->reason, pb::Close::REASON_SILENT);
  EXPECT_FALSE(lost.end->goodbye);
}

TEST_F(ServerSessionTest, ARobotWhoseLoopIsStuckSendsNoHeartbeat) {
  ServerSession session = opened();
  session.on_sent(at(0));
  const ServerStep beat = session.on_tick(at(1000), {}, 7, false);
  ASSERT_TRUE(beat.send);
  EXPECT_EQ(beat.send->heartbeat().loop_pass(), 7U);
  session.on_sent(at(1000));
  EXPECT_FALSE(session.on_tick(at(2000), {}, 7, false).send) << "no pass since the last heartbeat";
  EXPECT_TRUE(session.on_tick(at(2200), {}, 8, false).send) << "at once when the loop has passed";
}

TEST_F(ServerSessionTest, AnyFrameIsASignOfLife) {
  ServerSession session = opened();
  (void)put(session, info_request(1), 2500);
  EXPECT_FALSE(session.on_tick(at(5000), {}, 1, false).end);
}

TEST_F(ServerSessionTest, GoodbyeIsOnPurpose) {
  ServerSession session = opened();
  pb::Envelope goodbye;
  goodbye.mutable_close()->set_reason(pb::Close::REASON_GOODBYE);
  const ServerStep step = put(session, goodbye);
  ASSERT_TRUE(step.end);
  EXPECT_TRUE(step.end->goodbye);
}

TEST_F(ServerSessionTest, IdleEndsOnlyWithoutSubscriptions) {
  params_.idle_limit = milliseconds(500);
  ServerSession session = opened();
  EXPECT_FALSE(session.on_tick(at(600), {}, 1, true).end);
  EXPECT_EQ(session.on_tick(at(600), {}, 1, false).end->reason, pb::Close::REASON_IDLE);
}

class ClientSessionTest : public ServerSessionTest {
 protected:
  ClientSessionTest() { client_params_.client_name = "tester"; }
  ClientSession opened_client() {
    ClientSession client(client_params_, at(0));
    ServerSession server = make();
    const ServerStep reply = put(server, client.hello());
    EXPECT_TRUE(client.on_payload(reply.send->SerializeAsString(), at(0)).opened);
    return client;
  }
  static pb::Envelope info_response(std::uint64_t id) {
    pb::Envelope envelope;
    envelope.mutable_response()->mutable_header()->set_request_id(id);
    envelope.mutable_response()->mutable_header()->mutable_error()->set_code(pb::CommonError::CODE_OK);
    envelope.mutable_response()->mutable_get_info()->set_status(pb::GetInfoResponse::STATUS_OK);
    return envelope;
  }
  static pb::Request info() {
    pb::Request request;
    request.mutable_get_info();
    return request;
  }
  ClientSessionParams client_params_;
};

TEST_F(ClientSessionTest, HelloTellsRobotRoleAndRun) {
  const ClientSession client = opened_client();
  EXPECT_TRUE(client.open());
  EXPECT_EQ(client.robot().robot_id, "r2");
  EXPECT_EQ(client.role(), api::Role::kOperator);
  EXPECT_EQ(client.stream_id(), 42U);
}

TEST_F(ClientSessionTest, ARefusalIsFinalWhereTryingAgainIsUseless) {
  const auto refused = [&](pb::HelloReply::Status status) {
    ClientSession client(client_params_, at(0));
    pb::Envelope envelope;
    envelope.mutable_hello_reply()->set_status(status);
    return client.on_payload(envelope.SerializeAsString(), at(0));
  };
  EXPECT_EQ(refused(pb::HelloReply::STATUS_UNSUPPORTED_VERSION).end->code, Errc::kUnsupportedVersion);
  EXPECT_TRUE(refused(pb::HelloReply::STATUS_UNSUPPORTED_VERSION).final_end);
  EXPECT_EQ(refused(pb::HelloReply::STATUS_BUSY).end->code, Errc::kBusy);
  EXPECT_FALSE(refused(pb::HelloReply::STATUS_BUSY).final_end);
}

TEST_F(ClientSessionTest, AnswersFindTheirCallInAnyOrder) {
  ClientSession client = opened_client();
  std::vector<int> order;
  (void)client.call(info(), at(0), milliseconds(100), [&](const auto&) { order.push_back(1); });
  (void)client.call(info(), at(0), milliseconds(100), [&](const auto&) { order.push_back(2); });
  EXPECT_FALSE(client.on_payload(info_response(2).SerializeAsString(), at(1)).end);
  EXPECT_FALSE(client.on_payload(info_response(1).SerializeAsString(), at(1)).end);
  EXPECT_FALSE(client.on_payload(info_response(1).SerializeAsString(), at(1)).end);  // twice is ignored
  EXPECT_EQ(order, (std::vector<int>{2, 1}));
}

TEST_F(ClientSessionTest, ACallTimesOutOnceAndALateAnswerIsIgnored) {
  ClientSession client = opened_client();
  std::vector<Errc> errors;
  (void)client.call(info(), at(0), milliseconds(100), [&](const auto& r) { errors.push_back(r.error().code); });
  (void)client.on_tick(at(99));
  EXPECT_TRUE(errors.empty());
  (void)client.on_tick(at(100));
  EXPECT_FALSE(client.on_payload(info_response(1).SerializeAsString(), at(101)).end);
  EXPECT_EQ(errors, (std::vector<Errc>{Errc::kTimeout}));
}

TEST_F(ClientSessionTest, AnAnswerToAnotherCallIsAnError) {
  ClientSession client = opened_client();
  pb::Request stop;
  stop.mutable_stop();
  (void)client.call(stop, at(0), milliseconds(100), [](const auto&) {});
  EXPECT_TRUE(client.on_payload(info_response(1).SerializeAsString(), at(1)).end);
}

TEST_F(ClientSessionTest, SilenceIsStaleThenLost) {
  ClientSession client = opened_client();
  EXPECT_FALSE(client.stale(at(1499)));
  EXPECT_TRUE(client.stale(at(1500)));
  EXPECT_FALSE(client.on_tick(at(2999)).end);
  EXPECT_EQ(client.on_tick(at(3000)).end->code, Errc::kLinkLost);
}

}  // namespace
}  // namespace seeker::wire
