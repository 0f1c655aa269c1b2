// The figures of a running robot, read as Prometheus reads them and judged by its own tool.

#include <fstream>

#include <gmock/gmock.h>

#include "tests/integration/processes/metrics_page.hpp"

namespace seeker::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* kPromtool = "/usr/bin/promtool";

TEST(MetricsProcesses, TheFiguresOfARobotWithAMissionAreThoseThatPrometheusReads) {
  if (!std::filesystem::exists(kCurl)) {
    GTEST_SKIP() << "curl is not installed";
  }
  const Daemon daemon({"--set", "metrics.port=0"}, fresh_folder("metrics"));
  std::string output;
  EXPECT_EQ(seeker(daemon, {"goto", "1,0"}, &output), 0) << output;
  const std::string page = read_page(page_of(daemon));
  EXPECT_THAT(page, HasSubstr("seeker_info{robot="));
  EXPECT_THAT(page, HasSubstr("seeker_connections_total 1\n"));
  EXPECT_THAT(page, HasSubstr("seeker_loop_part_seconds_bucket{part=\"estimate\""));
  EXPECT_THAT(page, HasSubstr("seeker_faults 0\n"));
  EXPECT_THAT(page, HasSubstr("seeker_placed 1\n"));
  if (!std::filesystem::exists(kPromtool)) {
    GTEST_SKIP() << "promtool (Debian package prometheus) is not installed: the form is not judged by a third party";
  }
  const std::filesystem::path file = daemon.folder() / "page";
  std::ofstream(file) << page;
  ChildProcess promtool("/bin/sh", {"-c", std::string(kPromtool) + " check metrics < " + file.string()},
                        fresh_folder("promtool") / "out");
  EXPECT_EQ(promtool.wait(kCall), 0) << promtool.output();
}

TEST(LogProcesses, EachLineIsAnObjectForPrograms) {
  ChildProcess daemon(program("seekerd"), {"--config", "no-such-robot", "--log-format", "json"},
                      fresh_folder("log-json") / "log");
  EXPECT_NE(daemon.wait(kStart), 0);
  EXPECT_THAT(daemon.output(),
              ::testing::MatchesRegex(
                  "\\{\"time\":\"[0-9-]+T[0-9:.]+Z\",\"level\":\"ERROR\",\"part\":\"seekerd\",\"text\":.*\\}\n"));
}

TEST(MetricsProcesses, APageForOtherMachinesIsRefused) {
  ChildProcess daemon(program("seekerd"),
                      {"--config", source_file("config/robots/sim.yaml"), "--set", "metrics.address=0.0.0.0"},
                      fresh_folder("metrics-open") / "log");
  constexpr int kConfig = 78;
  EXPECT_EQ(daemon.wait(kStart), kConfig);
  EXPECT_THAT(daemon.output(), HasSubstr("metrics.address"));
}

}  // namespace
}  // namespace seeker::testing
