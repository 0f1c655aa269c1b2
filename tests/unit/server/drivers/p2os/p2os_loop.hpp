/// \file
/// A session and an emulated base over a line with its rate, cuts and bit errors, with an owner that reopens a lost
/// line and a control loop, all on one clock.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/core/rng.hpp"
#include "server/drivers/p2os/p2os_session.hpp"
#include "tests/unit/server/emulator/devices/p2os_bench.hpp"

namespace seeker::drivers {

class P2osLoop {
 public:
  static constexpr Duration kLoopPeriod = std::chrono::milliseconds(100);
  static constexpr Duration kReopenPause = std::chrono::milliseconds(500);

  explicit P2osLoop(P2osParams params = {}, emulator::P2osDeviceParams device = {}, std::uint64_t seed = 1)
      : bench(std::move(device)), session(std::move(params)), rng(seed) {
    session.open(bench.now);
  }

  /// Everything runs for this long.
  void pass(Duration duration) {
    for (const RobotTime end = bench.now + duration; bench.now < end;) {
      bench.pass(emulator::P2osBench::kStep);
      collect(bench.device.take_output(), to_host_);
      carry(to_host_, [&](std::span<const std::uint8_t> piece) { session.receive(piece, bench.now); });
      if (session.wake() <= bench.now) {
        session.pass(bench.now);
      }
      control();
      act();
      carry(to_base_, [&](std::span<const std::uint8_t> piece) { bench.device.receive(piece, bench.now); });
    }
  }
  /// Runs until the base is connected; false: it is not within this time.
  bool connect(Duration within = std::chrono::seconds(30)) {
    const RobotTime end = bench.now + within;
    while (bench.now < end && !session.state()) {
      pass(kLoopPeriod);
    }
    return session.state().has_value();
  }
  void drive(const Twist2& velocity, Duration duration) {
    wanted = velocity;
    pass(duration);
  }

  emulator::P2osBench bench;
  P2osSession session;
  Rng rng;
  Twist2 wanted;
  bool loop_runs = true;
  bool cut = false;  ///< the line carries nothing
  double bit_error = 0.0;
  OdometrySample newest;
  std::optional<SonarScan> sonar;
  std::uint32_t host_baud = 0;

 private:
  void control() {
    if (loop_runs && bench.now >= next_tick_) {
      next_tick_ = bench.now + kLoopPeriod;
      session.loop_alive(bench.now);
      if (const auto sample = session.take_odometry()) {
        newest = *sample;
      }
      if (auto scan = session.take_sonar()) {
        sonar = std::move(scan);
      }
      session.set_velocity(wanted, bench.now);
    }
    if (session.wants_reopen() && !reopen_at_) {
      session.close(bench.now);
      reopen_at_ = bench.now + kReopenPause;
    }
    if (reopen_at_ && bench.now >= *reopen_at_) {
      reopen_at_.reset();
      to_host_.clear();
      session.open(bench.now);
    }
  }
  void act() {
    for (const LineAction& action : session.take_actions()) {
      if (const auto* write = std::get_if<WriteBytes>(&action)) {
        collect(write->bytes, to_base_);
      } else if (const auto* baud = std::get_if<SetBaud>(&action)) {
        // What was written before leaves at the old rate.
        while (!to_base_.empty()) {
          carry(to_base_, [&](std::span<const std::uint8_t> piece) { bench.device.receive(piece, bench.now); });
        }
        host_baud = baud->baud;
      } else if (std::holds_alternative<DropInput>(action)) {
        to_host_.clear();
      }
    }
  }
  void collect(const std::vector<std::uint8_t>& bytes, std::deque<std::uint8_t>& line) {
    if (!cut) {
      line.insert(line.end(), bytes.begin(), bytes.end());
    }
  }
  /// As many bytes as the rate of the line carries in one step, in pieces of any size; at a wrong rate any bytes.
  template <class Deliver>
  void carry(std::deque<std::uint8_t>& line, Deliver&& deliver) {
    const std::uint32_t rate = bench.device.baud();
    const std::size_t most = rate == 0 ? line.size() : std::max<std::size_t>(rate / 1000, 1);
    std::vector<std::uint8_t> bytes;
    for (; !line.empty() && bytes.size() < most; line.pop_front()) {
      bytes.push_back(rate == 0 || rate == host_baud ? line.front() : static_cast<std::uint8_t>(rng.bits()));
    }
    for (std::uint8_t& byte : bytes) {
      for (unsigned bit = 0; bit_error > 0.0 && bit < 8; ++bit) {
        byte = static_cast<std::uint8_t>(rng.uniform() < bit_error ? byte ^ (1U << bit) : byte);
      }
    }
    for (std::span<const std::uint8_t> rest = bytes; !rest.empty();) {
      const std::size_t n = 1 + rng.below(rest.size());
      deliver(rest.first(n));
      rest = rest.subspan(n);
    }
  }

  std::deque<std::uint8_t> to_host_;
  std::deque<std::uint8_t> to_base_;
  RobotTime next_tick_;
  std::optional<RobotTime> reopen_at_;
};

}  // namespace seeker::drivers
