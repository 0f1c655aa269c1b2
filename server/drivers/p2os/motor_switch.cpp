#include "server/drivers/p2os/motor_switch.hpp"

#include "server/protocols/p2os/command.hpp"

namespace seeker::drivers {
namespace {

constexpr int kSends = 5;
/// Several information packets long.
constexpr Duration kSendPeriod = std::chrono::milliseconds(400);

}  // namespace

void MotorSwitch::want(bool on, RobotTime now) {
  wanted_on_ = on;
  obeyed_ = false;
  sends_left_ = kSends;
  next_send_ = now;
}

void MotorSwitch::connect(RobotTime now) {
  shown_on_ = false;
  want(wanted_on_, now);
}

void MotorSwitch::show(bool on) {
  shown_on_ = on;
  if (on == wanted_on_ && sends_left_ < kSends) {
    obeyed_ = true;
    sends_left_ = 0;
  }
}

void MotorSwitch::pass(RobotTime now, PacketLine& line) {
  if (sends_left_ > 0 && now >= next_send_) {
    line.write(p2os::encode_command(p2os::CommandId::kEnable, wanted_on_ ? 1 : 0));
    --sends_left_;
    next_send_ = now + kSendPeriod;
  }
}

RobotTime MotorSwitch::wake() const { return sends_left_ > 0 ? next_send_ : RobotTime::max(); }

std::optional<Error> MotorSwitch::fault() const {
  if (!wanted_on_ || shown_on_ || sends_left_ > 0) {
    return std::nullopt;
  }
  return Error{Errc::kRefused, obeyed_ ? "the base's motors were switched off at the base; switch them on again"
                                       : "the base's motors do not switch on; press MOTORS on the base, and check its "
                                         "emergency stop and battery"};
}

}  // namespace seeker::drivers
