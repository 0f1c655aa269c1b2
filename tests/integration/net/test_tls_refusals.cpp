#include "common/core/rng.hpp"
#include "tests/integration/net/recorded_bytes.hpp"
#include "tests/integration/net/tls_fixture.hpp"

namespace seeker::testing {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

class TlsRefusals : public TlsTest {
 protected:
  /// Connects, and expects one sentence that holds both texts.
  void expect_refused(const std::optional<pki::BundleFiles>& tls, const std::string& cause, const std::string& remedy) {
    const auto client = try_connect(tls);
    ASSERT_FALSE(client);
    EXPECT_EQ(client.error().code, Errc::kRefused) << client.error().message;
    EXPECT_THAT(client.error().message, HasSubstr(cause));
    EXPECT_THAT(client.error().message, HasSubstr(remedy));
  }
};

TEST_F(TlsRefusals, AClientOfPlainTcpIsToldToSpeakTls) {
  start();
  expect_refused(std::nullopt, "speaks TLS", "--tls");
  EXPECT_TRUE(robot_.values().lost.empty());
  expect_unharmed();
}

TEST_F(TlsRefusals, AClientWithoutACertificateIsToldThatOneIsRequired) {
  start();
  TlsPeer peer(port_, std::nullopt);
  EXPECT_THAT(peer.end(), HasSubstr("certificate required"));
  EXPECT_TRUE(logged("a connection was refused: 127.0.0.1"));
  expect_unharmed();
}

TEST_F(TlsRefusals, ACertificateOfAnotherSiteIsRefused) {
  start();
  TestSite other;
  pki::BundleFiles forged = other.issue("anna", pki::Role::kAdmin);
  expect_refused(forged, "another site's CA", "certificates of one site");  // it does not believe the robot
  forged.ca = robot_files_.ca;
  forged.revocations.clear();
  expect_refused(forged, "another site's CA", "seeker pki issue");  // the robot does not believe it
  expect_unharmed();
}

TEST_F(TlsRefusals, ARevokedCertificateIsRefused) {
  const auto anna = site_.issue("anna", pki::Role::kAdmin);
  site_.revoke("anna");
  site_.copy_revocations(robot_files_);
  start();
  expect_refused(anna, "was revoked", "seeker pki issue");
  expect_unharmed();
}

TEST_F(TlsRefusals, AnExpiredCertificateIsRefused) {
  start();
  expect_refused(site_.issue_expired("anna", pki::Role::kAdmin), "has expired", "seeker pki issue");
}

TEST_F(TlsRefusals, ARobotWhoseCertificateHasExpiredIsNotBelieved) {
  params_.security.files = site_.issue_expired("r8", pki::Role::kRobot, {"127.0.0.1"});
  start();
  expect_refused(site_.issue("anna", pki::Role::kAdmin), "has expired", "seeker pki issue");
}

TEST_F(TlsRefusals, ARobotIsBelievedOnlyAtTheAddressesOfItsCertificate) {
  start();
  const auto client = try_connect(site_.issue("anna", pki::Role::kAdmin), "localhost");
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().code, Errc::kRefused);
  EXPECT_THAT(client.error().message, HasSubstr("--host"));
}

TEST_F(TlsRefusals, AClientsCertificateDoesNotMakeARobot) {
  params_.security.files = site_.issue("mallory", pki::Role::kAdmin, {"127.0.0.1"});
  start();
  expect_refused(site_.issue("anna", pki::Role::kAdmin), "is not one of a robot", "");
}

TEST_F(TlsRefusals, AServerOfPlainTcpIsNamedAsSuch) {
  params_.security.files = {};
  start();
  expect_refused(site_.issue("anna", pki::Role::kAdmin), "does not speak TLS", "--tls none");
}

TEST_F(TlsRefusals, Tls12IsRefused) {
  start();
  TlsPeer peer(port_, site_.issue("anna", pki::Role::kAdmin), TLS1_VERSION, TLS1_2_VERSION);
  EXPECT_TRUE(peer.handshake()) << "the handshake must fail";
  expect_unharmed();
}

