/// \file
/// A serial line with its faults between a session and an emulated LMS200, on a clock of its own.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "common/core/rng.hpp"
#include "common/core/scan.hpp"
#include "server/drivers/lms200/lms_session.hpp"
#include "server/emulator/devices/lms_device.hpp"
#include "server/protocols/lms200/telegram.hpp"
#include "tests/unit/server/emulator/devices/lms_world.hpp"

namespace seeker::drivers {

/// The beam ahead says when it was measured: 1 m + 1 mm for each millisecond, over again after kClockSpan_s.
inline constexpr std::size_t kClockBeam = 180;
inline constexpr double kClockSpan_s = 5.0;

/// Beam i of the others has 2 m + 10 mm i.
inline LaserScan world_scan(RobotTime now) {
  LaserScan scan = emulator::half_degree_scan(now, 2.0F, 0.01F);
  scan.ranges_m[kClockBeam] = 1.0F + static_cast<float>(std::fmod(to_seconds(now), kClockSpan_s));
  return scan;
}

/// Whether each beam that the world has at its angle has the world's range, to half a unit.
inline bool shows_world(const LaserScan& scan, double unit_m) {
  const LaserScan world = world_scan(RobotTime());
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double place = (scan.angle_rad(beam) - world.angle_min_rad) / world.angle_step_rad;
    const double nearest = std::round(place);
    const bool own = std::abs(place - nearest) < 1e-6 && nearest != static_cast<double>(kClockBeam);
    const float truth_m = own ? world.ranges_m.at(static_cast<std::size_t>(nearest)) : 0.0F;
    if (own && std::abs(scan.ranges_m[beam] - truth_m) > 0.5 * unit_m + 1e-5) {
      return false;
    }
  }
  return true;
}

/// Stamp less the time at which the beam ahead was measured.
inline double stamp_error_s(const LaserScan& scan) {
  const auto ahead = static_cast<std::size_t>(std::llround(-scan.angle_min_rad / scan.angle_step_rad));
  const double measured_s = static_cast<double>(scan.ranges_m.at(ahead)) - 1.0;
  return std::remainder(to_seconds(scan.stamp) - measured_s, kClockSpan_s);
}

struct LineFaults {
  double bit_errors = 0.0;  ///< part of the bits, in both directions
  double jitter_s = 0.0;    ///< until the host is given what came, uniform
  double stall_s = 0.0;     ///< once in about a hundred times it is given that much later
  bool silent = false;      ///< nothing of the device arrives
};

class LmsLine {
 public:
  explicit LmsLine(const LmsParams& params = {},
                   const emulator::LmsDeviceParams& device_params = emulator::millimetre_device())
      : session(params), device(device_params, world_scan) {}

  void open() {
    session.open(now);
    act();
  }
  void close() {
    session.close(now);
    act();
  }
  /// Lets time pass. With `reopen`, a line that the session gives up is opened again after half a second.
  void run(double time_s, bool reopen = true) {
    const RobotTime end = now + seconds(time_s);
    while (now < end) {
      now = std::clamp(next_event(), now + Duration(1), end);
      device.pass(now);
      to_device();
      from_device();
      session.pass(now);
      act();
      if (auto scan = session.take_scan()) {
        scans.push_back(std::move(*scan));
      }
      if (reopen && session.wants_reopen() && now >= reopen_at_) {
        ++reopened;
        reopen_at_ = now + seconds(0.5);
        open();
      }
    }
  }
  /// Runs until the first scan, at most this long.
  bool run_until_scan(double limit_s) {
    const std::size_t before = scans.size();
    for (double t_s = 0.0; t_s < limit_s && scans.size() == before; t_s += 0.1) {
      run(0.1);
    }
    return scans.size() > before;
  }
  void power_cycle() {
    device.power_cycle(now);
    to_host_.clear();
  }
  /// Another program sends to the device at the right rate.
  void inject(const lms200::Command& command) {
    device.receive(encode_telegram(lms200::Sender::kHost, encode(command)), now);
  }

