// Who commanded what, and what the robot finds out about itself, through real sockets.

#include <algorithm>

#include "tests/integration/net/tls_fixture.hpp"

namespace seeker::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The records of a call.
std::vector<api::AuditRecord> records_of(const FakeRobotHost& robot, const std::string& call) {
  std::vector<api::AuditRecord> found = robot.values().commanded;
  std::erase_if(found, [&](const api::AuditRecord& record) { return record.call != call; });
  return found;
}

TEST_F(NetTest, EveryCommandIsToldToTheRobotWithItsOutcome) {
  start();
  const auto client = connect("anna-1");
  ASSERT_TRUE(client);
  ASSERT_TRUE(ask<api::RobotStatus>([&](auto r) { client->get_status(r); }));
  ASSERT_TRUE(ask<void>([&](auto r) { client->set_estop(true, r); }));
  EXPECT_FALSE(ask<void>([&](auto r) { client->delete_map("nowhere", r); }));
  ASSERT_TRUE(ask<void>([&](auto r) { client->stop(r); }));
  const std::vector<api::AuditRecord> all = robot_.values().commanded;
  ASSERT_EQ(all.size(), 3U) << "reading is not commanding";
  EXPECT_EQ(all[0].call, "set_estop");
  EXPECT_EQ(all[0].essentials, "engage");
  EXPECT_EQ(all[0].outcome, "ok");
  EXPECT_EQ(all[0].client, "anna-1");
  EXPECT_EQ(all[0].role, "operator");
  EXPECT_THAT(all[0].address, StartsWith("127.0.0.1:"));
  EXPECT_EQ(all[0].certificate, "");
  EXPECT_GT(all[0].unix_ns, 0);
  EXPECT_EQ(all[1].outcome, "not_found");
  EXPECT_THAT(all[1].message, HasSubstr("nowhere"));
  EXPECT_EQ(all[2].call, "stop");
}

TEST_F(NetTest, CommandsThatTheSessionRefusesAreRecordedToo) {
  start();
  rpc::ClientParams params = client_params("olga");
  params.role = api::Role::kObserver;
  const auto client = rpc::RobotClient::connect({"127.0.0.1", port_}, params);
  ASSERT_TRUE(client);
  EXPECT_FALSE(ask<void>([&](auto r) { (*client)->set_estop(false, r); }));
  const auto refused = records_of(robot_, "set_estop");
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_EQ(refused.front().outcome, "refused");
  EXPECT_EQ(refused.front().role, "observer");
  EXPECT_THAT(refused.front().message, HasSubstr("an observer may not do this"));
}

TEST_F(NetTest, ACommandWithoutAnAnswerIsRecordedWhenItsSessionEnds) {
  start();
  const auto client = connect("anna-1");
  ASSERT_TRUE(client);
  robot_.hold_replies(true);
  client->stop([](const Status&) {});
  ASSERT_TRUE(eventually([&] { return robot_.values().calls.back() == "anna-1 stop"; }));
  client->close();
  ASSERT_TRUE(eventually([&] { return !records_of(robot_, "stop").empty(); }));
  EXPECT_EQ(records_of(robot_, "stop").front().outcome, "unknown");
  robot_.release_replies();
}

TEST_F(TlsTest, ARecordNamesTheCertificate) {
  start();
  const auto client = connect_as(site_.issue("anna", pki::Role::kOperator));
  ASSERT_TRUE(client);
  ASSERT_TRUE(ask<void>([&](auto r) { client->stop(r); }));
  const auto stops = records_of(robot_, "stop");
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_EQ(stops.front().client, "anna/tester");
  EXPECT_EQ(stops.front().certificate, "anna");
  EXPECT_FALSE(stops.front().serial.empty());
}

TEST_F(NetTest, DiagnosisAndRecordsTravel) {
  api::AuditRecord record;
  record.number = 7;
  record.unix_ns = 1'764'359'273'250'000'000;
  record.stamp = robot_time_s(12.5);
  record.client = "anna";
  record.role = "operator";
  record.certificate = "anna";
  record.serial = "3f";
  record.address = "10.0.0.7:51234";
  record.call = "set_estop";
  record.essentials = "release";
  record.outcome = "refused";
  record.message = "no";
  const std::vector<api::Finding> findings{{"robot-disk", api::Verdict::kFailed, "full", "delete"},
                                           {"robot-clock", api::Verdict::kOk, "kept", ""}};
  robot_.edit([&](FakeRobotValues& v) {
    v.audit = {record};
    v.diagnosis = findings;
  });
  start();
  const auto client = connect("anna-1");
  ASSERT_TRUE(client);
  const auto diagnosis = ask<std::vector<api::Finding>>([&](auto r) { client->get_diagnosis(r); });
  ASSERT_TRUE(diagnosis) << diagnosis.error().message;
  EXPECT_EQ(*diagnosis, findings);
  const auto records = ask<std::vector<api::AuditRecord>>([&](auto r) { client->get_audit({5, "anna"}, r); });
  ASSERT_TRUE(records) << records.error().message;
  EXPECT_EQ(*records, std::vector{record});
  EXPECT_EQ(robot_.values().audit_queries.back(), (api::AuditQuery{5, "anna"}));
  for (const std::uint32_t last : {0U, api::kMaxAuditRecords + 1}) {
    const auto refused = ask<std::vector<api::AuditRecord>>([&](auto r) { client->get_audit({last, ""}, r); });
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, Errc::kInvalidArgument);
  }
}

TEST_F(NetTest, ComparingClocksTellsHowFarTheWallClocksAreApart) {
  start();
  const auto client = connect("anna-1");
  ASSERT_TRUE(client);
  const auto sync = ask<rpc::TimeSync>([&](auto r) { client->sync_time(r); });
  ASSERT_TRUE(sync) << sync.error().message;
  ASSERT_TRUE(sync->robot_wall_minus_local);
  // Both are this machine's: apart by no more than is not known of them, and the clock's own adjustment.
  EXPECT_LE(std::chrono::abs(*sync->robot_wall_minus_local), sync->round_trip + milliseconds(50));
}

}  // namespace
}  // namespace seeker::testing
