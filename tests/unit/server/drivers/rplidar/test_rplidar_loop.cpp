// The session against the emulated device, over a line that cuts, damages and loses bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/scan_motion.hpp"
#include "tests/support/box_room.hpp"
#include "tests/unit/server/drivers/rplidar/virtual_line.hpp"

namespace seeker::drivers {
namespace {

using ::testing::HasSubstr;
using testing::VirtualLine;

const seeker::testing::BoxRoom kRoom;
const Pose2 kBase_T_laser{0.1, 0.05, 0.7};

RplidarParams host_params(RplidarScanMode mode = RplidarScanMode::kAutomatic) {
  RplidarParams params;
  params.scan_mode = mode;
  params.base_T_laser = kBase_T_laser;
  return params;
}

/// Where a base that drives by a twist is; it is in the room for the first seconds after kDeparture.
struct Drive {
  Twist2 twist;
  Pose2 room_T_start{0.3, -0.4, 0.5};
  RobotTime departure = robot_time_s(1000.0);

  [[nodiscard]] Pose2 room_T_base_at(RobotTime at) const {
    return room_T_start * integrate(twist, to_seconds(at - departure));
  }
};

emulator::RangeInDirection in_room(const Drive& drive) {
  return [drive](double bearing_rad, RobotTime at) {
    return std::optional(kRoom.range_m(drive.room_T_base_at(at) * kBase_T_laser * Pose2{0.0, 0.0, bearing_rad}));
  };
}

/// Shares of the beams of some scans.
struct Fit {
  double with_echo = 0.0;
  double on_wall = 0.0;  ///< of those with an echo, those that lie on a wall within their bound
};

/// `steps`: by how many steps of the grid a beam may be turned; `turn_error_rad`: how wrong its direction is besides.
Fit fit(const std::vector<LaserScan>& scans, const Drive& drive, double steps, double turn_error_rad = 0.0) {
  double beams = 0.0;
  double echoes = 0.0;
  double good = 0.0;
  for (const LaserScan& scan : scans) {
    const double direction_rad = steps * scan.angle_step_rad + turn_error_rad;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      beams += 1.0;
      const double range_m = scan.ranges_m[i];
      if (!std::isfinite(range_m)) {
        continue;
      }
      const Point2 p_laser(range_m * std::cos(scan.angle_rad(i)), range_m * std::sin(scan.angle_rad(i)));
      const Point2 p_room = drive.room_T_base_at(scan.stamp) * scan.base_T_laser * p_laser;
      constexpr double kRounding_m = 0.005;  // of ranges to a millimetre and of angles to 1/64 degree
      echoes += 1.0;
      good += kRoom.distance_from_walls_m(p_room) <= direction_rad * range_m + kRounding_m ? 1.0 : 0.0;
    }
  }
  return {beams > 0.0 ? echoes / beams : 0.0, echoes > 0.0 ? good / echoes : 0.0};
}

/// A return without a neighbour on its surface lies anywhere in its cell: half a step from its middle at most.
constexpr double kInCell = 0.5;
/// Two samples wide apart, one on each wall of a corner, have a beam between them that cuts it.
constexpr double kNotInCorners = 0.999;

struct Setting {
  const char* name;
  emulator::RplidarDeviceParams device;
  RplidarScanMode mode;
  double turns_per_s;
};

class RplidarLoop : public ::testing::TestWithParam<Setting> {};

TEST_P(RplidarLoop, EachTurnBecomesAScanOfTheRoom) {
  const Drive still;
  VirtualLine line(host_params(GetParam().mode), GetParam().device, in_room(still), 1);
  line.run(3.0);
  EXPECT_TRUE(line.session.state());
  const std::vector<LaserScan> scans = line.run(4.0);
  EXPECT_NEAR(static_cast<double>(scans.size()), 4.0 * GetParam().turns_per_s, 1.5);
  const Fit found = fit(scans, still, kInCell);
  // Where samples are wider apart than beams, some beams have none.
  EXPECT_GT(found.with_echo, GetParam().mode == RplidarScanMode::kLegacy ? 0.5 : 0.97);
  EXPECT_GE(found.on_wall, kNotInCorners);
  EXPECT_EQ(line.session.statistics().packets_bad, 0U);
  EXPECT_EQ(line.session.statistics().connects, 1U);
  EXPECT_FALSE(line.session.warning());
}

TEST_P(RplidarLoop, StampsAndSweepsTellWhenEachBeamWasMeasured) {
  const Drive drive{{0.5, 1.0}, {0.3, -0.4, 0.5}, robot_time_s(1002.0)};
  VirtualLine line(host_params(GetParam().mode), GetParam().device, in_room(drive), 2);
  line.run(2.5);
  const std::vector<LaserScan> scans = line.run(2.0);
  std::vector<LaserScan> corrected;
  for (const LaserScan& scan : scans) {
    corrected.push_back(corrected_for_motion(scan, [&](RobotTime at) { return drive.room_T_base_at(at); }));
  }
  ASSERT_GT(corrected.size(), 8U);
  // A beam is up to half a step from its cell, and up to one more when it is put back onto the grid. Bytes are handed
  // over some milliseconds late, in which the base turns as many thousandths of a radian.
  constexpr double kLate_rad = 0.006;
  EXPECT_GT(fit(corrected, drive, kInCell + 1.0, kLate_rad).on_wall, 0.999);
  EXPECT_LT(fit(scans, drive, kInCell + 1.0, kLate_rad).on_wall, 0.98) << "what the correction is for";
}

TEST_P(RplidarLoop, BitErrorsCostTheirCapsulesOnly) {
  const Drive still;
  VirtualLine line(host_params(GetParam().mode), GetParam().device, in_room(still), 3);
  line.bit_error_rate = 1e-4;
  line.run(6.0);
  const std::vector<LaserScan> scans = line.run(10.0);
  EXPECT_GT(static_cast<double>(scans.size()), 6.0 * GetParam().turns_per_s);
  const Fit found = fit(scans, still, kInCell);
  // Of 32 samples in 672 bits one in 15 is damaged, and the one before each cannot be decoded either.
  EXPECT_GT(found.with_echo, GetParam().mode == RplidarScanMode::kLegacy ? 0.5 : 0.8);
  // A sample alone has no checksum: 27 of its 40 bits can be wrong unnoticed.
  EXPECT_GT(found.on_wall, GetParam().mode == RplidarScanMode::kLegacy ? 0.99 : 0.999);
  EXPECT_GT(line.session.statistics().packets_bad, 10U);
}

TEST_P(RplidarLoop, LostBytesCostTheirCapsulesOnly) {
  const Drive still;
  VirtualLine line(host_params(GetParam().mode), GetParam().device, in_room(still), 4);
  line.run(2.0);
  line.byte_loss_rate = 5e-4;
  const std::vector<LaserScan> scans = line.run(10.0);
  EXPECT_GT(static_cast<double>(scans.size()), 6.0 * GetParam().turns_per_s);
  EXPECT_GT(fit(scans, still, kInCell).on_wall, 0.995);
}

TEST_P(RplidarLoop, SilenceIsNoticedAndTheScanGoesOnAfterIt) {
  const Drive still;
  VirtualLine line(host_params(GetParam().mode), GetParam().device, in_room(still), 5);
  line.run(3.0);
  EXPECT_TRUE(line.session.state());
  line.mute = true;
  line.run(1.5);
  EXPECT_EQ(line.session.state().error().code, Errc::kNotReady);
  line.run(10.0);
  ASSERT_TRUE(line.last_failure);
  EXPECT_EQ(line.last_failure->code, Errc::kLinkLost);
  line.mute = false;
  line.run(8.0);
  EXPECT_TRUE(line.session.state());
  const std::vector<LaserScan> scans = line.run(2.0);
  EXPECT_GT(static_cast<double>(scans.size()), 1.5 * GetParam().turns_per_s);
  EXPECT_GE(fit(scans, still, kInCell).on_wall, kNotInCorners);
  EXPECT_EQ(line.session.statistics().connects, 2U);
}

TEST_P(RplidarLoop, APowerCycleIsSurvived) {
  const Drive still;
  VirtualLine line(host_params(GetParam().mode), GetParam().device, in_room(still), 6);
  line.run(3.0);
  line.device.power_cycle(line.now);
  line.run(8.0);
  EXPECT_TRUE(line.session.state());
  const std::vector<LaserScan> scans = line.run(2.0);
  EXPECT_GT(static_cast<double>(scans.size()), 1.5 * GetParam().turns_per_s);
  EXPECT_EQ(fit(scans, still, kInCell).on_wall, 1.0);
}

TEST_P(RplidarLoop, ProtectionStopIsResetAndTheScanGoesOn) {
  const Drive still;
  VirtualLine line(host_params(GetParam().mode), GetParam().device, in_room(still), 7);
  line.run(3.0);
  line.device.stop_for_protection(0x8002);
  line.run(7.0);
  EXPECT_TRUE(line.session.state());
  EXPECT_GT(line.run(2.0).size(), 5U);
}

TEST_P(RplidarLoop, ABlockedRotorIsReportedAndForgottenWhenItIsFree) {
  const Drive still;
  VirtualLine line(host_params(GetParam().mode), GetParam().device, in_room(still), 8);
  line.run(3.0);
  line.device.block_rotor(true);
  line.run(30.0);
  ASSERT_TRUE(line.last_failure);
  EXPECT_THAT(line.last_failure->message, HasSubstr("rotor"));
  line.device.block_rotor(false);
  line.run(12.0);
  EXPECT_TRUE(line.session.state());
  EXPECT_GT(line.run(2.0).size(), 5U);
}

TEST_P(RplidarLoop, TheRightRateIsFoundWhereverItStandsInTheList) {
  RplidarParams params = host_params(GetParam().mode);
  params.bauds = {256'000, 115'200};
  VirtualLine line(params, GetParam().device, in_room(Drive{}), 9);
  line.run(6.0);
  EXPECT_TRUE(line.session.state());
  EXPECT_EQ(line.reopened, 0);
}

TEST_P(RplidarLoop, AWrongRateIsAFailureThatSaysWhatToCheck) {
  RplidarParams params = host_params(GetParam().mode);
  params.bauds = {9'600};
  VirtualLine line(params, GetParam().device, in_room(Drive{}), 10);
  EXPECT_TRUE(line.run(10.0).empty());
  ASSERT_TRUE(line.last_failure);
  EXPECT_EQ(line.last_failure->code, Errc::kLinkLost);
  EXPECT_THAT(line.last_failure->message, HasSubstr("bauds"));
  EXPECT_GE(line.reopened, 2);
}

TEST_P(RplidarLoop, TheFarewellStopsScanAndMotor) {
  VirtualLine line(host_params(GetParam().mode), GetParam().device, in_room(Drive{}), 11);
  line.run(3.0);
  EXPECT_TRUE(line.device.scanning());
  line.session.close(line.now);
  line.run(2.0);
  EXPECT_FALSE(line.device.scanning());
  EXPECT_EQ(line.device.rotation_hz() < 0.1, GetParam().device.accessory_board);
}

INSTANTIATE_TEST_SUITE_P(Devices, RplidarLoop,
                         ::testing::Values(Setting{"a1", emulator::rplidar_a1(), RplidarScanMode::kAutomatic, 5.5},
                                           Setting{"a1_legacy", emulator::rplidar_a1(), RplidarScanMode::kLegacy, 5.5},
                                           Setting{"a2", emulator::rplidar_a2(), RplidarScanMode::kAutomatic, 10.0},
                                           Setting{"a2_legacy", emulator::rplidar_a2(), RplidarScanMode::kLegacy,
                                                   10.0}),
                         [](const auto& setting) { return std::string(setting.param.name); });

TEST(RplidarSpecials, AScannerThatHangsSeesTheSameRoom) {
  RplidarParams params = host_params();
  params.upside_down = true;
  const Drive still;
  // Its own left is the robot's right.
  const auto mirrored = [room = in_room(still)](double bearing_rad, RobotTime at) { return room(-bearing_rad, at); };
  VirtualLine line(params, emulator::rplidar_a1(), mirrored, 12);
  line.run(3.0);
  const std::vector<LaserScan> scans = line.run(2.0);
  ASSERT_GT(scans.size(), 8U);
  EXPECT_EQ(fit(scans, still, kInCell).on_wall, 1.0);
}

TEST(RplidarSpecials, AWarningOfTheDeviceIsTold) {
  VirtualLine line(host_params(), emulator::rplidar_a1(), in_room(Drive{}), 13);
  line.device.warn(0x0101);
  line.run(3.0);
  EXPECT_TRUE(line.session.state());
  ASSERT_TRUE(line.session.warning());
}

}  // namespace
}  // namespace seeker::drivers
