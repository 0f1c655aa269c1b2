// The sequences of the manufacturer's SDK (protocols 3.4) and of hosts that do worse, byte by byte.
#include "server/emulator/devices/rplidar_device.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/protocols/rplidar/answer_reader.hpp"
#include "server/protocols/rplidar/capsule_chain.hpp"

namespace seeker::emulator {
namespace {

using rplidar::Answer;
using rplidar::AnswerType;
using rplidar::Command;
using rplidar::ConfType;
using std::chrono::milliseconds;
using ::testing::IsEmpty;
using Bytes = std::vector<std::uint8_t>;

constexpr double kFront_m = 3.0;
constexpr double kElsewhere_m = 2.0;

/// A wall all round at 2 m; within 30 degrees to the left of the front at 3 m.
std::optional<double> two_walls(double bearing_rad, RobotTime /*at*/) {
  return bearing_rad > 0.0 && bearing_rad < deg_to_rad(30.0) ? kFront_m : kElsewhere_m;
}

/// A device and a host that sends it requests.
class Bench {
 public:
  explicit Bench(const RplidarDeviceParams& params) : device(params, two_walls) { device.pass(now); }

  /// Sends the bytes one by one and returns what the device answers at once.
  Bytes send(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      device.receive(std::span(&byte, 1), now);
    }
    return device.take_output();
  }
  Bytes send(const rplidar::Request& request) { return send(rplidar::encode(request)); }
  Bytes send(Command command) { return send(rplidar::Request{command, {}}); }
  /// Lets time pass, waking the device when it wants.
  Bytes wait(Duration duration) {
    const RobotTime end = now + duration;
    Bytes bytes;
    while (now < end) {
      now = std::clamp(device.wake(), now + Duration(1), end);
      device.pass(now);
      const Bytes more = device.take_output();
      bytes.insert(bytes.end(), more.begin(), more.end());
    }
    return bytes;
  }

