#include <gtest/gtest.h>

#include "server/lab/map_merging/reproduce_map_merging.hpp"

namespace seeker::lab {
namespace {

/// Three seconds of a run, a node in the second one.
std::vector<LoadSample> keyframes() {
  return {{.time_s = 0.0, .cpu_s = 0.01},
          {.time_s = 1.0, .cpu_s = 0.06, .pictures = 1, .features = 280, .node = true},
          {.time_s = 2.0, .cpu_s = 0.01}};
}
std::vector<LoadSample> frames() {
  std::vector<LoadSample> run = keyframes();
  for (LoadSample& sample : run) {
    sample.pictures = 1;
    sample.features = 290;
  }
  return run;
}

TEST(KeyframeCheck, PassesWhereFeaturesAreExtractedAtNodesOnly) {
  EXPECT_TRUE(check_keyframes(keyframes(), frames()).passed);
}

TEST(KeyframeCheck, APeakOfProcessorTimeElsewhereChangesNothing) {
  std::vector<LoadSample> run = keyframes();
  run[0].cpu_s = 10.0;
  EXPECT_TRUE(check_keyframes(run, frames()).passed);
}

TEST(KeyframeCheck, FailsWithoutNodesOrWithANodeThatHasNoFeatures) {
  std::vector<LoadSample> run = keyframes();
  run[1].features = 0;
  EXPECT_FALSE(check_keyframes(run, frames()).passed);
  run[1].node = false;
  EXPECT_FALSE(check_keyframes(run, frames()).passed);
}

TEST(KeyframeCheck, FailsWhereEverySecondIsANode) {
  std::vector<LoadSample> run = frames();
  run[0].node = run[2].node = true;
  EXPECT_FALSE(check_keyframes(run, frames()).passed);
}

TEST(KeyframeCheck, FailsForAPictureBetweenNodes) {
  std::vector<LoadSample> run = keyframes();
  run[2].pictures = 1;
  EXPECT_FALSE(check_keyframes(run, frames()).passed);
}

TEST(KeyframeCheck, ComparesTheTimeThatBothRunsLasted) {
  std::vector<LoadSample> longer = keyframes();
  longer.push_back({.time_s = 3.0, .cpu_s = 0.06, .pictures = 1, .features = 100'000, .node = true});
  EXPECT_TRUE(check_keyframes(longer, frames()).passed);
}

FleetResult merged_at(double time_s) {
  FleetResult run;
  run.pairs = 1;
  run.merged = 1;
  run.merged_at_s = time_s;
  return run;
}

TEST(PrintedMergeCheck, IsAFindingWhereRobotsAsPrintedDoNotMerge) {
  FleetResult run;
  run.pairs = 1;
  EXPECT_EQ(verdict_of(check_printed_merges({run})), "FINDING");
  EXPECT_EQ(verdict_of(check_printed_merges({merged_at(50.0)})), "PASS");
}

TEST(FalsePairCheck, WantsTheFalsePairRefusedInEachRunAndAcceptedInNone) {
  FleetResult run = merged_at(50.0);
  EXPECT_FALSE(check_false_pairs({run}).passed) << "it was never asked";
  run.injected = run.false_rejected = 3;
  EXPECT_TRUE(check_false_pairs({run}).passed);
  run.false_offered = 1;
  EXPECT_TRUE(check_false_pairs({run}).passed) << "as one of several, which nobody has to believe";
  run.false_accepted = 1;
  EXPECT_FALSE(check_false_pairs({run}).passed);
}

TEST(PosterCheck, WantsMoreMergesInTimeThanTheLaserAloneAndNoWrongOne) {
  const auto verdict = [](const FleetResult& pictures, const FleetResult& laser) {
    return verdict_of(check_posters("S4-POSTERS", {pictures}, {laser}));
  };
  EXPECT_EQ(verdict(merged_at(200.0), merged_at(400.0)), "PASS");
  EXPECT_EQ(verdict(merged_at(400.0), merged_at(200.0)), "FAIL");
  EXPECT_EQ(verdict(merged_at(400.0), merged_at(400.0)), "FAIL") << "neither in time";
  EXPECT_EQ(verdict(merged_at(200.0), merged_at(200.0)), "FINDING") << "there is nothing to raise";
  FleetResult wrong = merged_at(200.0);
  wrong.wrong = 1;
  EXPECT_EQ(verdict(wrong, merged_at(400.0)), "FAIL");
  EXPECT_EQ(verdict(wrong, merged_at(200.0)), "FAIL");
  EXPECT_EQ(verdict(merged_at(200.0), wrong), "PASS") << "a wrong merge is none";
}

}  // namespace
}  // namespace seeker::lab
