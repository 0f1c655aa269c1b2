#include "server/drivers/link/any_baud.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include <gtest/gtest.h>
#include <boost/asio/io_context.hpp>

#include "server/drivers/link/serial_line.hpp"

namespace seeker::drivers {
namespace {

TEST(AnyBaud, ALineTakesRatesThatPosixDoesNotName) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(master, 0);
  ASSERT_EQ(::grantpt(master), 0);
  ASSERT_EQ(::unlockpt(master), 0);
  std::array<char, 64> name{};
  ASSERT_EQ(::ptsname_r(master, name.data(), name.size()), 0);
  boost::asio::io_context io;
  const auto line = SerialLine::open(io, name.data());
  ASSERT_TRUE(line) << line.error().message;
  for (const std::uint32_t baud : {38400U, 256000U, 115200U, 500000U}) {
    const Status set = (*line)->set_baud(baud);
    EXPECT_TRUE(set) << baud << ": " << set.error().message;
  }
  ::close(master);
}

TEST(AnyBaud, WhatIsNoLineIsAnError) {
  const int file = ::open("/dev/null", O_RDWR);
  ASSERT_GE(file, 0);
  EXPECT_TRUE(set_any_baud(file, 9600));
  ::close(file);
}

}  // namespace
}  // namespace seeker::drivers