  RobotTime now = robot_time_s(100.0);
  RplidarDevice device;
};

template <class T>
std::vector<T> read(AnswerType type, const Bytes& bytes) {
  rplidar::AnswerReader reader;
  reader.expect(type);
  std::vector<T> values;
  for (const Answer& answer : reader.read(bytes)) {
    values.push_back(std::get<T>(answer.value));
  }
  return values;
}

std::vector<rplidar::PolarSample> decode_capsules(const Bytes& bytes) {
  rplidar::CapsuleChain chain;
  std::vector<rplidar::PolarSample> samples;
  for (const rplidar::ExpressCapsule& capsule : read<rplidar::ExpressCapsule>(AnswerType::kExpressScan, bytes)) {
    if (const auto more = chain.add(capsule, false)) {
      samples.insert(samples.end(), more->begin(), more->end());
    }
  }
  return samples;
}

const Bytes kDesiredSpeed = rplidar::encode(rplidar::get_conf(ConfType::kDesiredSpeed));

TEST(RplidarDevice, AnA1AnswersTheSequenceOfTheSdk) {
  Bench bench(rplidar_a1());
  const Bytes info = rplidar::encode(rplidar_a1().info);
  EXPECT_EQ(bench.send(Command::kGetInfo), info);
  EXPECT_EQ(bench.send(Command::kGetInfo), info);
  EXPECT_EQ(bench.send(Command::kGetHealth), rplidar::encode(rplidar::Health{}));
  EXPECT_THAT(bench.send(kDesiredSpeed), IsEmpty()) << "its firmware is too old for that";
  EXPECT_THAT(bench.wait(std::chrono::seconds(2)), IsEmpty()) << "the SDK waits in vain";
  EXPECT_THAT(bench.send(Command::kStop), IsEmpty());
  EXPECT_EQ(bench.send(Command::kGetInfo), info);
  EXPECT_EQ(bench.send(Command::kGetInfo), info);
  EXPECT_THAT(bench.send(Command::kStop), IsEmpty());
  EXPECT_EQ(bench.send(Command::kGetInfo), info);
  EXPECT_EQ(bench.send(Command::kGetInfo), info);
  EXPECT_EQ(bench.send(Command::kGetSampleRate), rplidar::encode(rplidar::SampleRate{500, 250}));
  EXPECT_THAT(bench.send(kDesiredSpeed), IsEmpty());
  bench.wait(std::chrono::seconds(2));
  EXPECT_EQ(bench.send(Bytes{0xA5, 0x82, 0x05, 0, 0, 0, 0, 0, 0x22}), (Bytes{0xA5, 0x5A, 0x54, 0, 0, 0x40, 0x82}));
  EXPECT_EQ(bench.wait(milliseconds(81)).size(), 10 * rplidar::kCapsuleBytes) << "32 samples in 8 ms";
  bench.send(Command::kStop);
  EXPECT_THAT(bench.wait(milliseconds(100)), IsEmpty());
}

TEST(RplidarDevice, AnA2AnswersTheSequenceOfTheSdk) {
  Bench bench(rplidar_a2());
  const Bytes info = rplidar::encode(rplidar_a2().info);
  const auto conf = [&](ConfType type, const Bytes& data) {
    const bool of_mode = type != ConfType::kTypicalMode && type != ConfType::kDesiredSpeed;
    const Bytes answer = bench.send(of_mode ? rplidar::get_conf(type, 1) : rplidar::get_conf(type));
    EXPECT_EQ(answer, rplidar::encode(rplidar::ConfAnswer{type, data})) << static_cast<unsigned>(type);
  };
  EXPECT_EQ(bench.send(Command::kGetInfo), info);
  EXPECT_EQ(bench.send(Bytes{0xA5, 0xFF, 0x04, 0, 0, 0, 0, 0x5E}), (Bytes{0xA5, 0x5A, 4, 0, 0, 0, 0xFF, 1, 0, 0, 0}));
  EXPECT_EQ(bench.send(Command::kGetInfo), info);
  EXPECT_EQ(bench.send(Command::kGetHealth), rplidar::encode(rplidar::Health{}));
  conf(ConfType::kDesiredSpeed, {0x58, 0x02, 0x94, 0x02});  // 600 rpm, 660
  EXPECT_THAT(bench.send(Bytes{0xA5, 0xF0, 0x02, 0x94, 0x02, 0xC1}), IsEmpty());
  EXPECT_THAT(bench.send(Command::kStop), IsEmpty());
  EXPECT_THAT(bench.send(Bytes{0xA5, 0xF0, 0x02, 0, 0, 0x57}), IsEmpty());
  EXPECT_EQ(bench.send(Command::kGetInfo), info);
  EXPECT_EQ(bench.send(Command::kGetInfo), info);
  EXPECT_EQ(bench.send(Bytes{0xA5, 0x84, 0x04, 0x7C, 0, 0, 0, 0x59}),
            rplidar::encode(rplidar::ConfAnswer{ConfType::kTypicalMode, {1, 0}}));
  bench.send(Command::kStop);
  bench.send(rplidar::set_motor_pwm(0));
  conf(ConfType::kSamplePeriod, {0x00, 0xFA, 0, 0});  // 250 us with 8 binary digits
  conf(ConfType::kMaxDistance, {0x00, 0x0C, 0, 0});   // 12 m
  conf(ConfType::kAnswerType, {0x82});
  conf(ConfType::kModeName, {'E', 'x', 'p', 'r', 'e', 's', 's', 0});
  conf(ConfType::kDesiredSpeed, {0x58, 0x02, 0x94, 0x02});
  bench.send(rplidar::set_motor_pwm(660));
  bench.wait(std::chrono::seconds(2));
  EXPECT_NEAR(bench.device.rotation_hz(), 10.0, 0.3);
  EXPECT_EQ(bench.send(rplidar::express_scan(1)), (Bytes{0xA5, 0x5A, 0x54, 0, 0, 0x40, 0x82}));
  EXPECT_EQ(bench.wait(milliseconds(81)).size(), 10 * rplidar::kCapsuleBytes);
  bench.send(Command::kStop);
  bench.send(rplidar::set_motor_pwm(0));
  bench.wait(std::chrono::seconds(2));
  EXPECT_LT(bench.device.rotation_hz(), 0.1);
}

TEST(RplidarDevice, AnA2WithoutPwmSendsNoSamplesUnlessForced) {
  Bench bench(rplidar_a2());
  EXPECT_EQ(bench.send(Command::kScan), (Bytes{0xA5, 0x5A, 0x05, 0, 0, 0x40, 0x81}));
  EXPECT_THAT(bench.wait(std::chrono::seconds(1)), IsEmpty());
  bench.send(Command::kForceScan);
  EXPECT_EQ(bench.wait(milliseconds(100)).size(), 200 * rplidar::kLegacyBytes);
}

TEST(RplidarDevice, LegacySamplesShowTheWallsClockwise) {
  Bench bench(rplidar_a1());
  Bytes bytes = bench.send(Command::kScan);
  const Bytes stream = bench.wait(std::chrono::seconds(1));
  bytes.insert(bytes.end(), stream.begin(), stream.end());
  const auto samples = read<rplidar::LegacySample>(AnswerType::kLegacyScan, bytes);
  ASSERT_GT(samples.size(), 1900U);
  int turns = 0;
  for (const rplidar::LegacySample& sample : samples) {
    const rplidar::PolarSample polar = rplidar::to_polar(sample);
    const double cw_deg = rad_to_deg(polar.angle_cw_rad);
    if (std::abs(cw_deg - 330.0) > 0.1 && cw_deg > 0.1 && cw_deg < 359.9) {
      EXPECT_FLOAT_EQ(polar.range_m, static_cast<float>(cw_deg > 330.0 ? kFront_m : kElsewhere_m)) << cw_deg;
    }
    turns += sample.begins_revolution ? 1 : 0;
  }
  EXPECT_NEAR(turns, 5.5, 0.6);
}

TEST(RplidarDevice, CapsulesShowTheWallsWhereSamplesDo) {
  Bench bench(rplidar_a1());
  Bytes bytes = bench.send(rplidar::express_scan(0));
  const Bytes stream = bench.wait(std::chrono::seconds(1));
  bytes.insert(bytes.end(), stream.begin(), stream.end());
  const auto samples = decode_capsules(bytes);
  ASSERT_GT(samples.size(), 3800U);
  for (const rplidar::PolarSample& sample : samples) {
    const double cw_deg = rad_to_deg(sample.angle_cw_rad);
    if (std::abs(cw_deg - 330.0) > 0.2 && cw_deg > 0.2 && cw_deg < 359.8) {
      EXPECT_FLOAT_EQ(sample.range_m, static_cast<float>(cw_deg > 330.0 ? kFront_m : kElsewhere_m)) << cw_deg;
    }
  }
}

TEST(RplidarDevice, AMotorThatStartsAfterTheScanWasRequestedMeasuresAllTheSame) {
  Bench bench(rplidar_a2());
  bench.send(rplidar::express_scan(0));
  EXPECT_TRUE(bench.wait(std::chrono::seconds(1)).empty()) << "the rotor stands";
  bench.send(rplidar::set_motor_pwm(660));
  EXPECT_TRUE(bench.device.scanning());
  EXPECT_GT(bench.wait(std::chrono::seconds(3)).size(), 10'000U);
}

TEST(RplidarDevice, CompensationsStayWhereAllProgramsAgree) {
  RplidarDevice device(rplidar_a1(), [](double, RobotTime) { return 0.05; });
  RobotTime now = robot_time_s(1.0);
  device.receive(rplidar::encode(rplidar::express_scan(0)), now);
  now += milliseconds(500);
  device.pass(now);
  const auto capsules = read<rplidar::ExpressCapsule>(AnswerType::kExpressScan, device.take_output());
  ASSERT_GT(capsules.size(), 50U);
  for (const rplidar::ExpressCapsule& capsule : capsules) {
    for (const rplidar::CapsuleSample& sample : capsule.samples) {
      EXPECT_GT(sample.compensation_q3, 0);
      EXPECT_LT(sample.compensation_q3, 32);
    }
  }
}

TEST(RplidarDevice, TurnsHaveDifferentNumbersOfSamples) {
  Bench bench(rplidar_a1());
  Bytes bytes = bench.send(Command::kScan);
  const Bytes stream = bench.wait(std::chrono::seconds(4));
  bytes.insert(bytes.end(), stream.begin(), stream.end());
  std::vector<int> turns{0};
  for (const rplidar::LegacySample& sample : read<rplidar::LegacySample>(AnswerType::kLegacyScan, bytes)) {
    if (sample.begins_revolution) {
      turns.push_back(0);
    }
    ++turns.back();
  }
  ASSERT_GT(turns.size(), 10U);
  const auto [least, most] = std::minmax_element(turns.begin() + 1, turns.end() - 1);
  EXPECT_GT(*most - *least, 3);
  EXPECT_LT(*most - *least, 30);
}

TEST(RplidarDevice, AnyRequestEndsTheScan) {
  Bench bench(rplidar_a1());
  bench.send(Command::kScan);
  EXPECT_TRUE(bench.device.scanning());
  bench.wait(milliseconds(20));
  EXPECT_EQ(bench.send(Command::kGetHealth), rplidar::encode(rplidar::Health{}));
  EXPECT_FALSE(bench.device.scanning());
  EXPECT_THAT(bench.wait(milliseconds(100)), IsEmpty());
}

TEST(RplidarDevice, ResetIsDeafForAWhileAndThenPrintsItsBanner) {
  Bench bench(rplidar_a1());
  EXPECT_THAT(bench.send(Command::kReset), IsEmpty());
  EXPECT_THAT(bench.send(Command::kGetInfo), IsEmpty());
  const Bytes banner = bench.wait(milliseconds(700));
  EXPECT_THAT(std::string(banner.begin(), banner.end()), ::testing::StartsWith("RP LIDAR System.\r\n"));
  EXPECT_EQ(bench.send(Command::kGetInfo), rplidar::encode(rplidar_a1().info));
}

TEST(RplidarDevice, ProtectionStopRefusesScansUntilItIsReset) {
  Bench bench(rplidar_a1());
  bench.send(Command::kScan);
  bench.device.stop_for_protection(0x8002);
  EXPECT_THAT(bench.wait(milliseconds(50)), IsEmpty());
  EXPECT_EQ(bench.send(Command::kGetHealth),
            rplidar::encode(rplidar::Health{rplidar::HealthStatus::kProtectionStop, 0x8002}));
  EXPECT_THAT(bench.send(Command::kScan), IsEmpty());
  EXPECT_THAT(bench.send(rplidar::express_scan(0)), IsEmpty());
  bench.send(Command::kReset);
  bench.wait(milliseconds(700));
  EXPECT_EQ(bench.send(Command::kGetHealth), rplidar::encode(rplidar::Health{}));
  EXPECT_FALSE(bench.send(Command::kScan).empty());
}

TEST(RplidarDevice, ABlockedRotorLeadsToProtectionStop) {
  Bench bench(rplidar_a1());
  bench.send(Command::kScan);
  bench.device.block_rotor(true);
  EXPECT_THAT(bench.wait(std::chrono::seconds(2)), IsEmpty());
  bench.device.block_rotor(false);
  const auto health = read<rplidar::Health>(AnswerType::kHealth, bench.send(Command::kGetHealth));
  ASSERT_EQ(health.size(), 1U);
  EXPECT_EQ(health.front().status, rplidar::HealthStatus::kProtectionStop);
}

TEST(RplidarDevice, AWarningIsReportedAndScansGoOn) {
  Bench bench(rplidar_a1());
  bench.device.warn(0x0101);
  EXPECT_EQ(bench.send(Command::kGetHealth), rplidar::encode(rplidar::Health{rplidar::HealthStatus::kWarning, 0x0101}));
  EXPECT_FALSE(bench.send(Command::kScan).empty());
}

TEST(RplidarDevice, APowerCycleStopsTheMotorOfAnA2) {
  Bench bench(rplidar_a2());
  bench.send(rplidar::set_motor_pwm(660));
  bench.wait(std::chrono::seconds(2));
  bench.send(Command::kScan);
  bench.device.power_cycle(bench.now);
  EXPECT_FALSE(bench.device.scanning());
  bench.wait(std::chrono::seconds(2));
  EXPECT_LT(bench.device.rotation_hz(), 0.1);
  EXPECT_EQ(bench.send(Command::kGetInfo), rplidar::encode(rplidar_a2().info));
}

TEST(RplidarDevice, HalfARequestDoesNotSwallowTheNextOne) {
  Bench bench(rplidar_a2());
  EXPECT_THAT(bench.send(Bytes{0xA5, 0x84, 0x20, 0x7C}), IsEmpty());
  bench.wait(milliseconds(150));
  EXPECT_EQ(bench.send(Command::kGetInfo), rplidar::encode(rplidar_a2().info));
}

TEST(RplidarDevice, OutputThatNobodyTakesIsBounded) {
  Bench bench(rplidar_a1());
  bench.send(Command::kScan);
  for (int k = 0; k < 100; ++k) {
    bench.now += milliseconds(500);
    bench.device.pass(bench.now);
  }
  EXPECT_LE(bench.device.take_output().size(), 65'536U);
}

RC_GTEST_PROP(RplidarDevice, StandsUpToAnyBytesAtAnyTime, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const RplidarDeviceParams params = rng.below(2) == 0 ? rplidar_a1() : rplidar_a2();
  Bench bench(params);
  for (int k = 0; k < 100; ++k) {
    Bytes bytes(rng.below(8));
    for (std::uint8_t& byte : bytes) {
      byte = static_cast<std::uint8_t>(rng.below(3) == 0 ? rplidar::kRequestStart : rng.below(256));
    }
    bench.send(bytes);
    bench.wait(milliseconds(rng.below(30)));
  }
  bench.wait(std::chrono::seconds(1));
  bench.send(Command::kStop);
  RC_ASSERT(bench.send(Command::kGetInfo) == rplidar::encode(params.info));
}

}  // namespace
}  // namespace seeker::emulator
