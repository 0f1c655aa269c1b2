/// \file
/// A session that hears any bytes at any time. The input is a row of pieces: a byte for the time that passes, a byte
/// for their number, and the bytes.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/core/assert.hpp"
#include "server/drivers/rplidar/rplidar_session.hpp"

namespace {

using seeker::drivers::RplidarSession;

constexpr std::chrono::milliseconds kTimeUnit{20};

void check_and_take(RplidarSession& session, seeker::RobotTime now) {
  for (const seeker::drivers::LineAction& action : session.take_actions()) {
    if (const auto* write = std::get_if<seeker::drivers::WriteBytes>(&action)) {
      SEEKER_ASSERT(!write->bytes.empty());
    }
  }
  if (const auto scan = session.take_scan()) {
    SEEKER_ASSERT(seeker::validate(*scan).has_value());
    SEEKER_ASSERT(scan->stamp <= now && scan->quality.size() == scan->ranges_m.size());
  }
  SEEKER_ASSERT(session.state().has_value() || !session.state().error().message.empty());
}

}  // namespace

// NOLINTNEXTLINE: the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  RplidarSession session(seeker::drivers::RplidarParams{});
  seeker::RobotTime now = seeker::robot_time_s(100.0);
  session.open(now);
  std::span<const std::uint8_t> rest(data, size);
  while (rest.size() > 2) {
    now += kTimeUnit * rest[0];
    const std::size_t count = std::min<std::size_t>(rest[1], rest.size() - 2);
    session.receive(rest.subspan(2, count), now);
    rest = rest.subspan(2 + count);
    check_and_take(session, now);
    if (now >= session.wake()) {
      session.pass(now);
      check_and_take(session, now);
    }
    if (session.wants_reopen()) {
      session.close(now);
      session.open(now);
    }
  }
  SEEKER_ASSERT(session.statistics().bytes_in + session.statistics().bytes_out >= session.statistics().bytes_skipped);
  return 0;
}
