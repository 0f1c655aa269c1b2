#include "server/drivers/merged/merged_lidar.hpp"

#include <utility>

#include <gtest/gtest.h>

namespace seeker::drivers {
namespace {

class FakeLidar final : public LidarDriver {
 public:
  Status activate() override {
    active = opens;
    return opens ? Status{} : Status(fail(Errc::kIo, "no such port; check the cable"));
  }
  void deactivate() override { active = false; }
  Result<std::optional<LaserScan>> read() override { return std::exchange(next, std::nullopt); }
  [[nodiscard]] std::vector<DeviceFault> faults() const override { return broken; }
  [[nodiscard]] std::optional<LinkStatistics> statistics() const override { return LinkStatistics{.bytes_in = 5}; }

  void give(double stamp_s, float range_m) {
    next.emplace();
    next->stamp = robot_time_s(stamp_s);
    next->angle_step_rad = 0.1;
    next->range_max_m = 8.0;
    next->base_T_laser = mount;
    next->ranges_m = {range_m};
  }

  Pose2 mount;
  bool opens = true;
  bool active = false;
  std::optional<LaserScan> next;
  std::vector<DeviceFault> broken;
};

class TwoLidars : public ::testing::Test {
 protected:
  TwoLidars() {
    back->mount = {0.0, 0.0, 3.14159265};
    EXPECT_TRUE(both.activate());
  }
  [[nodiscard]] LaserScan read() {
    const auto scan = both.read();
    EXPECT_TRUE(scan && *scan);
    return scan && *scan ? **scan : LaserScan{};
  }

  static constexpr std::size_t kAhead = 360;
  static constexpr std::size_t kBehind = 0;
  std::shared_ptr<FakeLidar> front = std::make_shared<FakeLidar>();
  std::shared_ptr<FakeLidar> back = std::make_shared<FakeLidar>();
  Pose2 now_T_past{0.5, 0.0, 0.0};  ///< the base was half a metre ahead before time 10
  MergedLidar both{{front, back}, [this](RobotTime stamp) {
                     return std::optional(stamp < robot_time_s(10.0) ? now_T_past : Pose2{});
                   }};
};

TEST_F(TwoLidars, GiveOneScanAtThePaceOfTheFirst) {
  back->give(1.0, 3.0F);
  EXPECT_FALSE(both.read()->has_value());
  front->give(1.1, 2.0F);
  const LaserScan scan = read();
  EXPECT_EQ(scan.stamp, robot_time_s(1.1));
  EXPECT_FLOAT_EQ(scan.ranges_m[kAhead], 2.0F);
  EXPECT_NEAR(scan.ranges_m[kBehind], 3.0F, 1e-4F);
  EXPECT_FALSE(both.read()->has_value());
}

TEST_F(TwoLidars, TakeTheMotionBetweenTheirScansOut) {
  back->give(9.9, 3.0F);
  front->give(10.0, 2.0F);
  EXPECT_NEAR(read().ranges_m[kBehind], 2.5F, 1e-4F);
}

TEST_F(TwoLidars, LeaveOutAScanThatIsTooOldAndSayThatItsScannerIsSilent) {
  back->give(1.0, 3.0F);
  front->give(1.0, 2.0F);
  (void)read();
  EXPECT_TRUE(both.faults().empty());
  front->give(2.0, 2.0F);
  EXPECT_EQ(read().quality[kBehind], 0);
  ASSERT_EQ(both.faults().size(), 1U);
  EXPECT_EQ(both.faults().front().id, "silent-2");
  EXPECT_TRUE(both.faults().front().blocking);
  back->give(2.0, 3.0F);
  front->give(2.1, 2.0F);
  (void)read();
  EXPECT_TRUE(both.faults().empty());
}

TEST_F(TwoLidars, SayThatAScannerIsSilentThatNeverSpoke) {
  front->give(1.0, 2.0F);
  (void)read();
  EXPECT_TRUE(both.faults().empty());
  front->give(1.6, 2.0F);
  (void)read();
  ASSERT_EQ(both.faults().size(), 1U);
}

TEST_F(TwoLidars, PassFaultsErrorsAndCountsOn) {
  front->broken = {{"lost", "no line", "check the cable"}};
  back->broken = front->broken;
  ASSERT_EQ(both.faults().size(), 2U);
  EXPECT_EQ(both.faults()[0].id, "lost");
  EXPECT_EQ(both.faults()[1].id, "lost-2");
  EXPECT_EQ(both.statistics()->bytes_in, 10U);
  back->give(1.0, -1.0F);
  const auto scan = both.read();
  ASSERT_FALSE(scan);
  EXPECT_NE(scan.error().message.find("scanner 2"), std::string::npos);
}

TEST_F(TwoLidars, CloseTheFirstWhereTheSecondDoesNotOpen) {
  both.deactivate();
  back->opens = false;
  EXPECT_FALSE(both.activate());
  EXPECT_FALSE(front->active);
}

}  // namespace
}  // namespace seeker::drivers
