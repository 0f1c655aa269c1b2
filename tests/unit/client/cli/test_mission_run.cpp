#include "client/cli/mission_run.hpp"

#include <gtest/gtest.h>

#include "tests/unit/client/cli/cli_fixture.hpp"

namespace seeker::cli {
namespace {

class MissionRunTest : public ::testing::Test, public CliFixture {};

TEST_F(MissionRunTest, ReportHasItsOwnFindsWithoutThoseItWithdrew) {
  const auto find = [this](std::uint64_t id, const std::string& target) {
    api::Detection detection;
    detection.id = id;
    detection.target = target;
    detection.mission = host->values().mission->id;
    return detection;
  };
  const Ran ran = run({"recognise", "--solid", "sphere"}, [&] {
    while (!host->values().mission) {
      std::this_thread::yield();
    }
    api::Detection poster = find(3, "poster");
    host->publish(api::Topic::kDetection, {}, poster);
    poster.withdrawn = true;
    host->publish(api::Topic::kDetection, {}, poster);
    const api::Detection own = find(4, "board");
    host->edit([&](testing::FakeRobotValues& v) {
      v.detections.front().mission = "yesterday";
      v.detections.push_back(own);
    });
    end_mission(api::Outcome::kNotFoundAreaCovered);
  });
  EXPECT_NE(ran.err.find("withdrawn: poster"), std::string::npos) << ran.err;
  EXPECT_EQ(ran.out.find("found       poster"), std::string::npos) << ran.out;
  EXPECT_EQ(ran.out.find("exit-sign"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("found       board"), std::string::npos) << ran.out;
}

}  // namespace
}  // namespace seeker::cli
