// The sequences with which other programs start an LMS200 (protocols 2.4), and the answers without which they give up.
#include <gtest/gtest.h>

#include "server/protocols/lms200/responses.hpp"
#include "server/protocols/lms200/status_block.hpp"
#include "tests/unit/server/emulator/devices/lms_host.hpp"

namespace seeker::emulator {
namespace {

namespace lms = lms200;
namespace code = lms200::response_code;
using lms200::SetMode;

const Bytes kModeDone{code::kMode, 0, lms200::StatusByte::kGood};

/// A configuration as a program sends it, of this payload size including the command byte.
lms::SetConfig config_of_size(std::size_t payload_size, const lms::ConfigBlock& config) {
  const auto block = encode(config);
  return {{block.begin(), block.begin() + static_cast<std::ptrdiff_t>(payload_size) - 1}};
}

lms::ConfigBlock in_millimetres() {
  lms::ConfigBlock config;
  config.measuring_mode = 1;
  config.unit = 1;
  return config;
}

void expect_scans(LmsHost& host, std::size_t values) {
  for (int i = 0; i < 3; ++i) {
    const auto scan = host.scan();
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->words.size(), values);
    EXPECT_EQ(scan->unit, lms::Unit::kMillimetre);
  }
}

TEST(LmsPeers, SicktoolboxStartsFromThePowerOnRateAndSaysFarewell) {
  LmsHost host;
  EXPECT_EQ(host.ask(SetMode{0x40, {}}), kModeDone);
  host.baud = 38400;
  host.run(0.25);
  EXPECT_EQ(host.ask(SetMode{0x25, {}}), kModeDone);
  EXPECT_NE(lms::decode_text(*host.ask(lms::RequestType{}))->find("LMS200;30106"), std::string::npos);
  EXPECT_TRUE(lms::decode_status_block(*host.ask(lms::RequestStatus{})).has_value());
  EXPECT_TRUE(lms::decode_config_reply(*host.ask(lms::RequestConfig{})).has_value());
  EXPECT_TRUE(lms::decode_variant(*host.ask(lms::SetVariant{{180, 50}}))->accepted);
  EXPECT_EQ(host.ask(SetMode{0x24, {}}), kModeDone);
  expect_scans(host, 361);
  host.command(SetMode{0x25, {}});
  host.run(0.5);
  host.command(SetMode{0x42, {}});
  host.run(0.5);
  EXPECT_EQ(host.device.baud(), 9600U);
}

TEST(LmsPeers, SicktoolboxFindsARateByTheErrorListAndChangesTheConfiguration) {
  LmsHost host;
  host.command(SetMode{0x41, {}});
  host.run(0.3);  // an earlier program left the device at 19200
  while (host.telegram()) {
  }
  EXPECT_FALSE(host.ask(SetMode{0x40, {}}));  // at 9600
  host.baud = 19200;
  EXPECT_EQ(host.ask(lms::RequestErrors{})->front(), code::kErrors);
  EXPECT_EQ(host.ask(SetMode{0x40, {}}), kModeDone);
  host.baud = 38400;
  EXPECT_EQ(host.ask(lms::enter_installation()), kModeDone);
  EXPECT_TRUE(lms::decode_config_written(*host.ask(config_of_size(35, in_millimetres())))->accepted);
  EXPECT_EQ(host.device.flash(), in_millimetres());
}

TEST(LmsPeers, MrptRequiresTheAckAndTheGoodStatusByte) {
  LmsHost host;
  host.baud = 38400;
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(host.ask(SetMode{0x25, {}}));  // the wrong rate
  }
  host.baud = 9600;
  EXPECT_EQ(host.ask(SetMode{0x25, {}}), kModeDone);
  EXPECT_EQ(host.ask(lms::RequestStatus{})->front(), code::kStatus);
  const std::size_t before = host.all.size();
  EXPECT_EQ(host.ask(SetMode{0x40, {}}), kModeDone);
  EXPECT_EQ(host.all[before], lms::kAckByte);
  EXPECT_EQ(host.all[before + 1 + 6], 0x10);
  host.baud = 38400;
  EXPECT_EQ(host.ask(lms::RequestStatus{})->front(), code::kStatus);
  EXPECT_EQ(host.ask(lms::enter_installation()), kModeDone);
  EXPECT_TRUE(lms::decode_config_reply(*host.ask(lms::RequestConfig{})).has_value());
  EXPECT_TRUE(lms::decode_config_written(*host.ask(config_of_size(35, in_millimetres())))->accepted);
  EXPECT_EQ(host.ask(SetMode{0x25, {}}), kModeDone);
  EXPECT_TRUE(lms::decode_variant(*host.ask(lms::SetVariant{{180, 50}}))->accepted);
  EXPECT_EQ(host.ask(SetMode{0x24, {}}), kModeDone);
  expect_scans(host, 361);
}

