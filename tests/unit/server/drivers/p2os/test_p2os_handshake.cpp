#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/protocols/p2os/config_packet.hpp"
#include "tests/unit/server/drivers/p2os/talk.hpp"

namespace seeker::drivers {
namespace {

using p2os::CommandId;
using p2os::PacketId;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// SYNC0 to SYNC2 have the numbers of PULSE, OPEN and CLOSE.
const p2os::Command kSync0 = command(CommandId::kPulse);
const p2os::Command kSync1 = command(CommandId::kOpen);
const p2os::Command kSync2 = command(CommandId::kClose);
const p2os::Command kClose = command(CommandId::kClose, 1);

P2osParams tcp() {
  P2osParams params;
  params.serial = false;
  return params;
}

p2os::ConfigPacket config() {
  p2os::ConfigPacket config;
  config.trans_vel_top = 300;
  config.rot_vel_top = 60;
  config.watchdog_ms = 600;
  config.front_bumps = config.rear_bumps = config.charger = config.sonar_cycle_ms = 0;
  config.auto_baud = p2os::kBaudMayChange;
  config.has_gyro = p2os::kGyroSendsPackets;
  return config;
}

TEST(P2osHandshake, EachAnswerIsFollowedByTheNextStep) {
  Talk talk;
  EXPECT_THAT(talk.heard(), ElementsAre(kSync0));
  EXPECT_THAT(talk.bauds, ElementsAre(9600U));
  talk.say(PacketId::kSync0);
  EXPECT_THAT(talk.heard(), ElementsAre(kSync1));
  talk.say(PacketId::kSync1);
  EXPECT_THAT(talk.heard(), ElementsAre(kSync2));
  talk.say(p2os::write_identity({"Emu", "Pioneer", "p3at"}));
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kOpen, 1)));
  talk.say(p2os::write_sip({}));
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kConfig, 1)));
  EXPECT_EQ(talk.session.identity()->subclass, "p3at");
  EXPECT_EQ(talk.session.state().error().code, Errc::kNotReady);
}

TEST(P2osHandshake, TheLimitsOfTheConfigurationAreSetWithItsSonarAndGyroscope) {
  Talk talk;
  talk.greet();
  talk.say(p2os::write_sip({}));
  talk.heard();
  talk.say(p2os::write_config(config()));
  EXPECT_TRUE(talk.session.state());
  EXPECT_THAT(
      talk.heard(),
      ElementsAre(command(CommandId::kSetV, 300), command(CommandId::kSetRv, 60), command(CommandId::kSetA, 300),
                  command(CommandId::kSetA, -600), command(CommandId::kSetRa, 100), command(CommandId::kSetRa, -100),
                  command(CommandId::kSonar, 1), command(CommandId::kGyro, 1), command(CommandId::kEnable, 0),
                  command(CommandId::kVel, 0), command(CommandId::kRotVel, 0)));
  EXPECT_EQ(talk.session.statistics().connects, 1U);
}

TEST(P2osHandshake, WhatTheConfigurationStatesLimitsTheCommandsAndHastensThePulse) {
  Talk talk;
  talk.greet();
  talk.say(p2os::write_sip({}));
  talk.say(p2os::write_config(config()));
  talk.say(p2os::write_sip({}));
  talk.heard();
  talk.session.set_velocity({2.0, -3.0}, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 300), command(CommandId::kRotVel, -60)));
  talk.session.set_velocity({}, talk.now);
  talk.heard();
  for (int k = 0; k < 4; ++k) {  // the watchdog's 600 ms hold three pulses
    talk.session.loop_alive(talk.now);
    talk.inform();
  }
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kPulse), command(CommandId::kPulse)));
}

TEST(P2osHandshake, ABaseThatSendsNoConfigurationIsAskedAgainAndDrivenByItsModel) {
  Talk talk;
  talk.greet();
  talk.say(p2os::write_sip({}));
  talk.heard();
  talk.pass(kMs(990));
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kConfig, 1), command(CommandId::kConfig, 1),
                                        command(CommandId::kConfig, 1), command(CommandId::kConfig, 1)));
  talk.pass(kMs(10));
  EXPECT_TRUE(talk.session.state());
}

