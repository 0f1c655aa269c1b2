/// \file
/// A session and an emulated device on one line in virtual time: paced bytes, any cuts, bit errors, silence.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/core/rng.hpp"
#include "server/drivers/rplidar/rplidar_session.hpp"
#include "server/emulator/devices/rplidar_device.hpp"

namespace seeker::drivers::testing {

class VirtualLine {
 public:
  VirtualLine(const RplidarParams& host, const emulator::RplidarDeviceParams& device_params,
              const emulator::RangeInDirection& measure, std::uint64_t seed)
      : session(host), device(device_params, measure), rng_(seed) {
    device.pass(now);
    session.open(now);
    act();
  }

  /// Runs for a while and returns the scans that come out.
  std::vector<LaserScan> run(double duration_s) {
    std::vector<LaserScan> scans;
    for (const RobotTime end = now + seconds(duration_s); now < end;) {
      now += kStep;
      device.pass(now);
      from_device();
      if (now >= session.wake()) {
        session.pass(now);
      }
      act();
      reopen();
      if (auto scan = session.take_scan()) {
        scans.push_back(std::move(*scan));
      }
    }
    return scans;
  }

  RobotTime now = robot_time_s(1000.0);
  RplidarSession session;
  emulator::RplidarDevice device;
  double bit_error_rate = 0.0;
  double byte_loss_rate = 0.0;
  bool mute = false;  ///< nothing that the device sends arrives
  int reopened = 0;
  std::optional<Error> last_failure;

 private:
  static constexpr Duration kStep = std::chrono::milliseconds(1);
  static constexpr Duration kReopenAfter = std::chrono::seconds(1);
  static constexpr double kBytesPerBaud = 0.1;

  /// What becomes of bytes on their way.
  std::vector<std::uint8_t> carry(std::vector<std::uint8_t> bytes) {
    std::vector<std::uint8_t> arrived;
    arrived.reserve(bytes.size());
    for (std::uint8_t byte : bytes) {
      if (byte_loss_rate > 0.0 && rng_.uniform() < byte_loss_rate) {
        continue;
      }
      for (unsigned bit = 0; bit_error_rate > 0.0 && bit < 8; ++bit) {
        byte ^= static_cast<std::uint8_t>(rng_.uniform() < bit_error_rate ? 1U << bit : 0U);
      }
      arrived.push_back(host_baud_ == device.baud() ? byte : static_cast<std::uint8_t>(rng_.below(256)));
    }
    return arrived;
  }

  /// The line passes on what its rate allows, and the host's system hands it over in pieces of any size, a few
  /// milliseconds late.
  void from_device() {
    for (const std::uint8_t byte : device.take_output()) {
      sending_.push_back(byte);
    }
    credit_ =
        std::min(credit_ + kBytesPerBaud * device.baud() * to_seconds(kStep), static_cast<double>(sending_.size()));
    for (; credit_ >= 1.0; credit_ -= 1.0) {
      arriving_.push_back(sending_.front());
      sending_.pop_front();
    }
    if (arriving_.empty() || rng_.below(3) != 0) {
      return;
    }
    std::vector<std::uint8_t> piece = carry(std::move(arriving_));
    arriving_.clear();
    const std::size_t cut = rng_.below(piece.size() + 1);
    if (!mute) {
      session.receive(std::span(piece).first(cut), now);
      session.receive(std::span(piece).subspan(cut), now);
    }
  }

  void act() {
    for (const LineAction& action : session.take_actions()) {
      if (const auto* write = std::get_if<WriteBytes>(&action)) {
        device.receive(carry(write->bytes), now);
      } else if (const auto* rate = std::get_if<SetBaud>(&action)) {
        host_baud_ = rate->baud;
      }
    }
  }

  /// Closes a line that the session gave up, and opens it again after a while.
  void reopen() {
    if (session.wants_reopen()) {
      last_failure = session.state().error();
      session.close(now);
      act();
      reopen_at_ = now + kReopenAfter;
    } else if (reopen_at_ && now >= *reopen_at_) {
      reopen_at_.reset();
      ++reopened;
      session.open(now);
      act();
    }
  }

  Rng rng_;
  std::uint32_t host_baud_ = 0;
  std::deque<std::uint8_t> sending_;
  std::vector<std::uint8_t> arriving_;
  double credit_ = 0.0;
  std::optional<RobotTime> reopen_at_;
};

}  // namespace seeker::drivers::testing
