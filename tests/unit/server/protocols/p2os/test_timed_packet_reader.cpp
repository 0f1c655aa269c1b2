#include <gtest/gtest.h>

#include "server/protocols/p2os/timed_packet_reader.hpp"
#include "tests/unit/server/protocols/p2os/hex.hpp"

namespace seeker::p2os {
namespace {

TEST(P2osTimedPacketReader, AGoodPacketBehindADamagedCountWaitsForAShortPauseOnly) {
  TimedPacketReader reader;
  reader.feed(hex("FA FB 80 32 FA FB 03 1D 00 1D"), robot_time_s(1.0));
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.wake(), robot_time_s(1.03));
  reader.pass(robot_time_s(1.02));
  EXPECT_FALSE(reader.next());
  reader.pass(reader.wake());
  EXPECT_EQ(reader.next(), (Packet{0x1D, {}}));
  EXPECT_EQ(reader.wake(), RobotTime::max());
}

TEST(P2osTimedPacketReader, AnUnfinishedPacketIsGivenUpAfterALongPause) {
  TimedPacketReader reader;
  reader.feed(hex("FA FB 06 1D"), robot_time_s(1.0));
  EXPECT_FALSE(reader.next());
  reader.pass(robot_time_s(1.03));
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.wake(), robot_time_s(1.1));
  reader.pass(robot_time_s(1.1));
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.wake(), RobotTime::max());
}

}  // namespace
}  // namespace seeker::p2os
