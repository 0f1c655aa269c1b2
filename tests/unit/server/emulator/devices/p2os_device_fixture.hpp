/// \file
/// Fixture of the tests of the emulated Pioneer base.
#pragma once

#include <algorithm>

#include <gtest/gtest.h>

#include "server/protocols/p2os/command.hpp"
#include "tests/unit/server/emulator/devices/p2os_bench.hpp"

namespace seeker::emulator {

inline constexpr Duration kTenth = std::chrono::milliseconds(100);

/// A base on blocks that the test orders about.
class P2osDeviceTest : public ::testing::Test {
 protected:
  using CommandId = p2os::CommandId;

  void order(CommandId id) { bench.say(p2os::encode_command(id)); }
  void order(CommandId id, int argument) { bench.say(p2os::encode_command(id, argument)); }
  /// Lets time pass with PULSE, as a client does.
  void work(double for_s) {
    for (double s = 0.0; s < for_s; s += 0.5) {
      order(CommandId::kPulse);
      bench.pass(std::min(seconds(0.5), seconds(for_s - s)));
    }
  }

  P2osBench bench;
};

}  // namespace seeker::emulator
