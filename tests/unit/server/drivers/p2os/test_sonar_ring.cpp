#include <gtest/gtest.h>

#include "server/drivers/p2os/p2os_params.hpp"
#include "server/drivers/p2os/sonar_ring.hpp"

namespace seeker::drivers {
namespace {

class SonarRingTest : public ::testing::Test {
 protected:
  SonarRingTest() { ring.connect(*p2os::find_pioneer_model("p3dx-sh")); }
  void add(double at_s, std::vector<p2os::SipSonar> sonars) {
    p2os::Sip sip;
    sip.sonars = std::move(sonars);
    ring.add(sip, robot_time_s(at_s));
  }

  P2osParams params;
  SonarRing ring{params};
};

TEST_F(SonarRingTest, TheNewestReadingOfEachTransducerIsKept) {
  add(1.0, {{3, 1000}, {0, 2000}});
  add(1.1, {{3, 1100}});
  const auto scan = ring.take();
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->readings.size(), 2U);
  EXPECT_FLOAT_EQ(scan->readings[0].range_m, 2.0F);
  EXPECT_FLOAT_EQ(scan->readings[1].range_m, 1.1F);
  EXPECT_DOUBLE_EQ(scan->readings[1].base_T_sonar.x_m, 0.166);
  EXPECT_EQ(scan->stamp, robot_time_s(1.1));
  EXPECT_DOUBLE_EQ(scan->range_max_m, 5.0);
}

TEST_F(SonarRingTest, WithoutANewReadingThereIsNoScan) {
  EXPECT_FALSE(ring.take());
  add(1.0, {{3, 1000}});
  EXPECT_TRUE(ring.take());
  EXPECT_FALSE(ring.take());
  add(1.1, {});
  EXPECT_FALSE(ring.take());
}

TEST_F(SonarRingTest, AReadingAtTheLongestRangeIsNoReturn) {
  add(1.0, {{0, 4999}, {1, 5000}, {2, 0xFFFF}});
  const auto scan = ring.take();
  EXPECT_FLOAT_EQ(scan->readings[0].range_m, 4.999F);
  EXPECT_EQ(scan->readings[1].range_m, kNoReturn);
  EXPECT_EQ(scan->readings[2].range_m, kNoReturn);
}

TEST_F(SonarRingTest, ATransducerThatFellSilentIsLeftOut) {
  add(1.0, {{0, 1000}, {1, 1000}});
  add(2.5, {{1, 900}});
  EXPECT_EQ(ring.take()->readings.size(), 1U);
}

TEST_F(SonarRingTest, ATransducerOfNoKnownPoseIsIgnored) {
  add(1.0, {{16, 1000}, {255, 1000}});
  EXPECT_FALSE(ring.take());
}

}  // namespace
}  // namespace seeker::drivers