TEST(P2osHandshake, ADamagedConfigurationIsCountedAndAskedForAgain) {
  Talk talk;
  talk.greet();
  talk.say(p2os::write_sip({}));
  talk.say(PacketId::kConfig);
  EXPECT_FALSE(talk.session.state());
  EXPECT_EQ(talk.session.statistics().packets_bad, 1U);
  talk.say(p2os::write_config(config()));
  EXPECT_TRUE(talk.session.state());
}

TEST(P2osHandshake, AConnectionOfBeforeIsClosedAndTheHandshakeBeginsAgain) {
  Talk talk;
  talk.heard();
  talk.say(p2os::write_sip({}));
  EXPECT_THAT(talk.heard(), ElementsAre(kClose));
  talk.pass(kMs(100));
  talk.say(p2os::write_sip({}));  // what the base had sent already
  EXPECT_THAT(talk.heard(), IsEmpty());
  talk.pass(kMs(300));
  EXPECT_THAT(talk.heard(), ElementsAre(kSync0));
  talk.greet();
  EXPECT_THAT(talk.heard(), ElementsAre(kSync1, kSync2, command(CommandId::kOpen, 1)));
}

TEST(P2osHandshake, AConnectionThatCannotBeClosedIsReported) {
  Talk talk;
  for (int k = 0; k < 30; ++k) {
    talk.say(p2os::write_sip({}));
    talk.pass(kMs(100));
  }
  EXPECT_TRUE(talk.session.wants_reopen());
  EXPECT_EQ(talk.session.state().error().code, Errc::kBusy);
}

TEST(P2osHandshake, ARefusedStepBeginsAgainAfterAPause) {
  Talk talk;
  talk.say(PacketId::kSync0);
  talk.heard();
  talk.say(PacketId::kSyncRefused);
  EXPECT_THAT(talk.heard(), IsEmpty());
  talk.pass(kMs(100));
  EXPECT_THAT(talk.heard(), ElementsAre(kSync0));
}

TEST(P2osHandshake, ALateAnswerToAnEarlierStepIsIgnored) {
  Talk talk;
  talk.say(PacketId::kSync0);
  talk.heard();
  talk.say(PacketId::kSync0);
  EXPECT_THAT(talk.heard(), IsEmpty());
  talk.say(PacketId::kSync1);
  EXPECT_THAT(talk.heard(), ElementsAre(kSync2));
}

TEST(P2osHandshake, AnAnswerOfALaterStepBeginsAgain) {
  Talk talk;
  talk.heard();
  talk.say(p2os::write_identity({"Emu", "Pioneer", "p3dx"}));
  talk.pass(kMs(100));
  EXPECT_THAT(talk.heard(), ElementsAre(kSync0));
}

TEST(P2osHandshake, ASilentSerialBaseIsSearchedAtAllRatesAndThenReported) {
  Talk talk;
  talk.pass(std::chrono::seconds(30));
  EXPECT_THAT(talk.bauds, ElementsAre(9600U, 38400U, 19200U, 115200U, 57600U));
  EXPECT_TRUE(talk.session.wants_reopen());
  const Status state = talk.session.state();
  EXPECT_EQ(state.error().code, Errc::kTimeout);
  EXPECT_THAT(state.error().message, HasSubstr("at none of its rates"));
  EXPECT_EQ(talk.session.wake(), RobotTime::max());
}

TEST(P2osHandshake, TheLastTryAtARateClosesAConnectionOfBeforeThatIsSilent) {
  Talk talk(tcp());
  talk.pass(std::chrono::seconds(3));
  EXPECT_THAT(talk.heard(), ElementsAre(kSync0, kSync0, kClose, kSync0));
  EXPECT_FALSE(talk.session.wants_reopen());
  talk.pass(std::chrono::seconds(1));
  EXPECT_TRUE(talk.session.wants_reopen());
  EXPECT_THAT(talk.bauds, IsEmpty());
}

TEST(P2osHandshake, AnotherProtocolOnTheLineIsReportedAsOne) {
  Talk talk(tcp());
  const std::vector<std::uint8_t> text{'l', 'o', 'g', 'i', 'n', ':'};
  talk.session.receive(text, talk.now);
  talk.pass(std::chrono::seconds(10));
  EXPECT_THAT(talk.session.state().error().message, HasSubstr("another protocol"));
}