TEST_F(TlsRefusals, ThereIsNothingToResume) {
  start();
  TlsPeer peer(port_, site_.issue("anna", pki::Role::kAdmin));
  ASSERT_FALSE(peer.handshake());
  const SSL_SESSION* session = SSL_get_session(peer.stream().native_handle());
  EXPECT_EQ(SSL_SESSION_is_resumable(session), 0);
  EXPECT_EQ(SSL_SESSION_get_max_early_data(session), 0U);
}

TEST_F(TlsRefusals, NobodySpeaksInAnothersName) {
  start();
  TlsPeer peer(port_, site_.issue("anna", pki::Role::kAdmin));
  ASSERT_FALSE(peer.handshake());
  pb::Envelope hello;
  hello.mutable_hello()->set_protocol_major(api::kProtocolMajor);
  hello.mutable_hello()->set_client_name("bob/tester");
  hello.mutable_hello()->set_role(pb::ROLE_OPERATOR);
  const auto frame = wire::frame_of(hello);
  boost::asio::write(peer.stream(), boost::asio::buffer(frame->head + *frame->body + frame->tail));
  static_cast<void>(peer.end());
  EXPECT_TRUE(robot_.values().opened.size() <= 1U) << "only the server's own";
  expect_unharmed();
}

TEST_F(TlsRefusals, GarbageHarmsNobody) {
  start();
  Rng rng(7);
  for (int k = 0; k < 20; ++k) {
    RawClient client(port_);
    std::string bytes;
    for (int n = 0; n < 700; ++n) {
      bytes += static_cast<char>(rng.uniform(0.0, 127.0));
    }
    client.send_bytes(k % 2 == 0 ? bytes : std::string("\x16\x03\x01\x02\x00\x01", 6) + bytes);
    EXPECT_FALSE(client.receive());
  }
  expect_unharmed();
}

TEST_F(TlsRefusals, AHandshakeThatDoesNotEndIsClosedInTime) {
  params_.security.handshake.timeout = milliseconds(50);
  start();
  RawClient silent(port_);
  EXPECT_FALSE(silent.receive());
  RawClient slow(port_);
  slow.send_bytes(std::string("\x16\x03\x01\x02\x00\x01", 6));
  EXPECT_FALSE(slow.receive());
  EXPECT_TRUE(logged("did not finish the handshake in time"));
}

TEST_F(TlsRefusals, HalfOpenHandshakesMakeRoomForOthers) {
  params_.security.handshake.in_progress = 4;
  params_.security.handshake.timeout = std::chrono::seconds(20);
  start();
  std::vector<std::unique_ptr<RawClient>> silent;
  for (int k = 0; k < 12; ++k) {
    silent.push_back(std::make_unique<RawClient>(port_));
  }
  EXPECT_FALSE(silent.front()->receive()) << "it has waited longest";
  expect_unharmed();
}

TEST_F(TlsRefusals, AnAddressThatKeepsFailingIsShutOutForAWhile) {
  params_.security.lockout.loopback = true;
  params_.security.lockout.failures = 3;
  params_.security.lockout.duration = milliseconds(1500);
  start();
  const auto good = site_.issue("anna", pki::Role::kAdmin);
  const auto inside = connect_as(good);
  ASSERT_TRUE(inside);
  for (int k = 0; k < 3; ++k) {
    static_cast<void>(TlsPeer(port_, std::nullopt).end());
  }
  EXPECT_TRUE(logged("is shut out for"));
  const auto refused = try_connect(good);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, AnyOf(HasSubstr("shut this address out"), HasSubstr("closed the connection")));
  EXPECT_TRUE(ask<api::RobotStatus>([&](auto r) { inside->get_status(r); })) << "who is inside stays";
  EXPECT_TRUE(eventually([&] { return try_connect(good).has_value(); }));
}

TEST_F(TlsRefusals, BytesThatAreSentAgainDoNothing) {
  start();
  const std::string bytes = recorded_client_bytes(port_, site_.issue("anna", pki::Role::kOperator));
  const auto sessions = [&] { return robot_.values().opened.size(); };
  const std::size_t before = sessions();
  EXPECT_GT(bytes.size(), 1000U);
  RawClient again(port_);
  again.send_bytes(bytes);
  while (again.receive()) {
  }
  EXPECT_TRUE(logged("a connection was refused"));
  EXPECT_EQ(sessions(), before);
  expect_unharmed();
}

}  // namespace
}  // namespace seeker::testing
