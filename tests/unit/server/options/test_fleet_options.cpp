#include "server/options/fleet_options.hpp"

#include <gtest/gtest.h>

#include "common/config/yaml.hpp"

namespace seeker::fleet {
namespace {

Status read(const std::string& text, TopologicalParams& params) {
  const auto document = config::Document::parse(text, "topology.yaml");
  return document ? document->read(params) : Status(tl::unexpected<Error>(document.error()));
}

TEST(TopologyOptions, ReadWhatAFileSaysAndKeepTheRest) {
  TopologicalParams params;
  ASSERT_TRUE(
      read("tree: {corridor_width_m: 0.8, max_goal_span_deg: 90}\nnode_distance_m: 3\nauction: {near_m: 4}\n", params));
  EXPECT_DOUBLE_EQ(params.map.tree.corridor_width_m, 0.8);
  EXPECT_NEAR(params.map.tree.max_goal_span_rad, kPi / 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(params.map.node_distance_m, 3.0);
  EXPECT_DOUBLE_EQ(params.auction.near_m, 4.0);
  EXPECT_EQ(params.map.tree.layers, TopologicalParams{}.map.tree.layers);
}

TEST(TopologyOptions, PrintWhatTheyRead) {
  TopologicalParams params;
  params.map.max_edge_m = 6.25;
  params.retry_s = 12.5;
  TopologicalParams again;
  ASSERT_TRUE(read(config::print(params), again));
  EXPECT_DOUBLE_EQ(again.map.max_edge_m, 6.25);
  EXPECT_EQ(config::print(again), config::print(params));
}

TEST(TopologyOptions, RefuseWhatNobodyKnows) {
  TopologicalParams params;
  for (const char* text : {"trees: {}\n", "tree: {width_m: 1}\n", "auction: {price: 1}\n"}) {
    EXPECT_FALSE(read(text, params)) << text;
  }
}

Status read(const std::string& text, MergeParams& params) {
  const auto document = config::Document::parse(text, "merge.yaml");
  return document ? document->read(params) : Status(tl::unexpected<Error>(document.error()));
}

TEST(MergeOptions, ReadWhatAFileSaysAndKeepTheRest) {
  MergeParams params;
  ASSERT_TRUE(
      read("sure_shared_wall_m: 45\npair: {sigma_floor_deg: 1, icp: {keep: 0.7}}\noverlap: {settle_m: 0.2}\n"
           "deformation: {max_sigma_deg: 2}\n",
           params));
  EXPECT_DOUBLE_EQ(params.sure_shared_wall_m, 45.0);
  EXPECT_NEAR(params.pair.sigma_floor_rad, kPi / 180.0, 1e-12);
  EXPECT_DOUBLE_EQ(params.pair.icp.keep, 0.7);
  EXPECT_DOUBLE_EQ(params.overlap.settle_m, 0.2);
  EXPECT_NEAR(params.deformation.max_sigma_rad, 2.0 * kPi / 180.0, 1e-12);
  EXPECT_EQ(params.min_pairs, MergeParams{}.min_pairs);
}

TEST(MergeOptions, PrintWhatTheyRead) {
  MergeParams params;
  params.rival_ratio = 0.25;
  params.pictures.views.match.max_ratio = 0.7;
  MergeParams again;
  ASSERT_TRUE(read(config::print(params), again));
  EXPECT_DOUBLE_EQ(again.rival_ratio, 0.25);
  EXPECT_DOUBLE_EQ(again.pictures.views.match.max_ratio, 0.7);
  EXPECT_EQ(config::print(again), config::print(params));
}

TEST(MergeOptions, RefuseWhatNobodyKnowsAndWhatMakesNoSense) {
  MergeParams params;
  for (const char* text : {"sure_wall_m: 3\n", "pair: {icp: {starts: 1}}\n", "max_hypotheses: 17\n"}) {
    EXPECT_FALSE(read(text, params)) << text;
  }
}

}  // namespace
}  // namespace seeker::fleet
