// `seeker doctor` and `seeker audit` against robots that are well, that are not there, and whose certificate is over.

#include <regex>

#include <gmock/gmock.h>

#include "tests/integration/processes/daemon.hpp"
#include "tests/support/net/site.hpp"

namespace seeker::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kExitFailed = 1;

/// One call without a robot of a test.
std::pair<int, std::string> doctor(const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"doctor"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  ChildProcess client(program("seeker"), all, fresh_folder("doctor") / "out");
  const std::optional<int> code = client.wait(kStart);
  return {code.value_or(-1), client.output()};
}

TEST(DoctorProcesses, ARobotThatRunsIsExaminedFromTheOutsideAndFromWithin) {
  const Daemon daemon;
  std::string output;
  // A machine of tests may have a full disk or no time server, which is not the robot's fault: only words are judged.
  static_cast<void>(seeker(daemon, {"doctor"}, &output));
  for (const char* check : {"tls-files", "name", "session", "versions", "round-trip", "clocks", "lease", "estop",
                            "loop", "fault", "device", "robot-version", "robot-folder", "robot-disk", "robot-memory",
                            "robot-clock", "robot-journal", "robot-audit", "robot-certificate"}) {
    EXPECT_THAT(output, HasSubstr(std::string(" ") + check + " "));
  }
  EXPECT_THAT(output, HasSubstr("OK       robot-folder"));
  EXPECT_THAT(output, HasSubstr("OK       robot-journal"));
  EXPECT_THAT(output, HasSubstr("OK       device"));
  EXPECT_EQ(seeker(daemon, {"estop"}), 0);
  static_cast<void>(seeker(daemon, {"doctor"}, &output));
  EXPECT_THAT(output, HasSubstr("WARNING  estop"));
  EXPECT_THAT(output, HasSubstr("seeker estop --release"));
}

TEST(DoctorProcesses, WithoutARobotItSaysWhatToStart) {
  const auto [code, output] = doctor({"--robot", "127.0.0.1:1", "--tls", "none"});
  EXPECT_EQ(code, kExitFailed) << output;
  EXPECT_THAT(output, HasSubstr("OK       name"));
  EXPECT_THAT(output, HasSubstr("FAILED   port"));
  const auto [nowhere, named] = doctor({"--robot", "no-such-robot.invalid", "--tls", "none"});
  EXPECT_EQ(nowhere, kExitFailed);
  EXPECT_THAT(named, HasSubstr("FAILED   name"));
}

TEST(DoctorProcesses, ARobotWhoseCertificateHasExpiredIsFoundOut) {
  TestSite site;
  const pki::BundleFiles robot = site.issue_expired("sim-1", pki::Role::kRobot, {"127.0.0.1"});
  const pki::BundleFiles anna = site.issue("anna", pki::Role::kOperator);
  const Daemon daemon(tls_settings(robot));
  const std::string bundle = anna.certificate.parent_path().string();
  std::string output;
  EXPECT_EQ(seeker(daemon, {"doctor", "--tls", bundle}, &output), kExitFailed) << output;
  EXPECT_THAT(output, HasSubstr("OK       tls-certificate"));
  EXPECT_THAT(output, HasSubstr("OK       port"));
  EXPECT_THAT(output, HasSubstr("FAILED   session"));
  EXPECT_THAT(output, HasSubstr("expired"));

  const std::string own = site.issue_expired("ben", pki::Role::kOperator).certificate.parent_path().string();
  EXPECT_EQ(seeker(daemon, {"doctor", "--tls", own}, &output), kExitFailed) << output;
  EXPECT_THAT(output, HasSubstr("FAILED   tls-certificate"));
}

TEST(AuditProcesses, WhoCommandedWhatIsKnownAfterAKill) {
  const std::filesystem::path folder = fresh_folder("audit");
  {
    Daemon daemon({}, folder);
    EXPECT_EQ(seeker(daemon, {"estop", "--as", "anna"}), 0);
    EXPECT_EQ(seeker(daemon, {"goto", "1,0", "--as", "ben"}), 3) << "the emergency stop is latched";
    EXPECT_EQ(seeker(daemon, {"estop", "--release", "--as", "anna"}), 0);
    EXPECT_EQ(seeker(daemon, {"goto", "0.5,0", "--as", "ben", "--id", "short-way"}), 0);
    std::string output;
    EXPECT_EQ(seeker(daemon, {"audit", "--last", "100"}, &output), 0) << output;  // everything is on the disk then
    daemon.kill();
  }
  const Daemon daemon({}, folder);
  std::string output;
  EXPECT_EQ(seeker(daemon, {"audit", "--last", "100"}, &output), 0) << output;
  EXPECT_TRUE(
      std::regex_search(output, std::regex("Z  anna \\(operator\\) at 127\\.0\\.0\\.1:\\d+: set_estop engage: ok\n")))
      << output;
  EXPECT_THAT(output, HasSubstr("set_estop release: ok"));
  EXPECT_THAT(output, HasSubstr("start_mission mission 'short-way': goto over 1 waypoints: ok"));
  EXPECT_TRUE(std::regex_search(output, std::regex("start_mission [^\n]*: refused, "))) << output;
  EXPECT_EQ(seeker(daemon, {"audit", "--client", "anna"}, &output), 0) << output;
  EXPECT_THAT(output, Not(HasSubstr("start_mission")));
}

TEST(LoopProcesses, TicksThatAreLateAreCountedAndShown) {
  // A thousand times as fast as its world goes no loop can be in time.
  const Daemon daemon({"--set", "sim.speed=1000"});
  EXPECT_EQ(seeker(daemon, {"goto", "1,0"}), 0);
  std::string output;
  EXPECT_EQ(seeker(daemon, {"status"}, &output), 0);
  EXPECT_TRUE(std::regex_search(output, std::regex("loop +\\d+ ticks, [1-9]\\d* late by more than 20 ms"))) << output;
  EXPECT_EQ(seeker(daemon, {"status", "--json"}, &output), 0);
  EXPECT_TRUE(std::regex_search(output, std::regex("\"timing\":\\{\"ticks\":\\d+,\"late\":[1-9]"))) << output;
  static_cast<void>(seeker(daemon, {"doctor"}, &output));
  EXPECT_TRUE(std::regex_search(output, std::regex("WARNING  loop +[1-9]\\d* of \\d+ ticks"))) << output;
}

}  // namespace
}  // namespace seeker::testing
