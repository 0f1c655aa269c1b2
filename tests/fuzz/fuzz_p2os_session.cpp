// The session of a Pioneer base against any bytes at any times: the input is a script of what the base sends, genuine
// or not, of the time that passes and of what the control loop calls.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "common/core/assert.hpp"
#include "server/drivers/p2os/p2os_session.hpp"
#include "server/protocols/p2os/config_packet.hpp"
#include "server/protocols/p2os/identity.hpp"
#include "server/protocols/p2os/packet.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace {

using namespace seeker;  // NOLINT: a fuzz target is one file about one class
using drivers::P2osSession;

/// Runs a script of one byte for the deed and one for its value.
class Script {
 public:
  explicit Script(drivers::P2osParams params) : session_(std::move(params)) { session_.open(now_); }

  void run(std::span<const std::uint8_t> script) {
    while (script.size() >= 2) {
      const std::uint8_t value = script[1];
      const std::size_t taken = script[0] % 8 == 0 ? std::min<std::size_t>(value, script.size() - 2) : 0;
      carry_out(script[0] % 8, value, script.subspan(2, taken));
      check();
      script = script.subspan(2 + taken);
    }
  }

 private:
  void carry_out(int deed, std::uint8_t value, std::span<const std::uint8_t> bytes) {
    switch (deed) {
      case 0: session_.receive(bytes, now_); break;
      case 1: pass(std::chrono::milliseconds(value)); break;
      case 2: say({value, {}}); break;
      case 3: say(p2os::write_identity({"", "Pioneer", value % 2 == 0 ? "p3dx" : "p3at-sh"})); break;
      case 4: say_information(value); break;
      case 5: say(p2os::write_config({})); break;
      case 6: command(value); break;
      default: value % 2 == 0 ? session_.open(now_) : session_.close(now_); break;
    }
  }
  void say(const p2os::Packet& packet) { session_.receive(p2os::encode(packet), now_); }
  void say_information(std::uint8_t value) {
    p2os::Sip sip;
    sip.x = static_cast<std::uint16_t>(value << 7U);
    sip.stall_right_front = value;
    sip.sonars = {{value, value}};
    say(p2os::write_sip(sip));
  }
  void command(std::uint8_t value) {
    session_.set_velocity({value / 100.0 - 1.0, value / 50.0 - 2.0}, now_);
    session_.set_motors(value % 2 == 0, now_);
    session_.loop_alive(now_);
  }
  void pass(Duration duration) {
    now_ += duration;
    // The session is served when it wishes to be: it must not wish for ever.
    constexpr int kMostPasses = 1000;
    int passes = 0;
    for (; session_.wake() <= now_ && passes < kMostPasses; ++passes) {
      session_.pass(now_);
    }
    SEEKER_ASSERT(passes < kMostPasses);
  }
  void check() {
    for (const drivers::LineAction& action : session_.take_actions()) {
      if (const auto* baud = std::get_if<drivers::SetBaud>(&action)) {
        SEEKER_ASSERT(baud->baud >= 9600 && baud->baud <= 115200);
      }
    }
    if (const auto sample = session_.take_odometry()) {
      SEEKER_ASSERT(is_finite(sample->odom_T_base));
      SEEKER_ASSERT(std::isfinite(sample->velocity.v_m_s) && std::isfinite(sample->velocity.omega_rad_s));
    }
    if (const auto scan = session_.take_sonar()) {
      SEEKER_ASSERT(validate(*scan).has_value() && !scan->readings.empty());
    }
    SEEKER_ASSERT(session_.state() || !session_.state().error().message.empty());
    SEEKER_ASSERT(!session_.wants_reopen() || !session_.state());
  }

  RobotTime now_ = robot_time_s(1.0);
  P2osSession session_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  drivers::P2osParams params;
  params.serial = (data[0] & 1U) != 0;
  params.use_vel2 = (data[0] & 2U) != 0;
  if ((data[0] & 4U) != 0) {
    params.switch_to_baud = 38400;
  }
  Script(params).run(std::span(data + 1, size - 1));
  return 0;
}
