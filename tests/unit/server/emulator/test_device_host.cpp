#include "server/emulator/device_host.hpp"

#include <bit>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

namespace seeker::emulator {
namespace {

/// Sends what it was given to say, and keeps what it hears.
struct TalkingDevice final : EmulatedDevice {
  void receive(std::span<const std::uint8_t> bytes, RobotTime /*now*/) override {
    heard.insert(heard.end(), bytes.begin(), bytes.end());
  }
  void pass(RobotTime /*now*/) override {}
  [[nodiscard]] RobotTime wake() const override { return {}; }
  [[nodiscard]] std::vector<std::uint8_t> take_output() override { return std::exchange(to_say, {}); }
  [[nodiscard]] std::uint32_t baud() const override { return rate; }
  void power_cycle(RobotTime /*now*/) override { ++cycles; }

  std::vector<std::uint8_t> to_say;
  std::vector<std::uint8_t> heard;
  std::uint32_t rate = 9600;
  int cycles = 0;
};

/// A line whose host is the test.
struct TestLine final : DeviceLine {
  [[nodiscard]] Status plug() override {
    plugged = true;
    return {};
  }
  void unplug() override { plugged = false; }
  [[nodiscard]] std::vector<std::uint8_t> receive() override { return std::exchange(from_host, {}); }
  void send(std::span<const std::uint8_t> bytes) override { to_host.insert(to_host.end(), bytes.begin(), bytes.end()); }
  [[nodiscard]] std::uint32_t host_baud() const override { return rate; }
  [[nodiscard]] std::string address() const override { return "/test"; }

  std::vector<std::uint8_t> from_host;
  std::vector<std::uint8_t> to_host;
  std::uint32_t rate = 9600;
  bool plugged = false;
};

struct DeviceHostTest : testing::Test {
  DeviceHostTest() {
    auto own_device = std::make_unique<TalkingDevice>();
    auto own_line = std::make_unique<TestLine>();
    device = own_device.get();
    line = own_line.get();
    std::vector<HostedDevice> devices;
    devices.push_back({"base", std::move(own_device), std::move(own_line), [this](const std::string& fault, bool on) {
                         injected += fault + (on ? "+" : "-");
                         return fault == "stuck" ? Status() : fail(Errc::kNotFound, "it has: stuck");
                       }});
    host.emplace(std::move(devices), 1);
    EXPECT_TRUE(host->plug());
  }
  void run_to(double time_s) {
    for (; now_s < time_s - 1e-9; now_s += 0.01) {
      host->step(robot_time_s(now_s + 0.01));
    }
  }

  TalkingDevice* device = nullptr;
  TestLine* line = nullptr;
  std::string injected;
  std::optional<DeviceHost> host;
  double now_s = 0.0;
};

TEST_F(DeviceHostTest, CarriesBytesAtTheRateOfTheLine) {
  device->to_say.assign(960, 0x55);
  run_to(0.5);
  EXPECT_NEAR(static_cast<double>(line->to_host.size()), 480.0, 20.0) << "9600 bits are 960 bytes a second";
  run_to(1.05);
  EXPECT_EQ(line->to_host.size(), 960U);
}

TEST_F(DeviceHostTest, AHostAtAnotherRateHearsOtherBytes) {
  line->rate = 19200;
  device->to_say.assign(100, 0x55);
  line->from_host.assign(100, 0x55);
  run_to(0.5);
  EXPECT_NE(line->to_host, std::vector<std::uint8_t>(100, 0x55));
  EXPECT_NE(device->heard, std::vector<std::uint8_t>(100, 0x55));
}

TEST_F(DeviceHostTest, AFaultBeginsAndEndsOnTime) {
  ASSERT_TRUE(host->add({robot_time_s(0.1), "base", "unplug", 0.0, seconds(0.2)}));
  run_to(0.05);
  EXPECT_TRUE(line->plugged);
  run_to(0.15);
  EXPECT_FALSE(line->plugged);
  run_to(0.35);
  EXPECT_TRUE(line->plugged);
}

TEST_F(DeviceHostTest, BitErrorsComeAtTheirRate) {
  ASSERT_TRUE(host->add({robot_time_s(0.0), "base", "bit-errors", 0.01, {}}));
  device->rate = line->rate = 0;
  device->to_say.assign(10000, 0);
  run_to(0.1);
  long errors = 0;
  for (const std::uint8_t byte : line->to_host) {
    errors += std::popcount(byte);
  }
  EXPECT_NEAR(static_cast<double>(errors), 800.0, 120.0) << "four standard deviations of 80000 bits";
}

TEST_F(DeviceHostTest, SilenceLosesBothDirections) {
  ASSERT_TRUE(host->add({robot_time_s(0.0), "base", "silence", 0.0, {}}));
  device->to_say.assign(10, 1);
  line->from_host.assign(10, 1);
  run_to(0.1);
  EXPECT_TRUE(line->to_host.empty());
  EXPECT_TRUE(device->heard.empty());
}

TEST_F(DeviceHostTest, APowerCutCyclesTheDevice) {
  ASSERT_TRUE(host->add({robot_time_s(0.05), "base", "power-cut", 0.0, seconds(0.1)}));
  run_to(0.3);
  EXPECT_EQ(device->cycles, 1);
  EXPECT_TRUE(line->plugged);
}

TEST_F(DeviceHostTest, TheDevicesOwnFaultsAreHandedOn) {
  ASSERT_TRUE(host->add({robot_time_s(0.05), "base", "stuck", 0.0, seconds(0.1)}));
  injected.clear();
  run_to(0.3);
  EXPECT_EQ(injected, "stuck+stuck-");
}

TEST_F(DeviceHostTest, RefusesFaultsAndDevicesThatThereAreNot) {
  EXPECT_NE(host->add({{}, "laser", "unplug", 0.0, {}}).error().message.find("there are: base"), std::string::npos);
  const std::string message = host->add({{}, "base", "explode", 0.0, {}}).error().message;
  EXPECT_NE(message.find("stuck"), std::string::npos);
  EXPECT_NE(message.find("unplug"), std::string::npos);
}

}  // namespace
}  // namespace seeker::emulator
