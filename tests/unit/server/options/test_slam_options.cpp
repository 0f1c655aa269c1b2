#include "server/options/slam_options.hpp"

#include <gtest/gtest.h>

#include "common/config/yaml.hpp"

namespace seeker::slam {
namespace {

template <class T>
Status read(const std::string& text, T& params) {
  const auto document = config::Document::parse(text, "slam.yaml");
  return document ? document->read(params) : Status(tl::unexpected<Error>(document.error()));
}

TEST(SlamOptions, ReadWhatAFileSaysAndKeepTheRest) {
  LoopParams loop;
  ASSERT_TRUE(read("search: {max_points: 90, distinct_deg: 30}\nmax_window_m: 3\nsigma_floor_deg: 0.5\n", loop));
  EXPECT_EQ(loop.search.max_points, 90U);
  EXPECT_NEAR(loop.search.distinct_rad, 0.5235987755982988, 1e-12);
  EXPECT_DOUBLE_EQ(loop.search.min_score, LoopParams{}.search.min_score);
  EXPECT_DOUBLE_EQ(loop.max_window_m, 3.0);
  EXPECT_NEAR(loop.sigma_floor_rad, 0.008726646259971648, 1e-12);
  PlaceParams place;
  ASSERT_TRUE(read("judge: {min_lead: 0.2, through_weight: 0.3}\nagreement: {solid: 120}\n", place));
  EXPECT_DOUBLE_EQ(place.judge.min_lead, 0.2);
  EXPECT_DOUBLE_EQ(place.judge.through_weight, 0.3);
  EXPECT_EQ(place.agreement.solid, 120);
  PlaceMapParams map;
  ASSERT_TRUE(read("pyramid: {coarse_level: 2, direction_gate_deg: 45}\nfree_space: {min_beams: 5}\n", map));
  EXPECT_EQ(map.pyramid.coarse_level, 2);
  EXPECT_NEAR(map.pyramid.direction_gate_rad, 0.7853981633974483, 1e-12);
  EXPECT_EQ(map.free_space.min_beams, 5);
  PoseGraphParams graph;
  ASSERT_TRUE(read("graduation: 2\nstop_deg: 0.01\n", graph));
  EXPECT_DOUBLE_EQ(graph.graduation, 2.0);
  ConsistencyParams consistency;
  ASSERT_TRUE(read("gate_chi2: 7.815\n", consistency));
  EXPECT_DOUBLE_EQ(consistency.gate_chi2, 7.815);
}

TEST(SlamOptions, RefuseWhatNobodyKnows) {
  PlaceParams place;
  EXPECT_FALSE(read("judge: {minlead: 0.2}\n", place));
  LoopParams loop;
  EXPECT_FALSE(read("search: {max_points: many}\n", loop));
}

}  // namespace
}  // namespace seeker::slam
