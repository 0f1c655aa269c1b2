#include "server/options/explore_options.hpp"

#include <gtest/gtest.h>

#include "common/config/yaml.hpp"

namespace seeker::explore {
namespace {

Status read(const std::string& text, ExploreParams& params) {
  const auto document = config::Document::parse(text, "explore.yaml");
  return document ? document->read(params) : Status(tl::unexpected<Error>(document.error()));
}

TEST(ExploreOptions, ReadWhatAFileSaysAndKeepTheRest) {
  ExploreParams params;
  ASSERT_TRUE(read(
      "one_step: {v_m_s: [0.1, 0.2], omega_deg_s: [-90, 0, 90], stop_and_go: false, sensor: {half_angle_deg: 45}}\n"
      "wall: {distance_m: 0.8}\nroam: {omega_deg_s: 180}\nviewpoints: {horizon: 2}\nguard: {regain_time_s: 60}\n"
      "driver: {max_failures: 4, follower: {max_v_m_s: 0.3}}\ncost: {robot_radius_m: 0.3}\nmap_period_s: 2\n",
      params));
  EXPECT_EQ(params.one_step.v_m_s, (std::vector<double>{0.1, 0.2}));
  ASSERT_EQ(params.one_step.omega_rad_s.size(), 3U);
  EXPECT_NEAR(params.one_step.omega_rad_s[0], -kPi / 2.0, 1e-12);
  EXPECT_FALSE(params.one_step.stop_and_go);
  EXPECT_NEAR(params.one_step.sensor.half_angle_rad, kPi / 4.0, 1e-12);
  EXPECT_DOUBLE_EQ(params.wall.distance_m, 0.8);
  EXPECT_NEAR(params.roam.omega_rad_s, kPi, 1e-12);
  EXPECT_EQ(params.viewpoints.horizon, 2);
  EXPECT_DOUBLE_EQ(params.guard.regain_time_s, 60.0);
  EXPECT_EQ(params.driver.max_failures, 4);
  EXPECT_DOUBLE_EQ(params.driver.follower.max_v_m_s, 0.3);
  EXPECT_DOUBLE_EQ(params.cost.robot_radius_m, 0.3);
  EXPECT_DOUBLE_EQ(params.map_period_s, 2.0);
  EXPECT_DOUBLE_EQ(params.one_step.observation_period_s, ExploreParams{}.one_step.observation_period_s);
  EXPECT_TRUE(validate(params));
}

TEST(ExploreOptions, PrintWhatTheyRead) {
  ExploreParams params;
  params.one_step.omega_rad_s = {-0.25, 0.25};
  params.guard.battery_reserve_v = 12.25;
  ExploreParams again;
  ASSERT_TRUE(read(config::print(params), again));
  EXPECT_NEAR(again.one_step.omega_rad_s[0], -0.25, 1e-12);
  EXPECT_DOUBLE_EQ(again.guard.battery_reserve_v, 12.25);
  EXPECT_EQ(config::print(again), config::print(params));
}

TEST(ExploreOptions, RefuseWhatNobodyKnows) {
  ExploreParams params;
  for (const char* text : {"one_steps: {}\n", "one_step: {omega_rad_s: [1]}\n", "wall: {distnace_m: 1}\n",
                           "roam: {speed: 1}\n", "viewpoints: {horizon: far}\n", "guard: {battery: 11}\n"}) {
    const Status refused = read(text, params);
    ASSERT_FALSE(refused) << text;
    EXPECT_NE(refused.error().message.find("explore.yaml:1: "), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace seeker::explore