TEST(LmsPeers, PlayerWritesEightBytesAndReadsAngleAndResolutionFromTheStatus) {
  LmsDeviceParams params;  // in cm
  params.flash.dazzle_multiple_evaluation = 3;
  LmsHost host(params);
  EXPECT_EQ(host.ask(SetMode{0x25, {}}), kModeDone);
  EXPECT_EQ(host.ask(SetMode{0x40, {}}), kModeDone);
  host.baud = 38400;
  const auto type = host.ask(lms::RequestType{});
  EXPECT_EQ(std::string(type->begin() + 1, type->begin() + 4), "LMS");
  EXPECT_EQ(host.ask(lms::enter_installation()), kModeDone);
  const auto status = host.ask(lms::RequestStatus{});
  EXPECT_EQ(status->at(107) + 256 * status->at(108), 180);
  EXPECT_EQ(status->at(109) + 256 * status->at(110), 100);
  EXPECT_TRUE(lms::decode_variant(*host.ask(lms::SetVariant{{180, 50}}))->accepted);
  EXPECT_EQ(host.ask(lms::RequestConfig{})->size(), 36U);
  EXPECT_TRUE(lms::decode_config_written(*host.ask(config_of_size(8, in_millimetres())))->accepted);
  EXPECT_EQ(host.device.flash().dazzle_multiple_evaluation, 3);
  EXPECT_EQ(host.ask(SetMode{0x24, {}}), kModeDone);
  expect_scans(host, 361);
}

TEST(LmsPeers, PlayerAsksForASubRange) {
  LmsHost host;
  EXPECT_EQ(host.ask(SetMode{0x25, {}}), kModeDone);
  EXPECT_EQ(host.ask(SetMode{0x40, {}}), kModeDone);
  host.baud = 38400;
  EXPECT_EQ(host.ask(lms::continuous_sub_range({46, 136})), kModeDone);
  expect_scans(host, 91);
}

TEST(LmsPeers, AriaWaitsForThePowerOnTelegramAndChangesTheRateWithoutWaitingForTheReply) {
  LmsHost host;
  EXPECT_EQ(host.ask(lms::Reset{})->front(), code::kReset);
  host.run(2.5);
  EXPECT_EQ(host.telegram()->front(), code::kPowerOn);
  host.command(SetMode{0x40, {}});
  host.run(0.020);
  host.baud = 38400;
  host.run(0.300);
  while (host.telegram()) {
  }
  EXPECT_TRUE(lms::decode_variant(*host.ask(lms::SetVariant{{180, 50}}))->accepted);
  EXPECT_EQ(host.ask(lms::enter_installation()), kModeDone);
  EXPECT_TRUE(lms::decode_config_written(*host.ask(config_of_size(33, in_millimetres())))->accepted);
  EXPECT_EQ(host.ask(SetMode{0x24, {}}), kModeDone);
  expect_scans(host, 361);
}

TEST(LmsPeers, AProgramThatStartsWhileTheDeviceStillSendsIsAnsweredBehindTheScan) {
  LmsHost host;
  EXPECT_EQ(host.ask(SetMode{0x24, {}}), kModeDone);
  host.run(1.0);
  while (host.telegram()) {
  }
  host.command(SetMode{0x25, {}});
  host.run(1.0);
  std::optional<Bytes> last;
  while (auto payload = host.telegram()) {
    last = payload;
  }
  EXPECT_EQ(last, kModeDone);
}

}  // namespace
}  // namespace seeker::emulator
