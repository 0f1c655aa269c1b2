// What the doctor thinks of values, and what it finds of files and names on this machine.

#include <fstream>

#include <gmock/gmock.h>

#include "client/doctor/judge.hpp"
#include "client/doctor/way.hpp"
#include "tests/support/net/site.hpp"

namespace seeker::doctor {
namespace {

using api::Finding;
using api::Verdict;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

void expect(Verdict verdict, const std::string& part, const Finding& finding) {
  EXPECT_EQ(finding.verdict, verdict) << finding.found;
  EXPECT_THAT(finding.found, HasSubstr(part));
  EXPECT_EQ(finding.remedy.empty(), verdict == Verdict::kOk) << finding.remedy;
}

TEST(Doctor, OwnFilesOfOneBundleAreWellUntilTheyExpireSoon) {
  testing::TestSite site;
  const pki::BundleFiles files = site.issue("anna", pki::Role::kOperator);
  const pki::CalendarTime now = testing::TestSite::today();
  const std::vector<Finding> well = judge(look_at(files, now), now);
  ASSERT_EQ(well.size(), 2U);
  expect(Verdict::kOk, "belong together", well[0]);
  expect(Verdict::kOk, "'anna', operator", well[1]);
  const pki::CalendarTime late = now + hours(24 * 340);
  expect(Verdict::kWarning, "expires on", judge(look_at(files, late), late)[1]);
}

TEST(Doctor, OwnFilesThatCannotWorkSayWhy) {
  testing::TestSite site;
  const pki::CalendarTime now = testing::TestSite::today();
  const pki::BundleFiles expired = site.issue_expired("anna", pki::Role::kOperator);
  expect(Verdict::kFailed, "expired", judge(look_at(expired, now), now).back());

  const pki::BundleFiles other = site.issue("ben", pki::Role::kOperator);
  pki::BundleFiles mixed = site.issue("carl", pki::Role::kOperator);
  mixed.key = other.key;
  expect(Verdict::kFailed, "is not the key of", judge(look_at(mixed, now), now).front());

  pki::BundleFiles gone = other;
  gone.ca = site.folder() / "none.pem";
  expect(Verdict::kFailed, "none.pem", judge(look_at(gone, now), now).front());
}

TEST(Doctor, AnOlderOrNewerRobotIsAWarningOnly) {
  api::RobotInfo robot;
  robot.robot_id = "r1";
  robot.software_version = "1.0";
  expect(Verdict::kOk, "'r1' has seekerd 1.0", judge_versions("1.0", robot));
  robot.protocol_minor = api::kProtocolMinor - 1;
  expect(Verdict::kWarning, "protocol", judge_versions("1.0", robot));
  robot.protocol_minor = api::kProtocolMinor + 1;
  expect(Verdict::kWarning, "protocol", judge_versions("1.0", robot));
}

TEST(Doctor, ClocksAreComparedByWhatIsKnownOfThem) {
  expect(Verdict::kOk, "0.2 ms behind", judge_clocks(std::chrono::microseconds(-200), milliseconds(1)));
  expect(Verdict::kWarning, "1.5 s ahead of", judge_clocks(milliseconds(1500), milliseconds(1)));
  expect(Verdict::kOk, "1.5 s ahead of", judge_clocks(milliseconds(1500), milliseconds(600)));
  expect(Verdict::kFailed, "7200.0 s behind", judge_clocks(-hours(2), milliseconds(1)));
  expect(Verdict::kWarning, "does not tell", judge_clocks(std::nullopt, {}));
}

TEST(Doctor, OneSlowAnswerIsEnoughForAWarning) {
  expect(Verdict::kOk, "half were answered within 2.0 ms, all within 3.0 ms",
         judge_round_trips({milliseconds(3), milliseconds(1), milliseconds(2)}));
  expect(Verdict::kWarning, "all within 2.0 s", judge_round_trips({milliseconds(1), seconds(2), milliseconds(2)}));
}

TEST(Doctor, LeaseStopLoopAndFaultsAreToldFromTheStatus) {
  api::RobotStatus status;
  status.timing = TickTiming{.ticks = 1000, .late = 1, .worst = milliseconds(30)};
  const std::vector<Finding> well = judge(status);
  ASSERT_EQ(well.size(), 4U);
  expect(Verdict::kOk, "nobody holds", well[0]);
  expect(Verdict::kOk, "released", well[1]);
  expect(Verdict::kOk, "1 of 1000 ticks", well[2]);
  expect(Verdict::kOk, "no fault", well[3]);

  status.timing->late = 2;
  status.estop = true;
  status.lease.owner = "anna";
  status.lease.stale = true;
  status.faults = {{.id = "lidar-lost",
                    .component = "lidar",
                    .severity = api::Severity::kError,
                    .onset = {},
                    .message = "no scan",
                    .remedy = "plug it in"},
                   {.id = "dirty",
                    .component = "lidar",
                    .severity = api::Severity::kWarning,
                    .onset = {},
                    .message = "the window is dirty",
                    .remedy = "clean it"}};
  const std::vector<Finding> ill = judge(status);
  ASSERT_EQ(ill.size(), 5U);
  expect(Verdict::kWarning, "'anna' holds", ill[0]);
  expect(Verdict::kWarning, "latched", ill[1]);
  expect(Verdict::kWarning, "2 of 1000 ticks", ill[2]);
  expect(Verdict::kFailed, "lidar: no scan", ill[3]);
  expect(Verdict::kWarning, "dirty", ill[4]);
  EXPECT_TRUE(has_failed(ill));
  EXPECT_FALSE(has_failed(well));
}

TEST(Doctor, ComponentsThatDoNotWorkAreNamed) {
  api::ComponentInfo works;
  works.name = "base";
  works.type = "sim";
  works.state = api::ComponentState::kActive;
  api::ComponentInfo broken = works;
  broken.name = "lidar";
  broken.state = api::ComponentState::kError;
  broken.last_error = "no answer";
  api::ComponentInfo off = works;
  off.name = "sonar";
  off.state = api::ComponentState::kInactive;
  expect(Verdict::kOk, "all 1 components work", judge(std::vector{works}).front());
  const std::vector<Finding> ill = judge(std::vector{works, broken, off});
  ASSERT_EQ(ill.size(), 2U);
  expect(Verdict::kFailed, "no answer", ill[0]);
  expect(Verdict::kWarning, "'sonar'", ill[1]);
}

TEST(Doctor, ANameThatStandsForNothingIsToldApartFromAPortThatNobodyListensAt) {
  const auto addresses = addresses_of("127.0.0.1");
  ASSERT_TRUE(addresses) << addresses.error().message;
  EXPECT_EQ(*addresses, std::vector<std::string>{"127.0.0.1"});
  EXPECT_FALSE(addresses_of("no such name"));
  // Port 1 of this machine is nobody's.
  const Status port = try_port("127.0.0.1", 1, seconds(10));
  ASSERT_FALSE(port);
  EXPECT_EQ(port.error().code, Errc::kLinkLost);
}

}  // namespace
}  // namespace seeker::doctor
