#include "server/drivers/link/line_address.hpp"

#include <gtest/gtest.h>

namespace seeker::drivers {
namespace {

TEST(LineAddress, IsASerialPortByItsPath) {
  const auto address = parse_line_address("/dev/serial/by-id/usb-FTDI_A1-if00-port0");
  ASSERT_TRUE(address);
  EXPECT_TRUE(address->serial());
  EXPECT_EQ(address->path, "/dev/serial/by-id/usb-FTDI_A1-if00-port0");
}

TEST(LineAddress, IsATcpPortOfAHost) {
  const auto address = parse_line_address("tcp://192.168.1.5:8101");
  ASSERT_TRUE(address);
  EXPECT_EQ(*address, (LineAddress{"", "192.168.1.5", 8101}));
}

TEST(LineAddress, OfTcpWithoutAPortTakesTheProtocolsOwn) {
  const auto address = parse_line_address("tcp://base.local", 8101);
  ASSERT_TRUE(address);
  EXPECT_EQ(address->port, 8101);
}

TEST(LineAddress, ReadsBackAsItIsWritten) {
  for (const std::string text : {"/dev/ttyUSB0", "tcp://10.0.0.7:4001"}) {
    EXPECT_EQ(to_string(parse_line_address(text).value()), text);
  }
}

TEST(LineAddress, RefusesWhatIsNoneAndShowsWhatOneLooksLike) {
  for (const std::string text : {"", "ttyUSB0", "tcp://", "tcp://:8101", "tcp://base", "tcp://base:0", "tcp://base:x",
                                 "tcp://base:70000", "tcp://base:81 "}) {
    const auto address = parse_line_address(text);
    ASSERT_FALSE(address) << text;
    EXPECT_EQ(address.error().code, Errc::kInvalidArgument);
    EXPECT_NE(address.error().message.find("/dev/ttyUSB0"), std::string::npos);
  }
}

}  // namespace
}  // namespace seeker::drivers
