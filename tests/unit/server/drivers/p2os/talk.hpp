/// \file
/// A session whose base is played by the test, packet by packet, on a clock that the test turns.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/core/time.hpp"
#include "server/drivers/p2os/p2os_session.hpp"
#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/identity.hpp"
#include "server/protocols/p2os/packet_reader.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace seeker::drivers {

inline constexpr auto kMs = [](int ms) -> Duration { return std::chrono::milliseconds(ms); };

class Talk {
 public:
  explicit Talk(P2osParams params = {}) : session(std::move(params)) { session.open(now); }

  void say(const p2os::Packet& packet) {
    session.receive(p2os::encode(packet), now);
    collect();
  }
  void say(p2os::PacketId id) { say(p2os::Packet{static_cast<std::uint8_t>(id), {}}); }
  /// Lets time pass, with pass() whenever the session wants it.
  void pass(Duration duration) {
    const RobotTime end = now + duration;
    while (session.wake() <= end) {
      now = std::max(now, session.wake());
      session.pass(now);
      collect();
    }
    now = end;
    session.pass(now);
    collect();
  }
  /// The commands that the session has sent since the last call.
  std::vector<p2os::Command> heard() {
    collect();
    p2os::PacketReader reader;
    reader.feed(std::exchange(sent, {}));
    std::vector<p2os::Command> commands;
    while (const auto packet = reader.next()) {
      commands.push_back(p2os::parse_command(*packet).value());
    }
    return commands;
  }
  void greet(const std::string& subclass = "p3dx-sh") {
    say(p2os::PacketId::kSync0);
    say(p2os::PacketId::kSync1);
    say(p2os::write_identity({"Emu", "Pioneer", subclass}));
  }
  /// The whole way to a base that obeys, without a configuration.
  void connect(const std::string& subclass = "p3dx-sh") {
    greet(subclass);
    for (int k = 0; k < 12; ++k) {
      say(p2os::write_sip(sip));
      pass(kMs(100));
    }
    say(p2os::write_sip(sip));
    ASSERT_TRUE(session.state()) << session.state().error().message;
    heard();
    static_cast<void>(session.take_odometry());
    static_cast<void>(session.take_sonar());
  }
  /// Information of 100 ms later.
  void inform() {
    pass(kMs(100));
    say(p2os::write_sip(sip));
  }

  P2osSession session;
  RobotTime now = robot_time_s(10.0);
  p2os::Sip sip;
  std::vector<std::uint8_t> sent;
  std::vector<std::uint32_t> bauds;

 private:
  void collect() {
    for (const LineAction& action : session.take_actions()) {
      if (const auto* write = std::get_if<WriteBytes>(&action)) {
        sent.insert(sent.end(), write->bytes.begin(), write->bytes.end());
      } else if (const auto* baud = std::get_if<SetBaud>(&action)) {
        bauds.push_back(baud->baud);
      }
    }
  }
};

inline p2os::Command command(p2os::CommandId id) { return {static_cast<std::uint8_t>(id), {}}; }
inline p2os::Command command(p2os::CommandId id, int argument) { return {static_cast<std::uint8_t>(id), argument}; }

}  // namespace seeker::drivers