TEST(P2osHandshake, ABaseFoundAtAnotherRateIsSearchedThereFirstTheNextTime) {
  Talk talk;
  talk.pass(kMs(3700));
  EXPECT_THAT(talk.bauds, ElementsAre(9600U, 38400U));
  talk.connect();
  talk.pass(kMs(500));
  EXPECT_TRUE(talk.session.wants_reopen());
  talk.bauds.clear();
  talk.session.open(talk.now);
  talk.pass(std::chrono::seconds(5));
  EXPECT_THAT(talk.bauds, ElementsAre(38400U, 9600U));
}

TEST(P2osHandshake, AnUnknownSubclassIsRefusedUnlessAModelIsNamed) {
  Talk talk;
  talk.greet("peoplebot");
  EXPECT_EQ(talk.session.state().error().code, Errc::kUnsupportedVersion);
  EXPECT_THAT(talk.session.state().error().message, HasSubstr("p3dx, p3dx-sh, p3at, p3at-sh"));
  EXPECT_EQ(talk.heard().back(), kClose);
  P2osParams params;
  params.subclass = "p3dx";
  Talk named(params);
  named.greet("peoplebot");
  EXPECT_EQ(named.session.state().error().code, Errc::kNotReady);
}

TEST(P2osHandshake, ABaseThatAcceptsAndSendsNothingIsReported) {
  Talk talk;
  talk.greet();
  talk.pass(std::chrono::seconds(2));
  EXPECT_TRUE(talk.session.wants_reopen());
  EXPECT_EQ(talk.session.state().error().code, Errc::kTimeout);
}

P2osParams fast() {
  P2osParams params;
  params.switch_to_baud = 38400;
  return params;
}

TEST(P2osHandshake, AFasterRateIsTakenWhereTheBaseAllowsItAndAnswersThere) {
  Talk talk(fast());
  talk.greet();
  talk.say(p2os::write_sip({}));
  talk.heard();
  talk.say(p2os::write_config(config()));
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kHostBaud, 2)));
  EXPECT_THAT(talk.bauds, ElementsAre(9600U, 38400U));
  talk.pass(kMs(10));
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kPulse)));
  EXPECT_FALSE(talk.session.state());
  talk.say(p2os::write_sip({}));
  EXPECT_TRUE(talk.session.state());
  talk.heard();
  talk.session.close(talk.now);
  const auto farewell = talk.heard();
  EXPECT_EQ(farewell[farewell.size() - 2], command(CommandId::kHostBaud, 0));
  EXPECT_EQ(talk.bauds.back(), 9600U);
}

TEST(P2osHandshake, ARateThatTheBaseDoesNotTakeIsGivenUp) {
  Talk talk(fast());
  talk.greet();
  talk.say(p2os::write_sip({}));
  talk.say(p2os::write_config(config()));
  talk.pass(kMs(910));
  EXPECT_THAT(talk.bauds, ElementsAre(9600U, 38400U, 9600U));
  talk.say(p2os::write_sip({}));
  EXPECT_TRUE(talk.session.state());
}

TEST(P2osHandshake, ABaseThatIsSilentAtBothRatesIsLost) {
  Talk talk(fast());
  talk.greet();
  talk.say(p2os::write_sip({}));
  talk.say(p2os::write_config(config()));
  talk.pass(std::chrono::seconds(2));
  EXPECT_TRUE(talk.session.wants_reopen());
  EXPECT_THAT(talk.session.state().error().message, HasSubstr("another rate"));
}

TEST(P2osHandshake, ABaseThatDoesNotAllowItKeepsItsRate) {
  Talk talk(fast());
  talk.greet();
  talk.say(p2os::write_sip({}));
  p2os::ConfigPacket fixed = config();
  fixed.auto_baud = 0;
  talk.say(p2os::write_config(fixed));
  EXPECT_TRUE(talk.session.state());
  EXPECT_THAT(talk.bauds, ElementsAre(9600U));
}

}  // namespace
}  // namespace seeker::drivers
