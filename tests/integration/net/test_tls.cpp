#include <fstream>

#include "tests/integration/net/tls_fixture.hpp"
#include "tests/support/random_bytes.hpp"

namespace seeker::testing {
namespace {

using ::testing::HasSubstr;

TEST_F(TlsTest, CallsAndStreamsTravelOverTls) {
  start();
  const auto client = connect_as(site_.issue("anna", pki::Role::kOperator));
  ASSERT_TRUE(client);
  Recorder<std::uint64_t> received;
  const auto subscription = client->subscribe({{api::Topic::kEvent, 0.0, 0}},
                                              [&](const api::UpdatePtr& update) { received.add(update->sequence); });
  ASSERT_TRUE(subscription);
  ASSERT_TRUE(ask<api::RobotStatus>([&](auto r) { client->get_status(r); }));
  for (int k = 0; k < 50; ++k) {
    publish_event(std::string(static_cast<std::size_t>(k) * 1000, 'x'));
  }
  EXPECT_TRUE(received.wait_count(50));
}

TEST_F(TlsTest, LargeFramesPassInBothDirections) {
  start();
  const auto client = connect_as(site_.issue("anna", pki::Role::kOperator));
  ASSERT_TRUE(client);
  api::MapUpload upload;
  upload.name = "office";
  upload.bytes = random_bytes(1, 5UL << 20U);
  EXPECT_TRUE(ask<api::MapSummary>([&](auto r) { client->upload_map(upload, r); }));
  EXPECT_TRUE(robot_.values().uploads.at(0).bytes == upload.bytes);
  robot_.edit([&](FakeRobotValues& v) { v.map_files["office"] = upload.bytes; });
  const auto download = ask<std::vector<std::uint8_t>>([&](auto r) { client->download_map("office", r); });
  ASSERT_TRUE(download) << download.error().message;
  EXPECT_TRUE(*download == upload.bytes);
}

TEST_F(TlsTest, TheRobotKnowsAClientByTheNameOfItsCertificate) {
  start();
  const auto client = connect_as(site_.issue("anna", pki::Role::kOperator));
  ASSERT_TRUE(client);
  EXPECT_EQ(client->client_name(), "anna/tester");
  client->close();
  EXPECT_TRUE(eventually([&] { return !robot_.values().closed.empty(); })) << "goodbye travels over TLS, too";
  EXPECT_EQ(robot_.values().closed.at(0).client_name, "anna/tester");
}

TEST_F(TlsTest, TheGrantedRoleIsTheLowerOfWhatIsAskedAndWhatTheCertificateAllows) {
  start();
  const auto observer = connect_as(site_.issue("olga", pki::Role::kObserver));
  const auto asks_less = connect_as(site_.issue("anna", pki::Role::kAdmin));
  const auto robot = connect_as(site_.issue("r2", pki::Role::kRobot));
  ASSERT_TRUE(observer && asks_less && robot);
  EXPECT_EQ(observer->role(), api::Role::kObserver);
  EXPECT_EQ(asks_less->role(), api::Role::kOperator);
  EXPECT_EQ(robot->role(), api::Role::kObserver);
}

TEST_F(TlsTest, AnObserverMayNotCommandButMayStop) {
  start();
  const auto client = connect_as(site_.issue("olga", pki::Role::kObserver));
  ASSERT_TRUE(client);
  const auto refused = ask<api::LeaseState>([&](auto r) {
    client->command_lease({api::LeaseAction::kAcquire, false}, r);
  });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kRefused);
  EXPECT_THAT(refused.error().message, HasSubstr("--role operator"));
  EXPECT_TRUE(ask<void>([&](auto r) { client->stop(r); }));
}

TEST_F(TlsTest, RevokingACertificateEndsItsSession) {
  start();
  const auto anna = connect_as(site_.issue("anna", pki::Role::kOperator));
  const auto bob = connect_as(site_.issue("bob", pki::Role::kOperator));
  ASSERT_TRUE(anna && bob);
  site_.revoke("anna");
  site_.copy_revocations(robot_files_);
  EXPECT_TRUE(eventually([&] { return anna->link() == rpc::LinkState::kClosed; })) << "it does not try again";
  EXPECT_TRUE(eventually([&] { return !robot_.values().lost.empty(); }));
  EXPECT_EQ(robot_.values().lost.at(0).first.client_name, "anna/tester");
  EXPECT_THAT(robot_.values().lost.at(0).second, HasSubstr("was revoked"));
  EXPECT_TRUE(ask<api::RobotStatus>([&](auto r) { bob->get_status(r); }));
}

TEST_F(TlsTest, ARenewedCertificateIsUsedWithoutARestart) {
  start();
  const auto bundle = site_.issue("anna", pki::Role::kOperator);
  const auto before = connect_as(bundle);
  ASSERT_TRUE(before);
  site_.robot();
  EXPECT_TRUE(logged("certificates were read again"));
  const std::string renewed = pki::Certificate::read(robot_files_.certificate)->facts().serial;
  // The files change one after the other: the first look may find some of them only.
  EXPECT_TRUE(eventually([&] {
    TlsPeer peer(port_, bundle);
    return pki::Certificate(SSL_get1_peer_certificate(peer.stream().native_handle())).facts().serial == renewed;
  }));
  EXPECT_TRUE(ask<api::RobotStatus>([&](auto r) { before->get_status(r); })) << "sessions go on";
}

TEST_F(TlsTest, BrokenFilesLeaveTheFormerOnesInUseAndAreAFault) {
  start();
  std::ofstream(robot_files_.certificate) << "half a fi";
  EXPECT_TRUE(faults_.wait([](const auto& reports) {
    return !reports.empty() && !reports.back().empty() && reports.back().front().id == "certificate-files";
  }));
  expect_unharmed();
  site_.robot();
  EXPECT_TRUE(faults_.wait([](const auto& reports) { return reports.size() > 1 && reports.back().empty(); }));
}

TEST_F(TlsTest, AnExpiringCertificateOfTheRobotIsAFault) {
  params_.security.files = site_.issue("r9", pki::Role::kRobot, {"127.0.0.1"}, TestSite::today(), 29);
  start();
  ASSERT_TRUE(faults_.wait_count(1));
  EXPECT_EQ(faults_.items().back().at(0).id, "certificate-expiry");
}

TEST_F(TlsTest, PlainTcpBeyondThisMachineIsRefusedOrSaidLoudly) {
  params_.security.files = {};
  params_.address = "0.0.0.0";
  server_ = std::make_unique<server_net::Server>(robot_, params_);
  const auto refused = server_->start();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("seeker pki"));
  params_.security.insecure = true;
  start();
  EXPECT_TRUE(logged("INSECURE"));
  ASSERT_TRUE(faults_.wait_count(1));
  EXPECT_EQ(faults_.items().back().at(0).id, "link-insecure");
}

}  // namespace
}  // namespace seeker::testing
