#include "server/lab/map_merging/merge_command.hpp"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/lab/scoring/log_poses.hpp"
#include "server/lab/scoring/score_reference.hpp"
#include "server/store/map_file.hpp"
#include "tests/support/data.hpp"
#include "tests/support/maps/random_map.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

using testing::Pose2Near;

TEST(MergeSpan, IsWrittenInPerCent) {
  EXPECT_EQ(parse_span("0-50").value(), (LogSpan{0.0, 0.5}));
  EXPECT_EQ(parse_span("12.5-100").value(), (LogSpan{0.125, 1.0}));
  for (const char* wrong : {"", "50", "50-50", "60-40", "0-101", "-5-10", "0-50%", "a-b", "nan-50"}) {
    EXPECT_EQ(parse_span(wrong).error().code, Errc::kInvalidArgument) << wrong;
  }
}

class MergeOf : public LabFiles {
 protected:
  [[nodiscard]] static MergeOptions options(std::vector<std::filesystem::path> logs) {
    MergeOptions o;
    o.logs = std::move(logs);
    o.config = testing::source_file("config");
    return o;
  }
};

TEST_F(MergeOf, OneLogOrTooFewSpansIsRefused) {
  MergeOptions o = options({"a.clf"});
  EXPECT_EQ(merge_logs(o).error().code, Errc::kInvalidArgument);
  o.logs.emplace_back("b.clf");
  o.spans = {"0-50"};
  EXPECT_EQ(merge_logs(o).error().code, Errc::kInvalidArgument);
  o.spans = {};
  EXPECT_EQ(merge_logs(o).error().code, Errc::kNotFound);
}

TEST_F(MergeOf, SavedMapsAreTakenAsTheyAre) {
  Rng rng(7);
  store::MapFile file;
  file.origin.name = "room";
  file.map = testing::random_map(rng);
  for (const char* name : {"a.seekermap", "b.seekermap"}) {
    ASSERT_TRUE(store::write_map_file(folder() / name, file));
  }
  MergeOptions o = options({folder() / "a.seekermap", folder() / "b.seekermap"});
  const auto run = merge_logs(o);
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->logs[1].name, "b.seekermap");
  EXPECT_EQ(run->logs[1].run.map, file.map);
  o.spans = {"0-50", "50-100"};
  EXPECT_EQ(merge_logs(o).error().code, Errc::kInvalidArgument);
  std::ofstream(folder() / "b.seekermap") << "no map";
  o.spans = {};
  EXPECT_EQ(merge_logs(o).error().code, Errc::kParse);
}

/// How the map of a run lies in the localiser's common frame: by its trajectory.
Pose2 common_T_map(const SlamRun& run, const std::filesystem::path& log, const std::filesystem::path& corrections) {
  const auto localiser = read_trajectory(corrections);
  const auto odometry = read_log_poses(log);
  const Trajectory reference = apply_corrections(localiser->poses, odometry->odometry, 0.5);
  return score_reference(run.trajectory, reference, 0.5)->reference_T_map;
}

TEST_F(MergeOf, TwoRunsOfARealRobotMeetInTheCommonFrameOfTheirLocaliser) {
  SEEKER_REQUIRE_DATA(first, "lidar/p3dx/trace0.clf.gz");
  SEEKER_REQUIRE_DATA(second, "lidar/p3dx/trace1.clf.gz");
  SEEKER_REQUIRE_DATA(first_truth, "lidar/p3dx/trace0_map_to_odom.csv.gz");
  SEEKER_REQUIRE_DATA(second_truth, "lidar/p3dx/trace1_map_to_odom.csv.gz");
  const auto run = merge_logs(options({first, second}));
  ASSERT_TRUE(run) << run.error().message;
  ASSERT_TRUE(run->pairs.front().answer.merged()) << merge_text(*run);
  const Pose2 truth = inverse(common_T_map(run->logs[0].run, first, first_truth)) *
                      common_T_map(run->logs[1].run, second, second_truth);
  EXPECT_THAT(run->pairs.front().answer.hypotheses.front().a_T_b.a_T_b, Pose2Near(truth, 0.15, deg_to_rad(2.0)));
  // What was written can be read: the joint map is a map like any other.
  EXPECT_TRUE(validate(run->joint.map));
  EXPECT_EQ(run->joint.robots.size(), 2U);
  EXPECT_EQ(run->joint.map.keyframes.size(),
            run->logs[0].run.map.keyframes.size() + run->logs[1].run.map.keyframes.size());
}

TEST_F(MergeOf, TwoPartsOfALogWriteTheirTrajectoriesInTheJointMap) {
  SEEKER_REQUIRE_DATA(log, "lidar/p3dx/trace0.clf.gz");
  MergeOptions o = options({log, log});
  o.spans = {"0-60", "30-100"};
  o.out = folder() / "out";
  std::ostringstream out;
  const Status done = run_merge_command(o, out);
  ASSERT_TRUE(done) << done.error().message;
  const auto first = read_trajectory(o.out / "robot-1.tum");
  const auto second = read_trajectory(o.out / "robot-2.tum");
  ASSERT_TRUE(first && second) << out.str();
  // Both have the scans between 30 and 60 per cent, and say the same of where they were taken.
  const double shared_s = second->poses.front().stamp_s;
  const auto by_first = pose_at(first->poses, shared_s);
  ASSERT_TRUE(by_first);
  EXPECT_THAT(*by_first, Pose2Near(second->poses.front().map_T_base, 0.2, deg_to_rad(3.0)));
}

}  // namespace
}  // namespace seeker::lab
