// The session of the LMS200: any bytes at any times. A byte of the input says how many bytes come next, and after which
// time; what it leads to is written into telegrams with right checksums as well, because no chance would find those.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/assert.hpp"
#include "server/drivers/lms200/lms_session.hpp"
#include "server/protocols/lms200/telegram.hpp"

namespace {

using seeker::RobotTime;
using seeker::drivers::LmsSession;

void check(LmsSession& session, RobotTime now) {
  SEEKER_ASSERT(session.wake() > now);
  SEEKER_ASSERT(session.state().has_value() || !session.state().error().message.empty());
  SEEKER_ASSERT(!session.wants_reopen() || !session.state().has_value());
  std::size_t written = 0;
  for (const auto& action : session.take_actions()) {
    const auto* write = std::get_if<seeker::drivers::WriteBytes>(&action);
    written += write != nullptr ? write->bytes.size() : 0;
  }
  SEEKER_ASSERT(written <= 1000);
  if (const auto scan = session.take_scan()) {
    SEEKER_ASSERT(seeker::validate(*scan).has_value() && scan->ranges_m.size() == 361);
    SEEKER_ASSERT(scan->stamp <= now);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kPieceHeader = 3;
  LmsSession session({});
  RobotTime now;
  session.open(now);
  check(session, now);
  std::span<const std::uint8_t> rest(data, size);
  while (rest.size() >= kPieceHeader) {
    const bool whole = rest[0] % 2 == 1;
    const std::size_t length = std::min<std::size_t>(rest[1] * (rest[0] / 2 % 4 + 1), rest.size() - kPieceHeader);
    now += rest[2] * seeker::seconds(0.02);
    session.pass(now);
    const std::span<const std::uint8_t> bytes = rest.subspan(kPieceHeader, length);
    if (whole && !bytes.empty() && bytes.size() <= seeker::lms200::kMaxPayloadBytes) {
      session.receive(encode_telegram(seeker::lms200::Sender::kDevice, bytes), now);
    } else {
      session.receive(bytes, now);
    }
    check(session, now);
    if (session.wants_reopen()) {
      session.open(now);
    }
    rest = rest.subspan(kPieceHeader + length);
  }
  session.close(now);
  (void)session.take_actions();
  SEEKER_ASSERT(!session.state().has_value());
  return 0;
}
