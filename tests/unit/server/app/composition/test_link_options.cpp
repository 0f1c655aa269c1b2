#include "server/app/composition/link_options.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/data.hpp"
#include "tests/support/net/site.hpp"

namespace seeker::app {
namespace {

using ::testing::HasSubstr;

Result<RobotOptions> parsed(std::string_view text) { return parse_robot_options(text, "robot.yaml"); }

TEST(LinkOptions, TheSectionTlsNamesThreeFilesOrNone) {
  const auto all = parsed("{server: {tls: {certificate: a, key: b, ca: c, revocations: d}}}");
  ASSERT_TRUE(all) << all.error().message;
  EXPECT_TRUE(link_security(*all).tls());
  EXPECT_EQ(all->server.security.files.revocations, "d");
  for (const char* part : {"certificate: a", "key: b", "ca: c, key: b"}) {
    const auto some = parsed("{server: {tls: {" + std::string(part) + "}}}");
    ASSERT_FALSE(some) << part;
    EXPECT_THAT(some.error().message, HasSubstr("server.tls.certificate"));
  }
  EXPECT_FALSE(link_security(RobotOptions()).tls());
}

TEST(LinkOptions, LimitsAreReadAndChecked) {
  const auto read = parsed(
      "{server: {tls: {handshake_s: 2, handshakes: 8, lockout: {failures: 3, within_s: 5, for_s: 7, loopback: "
      "false}}}}");
  ASSERT_TRUE(read) << read.error().message;
  const net::LinkSecurity security = link_security(*read);
  EXPECT_EQ(security.handshake.timeout, std::chrono::seconds(2));
  EXPECT_EQ(security.handshake.in_progress, 8U);
  EXPECT_EQ(security.lockout.failures, 3U);
  EXPECT_EQ(security.lockout.within, std::chrono::seconds(5));
  EXPECT_EQ(security.lockout.duration, std::chrono::seconds(7));
  EXPECT_FALSE(security.lockout.loopback);
  EXPECT_FALSE(parsed("{server: {tls: {handshake_s: 0}}}"));
  EXPECT_FALSE(parsed("{server: {tls: {handshakes: 0}}}"));
  EXPECT_FALSE(parsed("{server: {tls: {lockout: {failures: 0}}}}"));
  EXPECT_FALSE(parsed("{server: {tls: {cert: a}}}"));
}

TEST(LinkOptions, PlainPortsAreForThisMachineUnlessTheFileSaysInsecure) {
  EXPECT_TRUE(check_links(RobotOptions()));
  const auto open = parsed("{server: {address: 0.0.0.0}}");
  EXPECT_THAT(check_links(*open).error().message, HasSubstr("server: "));
  EXPECT_THAT(check_links(*open).error().message, HasSubstr("seeker pki"));
  EXPECT_TRUE(check_links(*parsed("{server: {address: 0.0.0.0, insecure: true}}")));
  const auto fleet = parsed("{fleet: {lead: true, address: 0.0.0.0}}");
  EXPECT_THAT(check_links(*fleet).error().message, HasSubstr("fleet: "));
  EXPECT_FALSE(check_links(*parsed("{emulator: {tls: true}}")));
}

TEST(LinkOptions, PathsAreThoseOfTheRobotFilesFolder) {
  testing::TestSite site;
  const pki::BundleFiles bundle = site.robot();
  const std::filesystem::path file = bundle.certificate.parent_path() / "robot.yaml";
  std::ofstream(file) << "base: " << testing::source_file("config/robots/sim.yaml").string()
                      << "\nserver: {address: 0.0.0.0, tls: {certificate: cert.pem, key: key.pem, ca: ca.pem, "
                         "revocations: crl.pem}}\n";
  const auto options = load_robot_options(file);
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(link_security(*options).files, bundle);
  EXPECT_TRUE(check_links(*options));
  std::filesystem::remove(bundle.key);
  EXPECT_THAT(check_links(*options).error().message, HasSubstr("server.tls: "));
}

}  // namespace
}  // namespace seeker::app
