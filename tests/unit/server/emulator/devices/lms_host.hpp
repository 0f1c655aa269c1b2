/// \file
/// A program that talks to an emulated LMS200, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/emulator/devices/lms_device.hpp"
#include "server/protocols/lms200/commands.hpp"
#include "server/protocols/lms200/scan_telegram.hpp"
#include "server/protocols/lms200/telegram.hpp"
#include "server/protocols/lms200/telegram_reader.hpp"
#include "tests/unit/server/emulator/devices/lms_world.hpp"

namespace seeker::emulator {

using Bytes = std::vector<std::uint8_t>;

/// Beam i has 1 m + i mm.
inline LaserScan numbered_scan(RobotTime now) { return half_degree_scan(now, 1.0F, 0.001F); }

/// The other end of the line. Its bytes need the time of its rate; at another rate than the device's they are garbage.
class LmsHost {
 public:
  explicit LmsHost(const LmsDeviceParams& params = millimetre_device()) : device(params, numbered_scan) {}

  /// Sends byte after byte.
  void send(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      run(to_seconds(lms200::transfer_time(1, baud)));
      const Bytes one{baud == device.baud() ? byte : static_cast<std::uint8_t>(byte * 37U + 11U)};
      device.receive(one, now);
      collect();
    }
  }
  void command(const lms200::Command& command) {
    send(lms200::encode_telegram(lms200::Sender::kHost, lms200::encode(command)));
  }
  /// Lets time pass; the device is served when it wants it.
  void run(double time_s) {
    const RobotTime end = now + seconds(time_s);
    while (now < end) {
      const RobotTime next_byte = on_line_.empty() ? end : on_line_.front().arrival;
      now = std::clamp(std::min(device.wake(), next_byte), now + Duration(1), end);
      device.pass(now);
      collect();
    }
  }
  /// The payload of the device's next telegram, if one came.
  std::optional<Bytes> telegram() {
    while (const auto received = reader.next()) {
      acks += received->kind == lms200::Received::Kind::kAck ? 1 : 0;
      naks += received->kind == lms200::Received::Kind::kNak ? 1 : 0;
      if (received->kind == lms200::Received::Kind::kTelegram) {
        return received->payload;
      }
    }
    return std::nullopt;
  }
  /// Sends a command and returns the payload of the answer; nothing within a second: none.
  std::optional<Bytes> ask(const lms200::Command& question) {
    command(question);
    for (double waited_s = 0.0; waited_s < 1.0; waited_s += 0.01) {
      if (auto answer = telegram()) {
        return answer;
      }
      run(0.01);
    }
    return std::nullopt;
  }
  /// The next telegram that is a scan, within two seconds.
  std::optional<lms200::ScanTelegram> scan() {
    for (double waited_s = 0.0; waited_s < 2.0; waited_s += 0.01) {
      while (const auto payload = telegram()) {
        if (auto decoded = lms200::decode_scan(*payload, device.flash().real_time_index()); decoded.has_value()) {
          return *decoded;
        }
      }
      run(0.01);
    }
    return std::nullopt;
  }

  LmsDevice device;
  lms200::TelegramReader reader{lms200::Sender::kDevice};
  RobotTime now;
  std::uint32_t baud = 9600;
  int acks = 0;
  int naks = 0;
  Bytes all;  ///< everything the device sent

 private:
  struct ByteOnLine {
    RobotTime arrival;
    std::uint32_t baud;
    std::uint8_t byte;
  };

  void collect() {
    line_free_ = std::max(line_free_, now);
    for (const std::uint8_t byte : device.take_output()) {
      line_free_ += lms200::transfer_time(1, device.baud());
      on_line_.push_back({line_free_, device.baud(), byte});
    }
    for (; !on_line_.empty() && on_line_.front().arrival <= now; on_line_.pop_front()) {
      all.push_back(on_line_.front().byte);
      if (baud == on_line_.front().baud) {
        reader.feed(Bytes{on_line_.front().byte});
      }
    }
  }

  std::deque<ByteOnLine> on_line_;
  RobotTime line_free_;
};

}  // namespace seeker::emulator
