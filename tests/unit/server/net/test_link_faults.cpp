#include "server/net/link_faults.hpp"

#include <gtest/gtest.h>

namespace seeker::server_net {
namespace {

constexpr std::chrono::hours kDay{24};
const pki::CalendarTime kNow{kDay * 20000};

net::LinkHealth tls_until(pki::CalendarTime expires) {
  net::LinkHealth health;
  health.tls = true;
  health.name = "r1";
  health.expires = expires;
  return health;
}

TEST(LinkFaults, AGoodPortHasNone) {
  EXPECT_TRUE(link_faults(tls_until(kNow + 31 * kDay), kNow).empty());
  EXPECT_TRUE(link_faults(net::LinkHealth(), kNow).empty()) << "plain TCP on this machine";
}

TEST(LinkFaults, AnInsecurePortIsAWarningThatBlocksNothing) {
  net::LinkHealth health;
  health.insecure = true;
  health.address = "0.0.0.0";
  const auto faults = link_faults(health, kNow);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].id, "link-insecure");
  EXPECT_EQ(faults[0].severity, api::Severity::kWarning);
}

TEST(LinkFaults, ExpiryIsAWarningForThirtyDaysAndThenAnError) {
  const auto soon = link_faults(tls_until(kNow + 30 * kDay), kNow);
  ASSERT_EQ(soon.size(), 1U);
  EXPECT_EQ(soon[0].id, "certificate-expiry");
  EXPECT_EQ(soon[0].severity, api::Severity::kWarning);
  const auto over = link_faults(tls_until(kNow), kNow);
  ASSERT_EQ(over.size(), 1U);
  EXPECT_EQ(over[0].severity, api::Severity::kError);
}

TEST(LinkFaults, BrokenFilesAreAWarningWithTheReason) {
  net::LinkHealth health = tls_until(kNow + 300 * kDay);
  health.problem = Error{Errc::kCorrupt, "cert.pem is no certificate"};
  const auto faults = link_faults(health, kNow);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].id, "certificate-files");
  EXPECT_NE(faults[0].message.find("cert.pem is no certificate"), std::string::npos);
}

}  // namespace
}  // namespace seeker::server_net
