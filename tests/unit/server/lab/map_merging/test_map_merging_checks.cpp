#include <gtest/gtest.h>

#include "server/lab/map_merging/reproduce_map_merging.hpp"

namespace seeker::lab {
namespace {

/// Three seconds of a run, a node in the second one.
std::vector<LoadSample> run_with_a_node() {
  return {{.time_s = 0.0, .loop_s = 0.01, .features_s = 0.05, .features = 300},
          {.time_s = 1.0, .loop_s = 0.01, .features_s = 0.05, .features = 280, .node = true},
          {.time_s = 2.0, .loop_s = 0.01, .features_s = 0.05, .features = 310}};
}

TEST(KeyframeCheck, PassesWhereFeaturesAreExtractedAtNodesOnly) {
  EXPECT_TRUE(check_keyframes(run_with_a_node()).passed);
}

TEST(KeyframeCheck, APeakOfProcessorTimeElsewhereChangesNothing) {
  std::vector<LoadSample> run = run_with_a_node();
  run[0].loop_s = 10.0;
  EXPECT_TRUE(check_keyframes(run).passed);
}

TEST(KeyframeCheck, FailsWithoutNodesOrWithANodeThatHasNoFeatures) {
  std::vector<LoadSample> run = run_with_a_node();
  run[1].features = 0;
  EXPECT_FALSE(check_keyframes(run).passed);
  run[1].node = false;
  EXPECT_FALSE(check_keyframes(run).passed);
}

TEST(KeyframeCheck, FailsWhereEverySecondIsANode) {
  std::vector<LoadSample> run = run_with_a_node();
  run[0].node = run[2].node = true;
  EXPECT_FALSE(check_keyframes(run).passed);
}

}  // namespace
}  // namespace seeker::lab
