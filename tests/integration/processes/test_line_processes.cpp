// The lines of the newest scan, asked over real sockets from a simulated and from a recorded RPLIDAR.

#include <fstream>

#include "tests/integration/processes/daemon.hpp"

namespace seeker::testing {
namespace {

std::size_t count_in(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

/// The seven features of spec S5.1 for each line of what `seeker lines --json` prints.
void expect_seven_features_each(const std::string& output) {
  const std::size_t lines = count_in(output, "\"theta_rad\":");
  EXPECT_GE(lines, 2U) << output;
  for (const char* feature : {"theta_start_rad", "theta_end_rad", "distance_m", "length_m", "slope", "intercept_m"}) {
    EXPECT_EQ(count_in(output, "\"" + std::string(feature) + "\":"), lines) << feature << "\n" << output;
  }
}

TEST(LineProcesses, ASimulatedRplidarGivesSevenFeaturesOfEachLineAndAPicture) {
  const Daemon daemon({}, fresh_folder("lines"), source_file("config/robots/paper/lines-2017.yaml"));
  std::string output;
  EXPECT_EQ(seeker(daemon, {"lines", "--json"}, &output), 0) << output;
  expect_seven_features_each(output);
  EXPECT_NE(output.find("\"extractor\":\"five_modes\""), std::string::npos) << output;
  EXPECT_NE(output.find("\"has_quality\":true"), std::string::npos) << output;
  EXPECT_NE(output.find("\"corner_m\":0.025"), std::string::npos) << "the history of the thresholds: " << output;
  for (const char* name : {"lines.png", "lines.svg"}) {
    EXPECT_EQ(seeker(daemon, {"lines", "--out", daemon.folder() / name}, &output), 0) << output;
    EXPECT_GT(std::filesystem::file_size(daemon.folder() / name), 1000U) << name;
  }
}

TEST(LineProcesses, AReplayedRplidarGivesThemToo) {
  SEEKER_REQUIRE_DATA(log, "lidar/rplidar_a1/scans.csv.gz");
  const Daemon daemon({"--set", "replay.log=" + log.string(), "--set", "lines.extractor=five_modes"},
                      fresh_folder("lines-replayed"), source_file("config/robots/replay-rplidar.yaml"));
  std::string output;
  EXPECT_EQ(seeker(daemon, {"lines", "--json"}, &output), 0) << output;
  expect_seven_features_each(output);
  EXPECT_NE(output.find("\"beams\":720"), std::string::npos) << output;
}

}  // namespace
}  // namespace seeker::testing
