#include "common/pki/trust.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/net/site.hpp"

namespace seeker::pki {
namespace {

using ::testing::HasSubstr;
using testing::TestSite;

constexpr std::chrono::hours kDay{24};

Status check(const BundleFiles& trusted, const BundleFiles& shown, CalendarTime at = TestSite::today()) {
  const auto trust = Trust::read(trusted);
  const auto certificate = Certificate::read(shown.certificate);
  EXPECT_TRUE(trust && certificate);
  return trust->check(*certificate, at);
}

TEST(Trust, BelievesACertificateOfItsSite) {
  TestSite site;
  const BundleFiles robot = site.robot();
  EXPECT_TRUE(check(robot, site.issue("anna", Role::kAdmin)));
  EXPECT_TRUE(check(robot, robot));
}

TEST(Trust, SaysWhyItDoesNotBelieve) {
  TestSite site;
  TestSite other;
  const BundleFiles robot = site.robot();
  const BundleFiles anna = site.issue("anna", Role::kAdmin);
  EXPECT_THAT(check(robot, other.issue("anna", Role::kAdmin)).error().message, HasSubstr("another site's CA"));
  EXPECT_THAT(check(robot, anna, TestSite::today() + 366 * kDay).error().message, HasSubstr("expired"));
  EXPECT_THAT(check(robot, anna, TestSite::today() - 2 * kDay).error().message, HasSubstr("not valid yet"));
  site.revoke("anna");
  EXPECT_TRUE(check(robot, anna)) << "the robot has the former list";
  site.copy_revocations(robot);
  const Status revoked = check(robot, anna);
  ASSERT_FALSE(revoked);
  EXPECT_EQ(revoked.error().code, Errc::kRefused);
  EXPECT_THAT(revoked.error().message, HasSubstr("'anna' was revoked"));
}

TEST(Trust, TheListOfRevocationsMustBeOfTheSameSite) {
  TestSite site;
  TestSite other;
  const BundleFiles robot = site.robot();
  other.copy_revocations(robot);
  EXPECT_THAT(Trust::read(robot).error().message, HasSubstr("not signed by the CA"));
}

TEST(Trust, ACertificateThatIsNoCaIsNone) {
  TestSite site;
  BundleFiles robot = site.robot();
  robot.ca = robot.certificate;
  EXPECT_EQ(Trust::read(robot).error().code, Errc::kCorrupt);
}

TEST(Trust, WithoutAListNothingIsRevoked) {
  TestSite site;
  BundleFiles robot = site.robot();
  const BundleFiles anna = site.issue("anna", Role::kAdmin);
  site.revoke("anna");
  robot.revocations.clear();
  EXPECT_TRUE(check(robot, anna));
}

}  // namespace
}  // namespace seeker::pki