  LmsSession session;
  emulator::LmsDevice device;
  RobotTime now;
  LineFaults faults;
  std::vector<LaserScan> scans;
  std::vector<std::uint8_t> written;  ///< everything the session wrote
  int reopened = 0;

 private:
  struct ByteOnLine {
    RobotTime arrival;
    std::uint32_t baud = 0;
    std::uint8_t byte = 0;
  };

  [[nodiscard]] RobotTime next_event() const {
    RobotTime next = std::min(device.wake(), session.wake());
    next = to_device_.empty() ? next : std::min(next, to_device_.front().arrival);
    next = to_host_.empty() ? next : std::min(next, std::max(to_host_.front().arrival, host_ready_));
    return baud_changes_.empty() ? next : std::min(next, baud_changes_.front().arrival);
  }
  void act() {
    for (const LineAction& action : session.take_actions()) {
      host_free_ = std::max(host_free_, now);
      if (const auto* write = std::get_if<WriteBytes>(&action)) {
        written.insert(written.end(), write->bytes.begin(), write->bytes.end());
        for (const std::uint8_t byte : write->bytes) {
          host_free_ += lms200::transfer_time(1, write_baud_);
          to_device_.push_back({host_free_, write_baud_, byte});
        }
      } else if (const auto* rate = std::get_if<SetBaud>(&action)) {
        write_baud_ = rate->baud;
        baud_changes_.push_back({host_free_, rate->baud, 0});
      }
    }
    change_rate();
  }
  void change_rate() {
    for (; !baud_changes_.empty() && baud_changes_.front().arrival <= now; baud_changes_.pop_front()) {
      host_baud_ = baud_changes_.front().baud;
    }
  }
  void to_device() {
    for (; !to_device_.empty() && to_device_.front().arrival <= now; to_device_.pop_front()) {
      const std::uint8_t byte = travelled(to_device_.front(), device.baud());
      device.receive(std::span(&byte, 1), now);
    }
  }
  void from_device() {
    device_free_ = std::max(device_free_, now);
    for (const std::uint8_t byte : device.take_output()) {
      device_free_ += lms200::transfer_time(1, device.baud());
      to_host_.push_back({device_free_, device.baud(), byte});
    }
    change_rate();
    if (now < host_ready_) {
      return;
    }
    std::vector<std::uint8_t> bytes;
    for (; !to_host_.empty() && to_host_.front().arrival <= now; to_host_.pop_front()) {
      bytes.push_back(travelled(to_host_.front(), host_baud_));
    }
    if (!bytes.empty() && !faults.silent) {
      session.receive(bytes, now);
      host_ready_ = now + seconds(rng_.uniform(0.0, faults.jitter_s) + (rng_.below(100) == 0 ? faults.stall_s : 0.0));
    }
  }
  /// At another rate than it was sent a byte is garbage.
  std::uint8_t travelled(const ByteOnLine& sent, std::uint32_t baud) {
    std::uint8_t byte = sent.baud == baud ? sent.byte : static_cast<std::uint8_t>(rng_.below(256));
    for (unsigned bit = 0; faults.bit_errors > 0.0 && bit < 8; ++bit) {
      byte = static_cast<std::uint8_t>(rng_.uniform() < faults.bit_errors ? byte ^ (1U << bit) : byte);
    }
    return byte;
  }

  Rng rng_{3};
  std::deque<ByteOnLine> to_device_;
  std::deque<ByteOnLine> to_host_;
  std::deque<ByteOnLine> baud_changes_;
  RobotTime host_free_;    ///< when everything that the host wrote has left
  RobotTime device_free_;  ///< likewise of the device
  RobotTime host_ready_;   ///< the host is given nothing before
  RobotTime reopen_at_;
  std::uint32_t write_baud_ = 9600;  ///< of bytes that are written now
  std::uint32_t host_baud_ = 9600;   ///< of bytes that arrive now
};

}  // namespace seeker::drivers
