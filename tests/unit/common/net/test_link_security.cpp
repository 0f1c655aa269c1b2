#include "common/net/link_security.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/net/tls_keeper.hpp"
#include "tests/support/net/site.hpp"

namespace seeker::net {
namespace {

using ::testing::HasSubstr;
using testing::TestSite;

TEST(LinkSecurity, PlainTcpIsForThisMachineOnly) {
  EXPECT_TRUE(check_allowed("127.0.0.1", {}));
  EXPECT_TRUE(check_allowed("::1", {}));
  for (const char* address : {"0.0.0.0", "::", "10.0.0.5"}) {
    const Status refused = check_allowed(address, {});
    ASSERT_FALSE(refused) << address;
    EXPECT_THAT(refused.error().message, HasSubstr("seeker pki"));
  }
}

TEST(LinkSecurity, TlsOrAWordOpensEveryAddress) {
  LinkSecurity tls;
  tls.files.certificate = "cert.pem";
  EXPECT_TRUE(check_allowed("0.0.0.0", tls));
  LinkSecurity insecure;
  insecure.insecure = true;
  EXPECT_TRUE(check_allowed("0.0.0.0", insecure));
}

TEST(TlsKeeper, ReadsFilesAgainWhenTheyChange) {
  TestSite site;
  const pki::BundleFiles files = site.robot();
  auto keeper = TlsKeeper::open(files);
  ASSERT_TRUE(keeper) << keeper.error().message;
  const std::string before = keeper->context().own().facts().serial;
  EXPECT_FALSE(keeper->refresh());
  site.robot();
  EXPECT_TRUE(keeper->refresh());
  EXPECT_NE(keeper->context().own().facts().serial, before);
  EXPECT_FALSE(keeper->refresh());
}

TEST(TlsKeeper, KeepsTheFormerFilesWhileTheNewOnesAreBroken) {
  TestSite site;
  const pki::BundleFiles files = site.robot();
  auto keeper = TlsKeeper::open(files);
  ASSERT_TRUE(keeper);
  const std::string before = keeper->context().own().facts().serial;
  std::ofstream(files.certificate) << "half a fi";
  EXPECT_FALSE(keeper->refresh());
  ASSERT_TRUE(keeper->problem());
  EXPECT_THAT(keeper->problem()->message, HasSubstr(files.certificate.string()));
  EXPECT_EQ(keeper->context().own().facts().serial, before);
  site.robot();
  EXPECT_TRUE(keeper->refresh());
  EXPECT_FALSE(keeper->problem());
}

TEST(TlsKeeper, AKeyOfAnotherCertificateIsNoticed) {
  TestSite site;
  pki::BundleFiles files = site.robot();
  files.key = site.issue("anna", pki::Role::kAdmin).key;
  const auto keeper = TlsKeeper::open(files);
  ASSERT_FALSE(keeper);
  EXPECT_THAT(keeper.error().message, HasSubstr("is not the key of"));
}

TEST(TlsKeeper, FilesThatAreNotThereAreNamed) {
  TestSite site;
  pki::BundleFiles files = site.robot();
  files.revocations = site.folder() / "none.pem";
  EXPECT_THAT(TlsKeeper::open(files).error().message, HasSubstr("none.pem"));
}

}  // namespace
}  // namespace seeker::net
