#include "server/emulator/devices/p2os_device.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/assert.hpp"
#include "server/emulator/devices/motion_orders.hpp"
#include "server/emulator/devices/pioneer_config.hpp"
#include "server/protocols/p2os/field_writer.hpp"
#include "server/protocols/p2os/identity.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace seeker::emulator {
namespace {

using p2os::CommandId;
using p2os::PacketId;

constexpr Duration kControlPeriod = std::chrono::milliseconds(20);
/// What a client does not take is lost, as on a line.
constexpr std::size_t kMaxOutputBytes = 4096;
/// What the sonar board reports where no echo comes back.
constexpr std::uint16_t kNoEcho_mm = 5000;

}  // namespace

P2osDevice::P2osDevice(P2osDeviceParams params, P2osDeviceHooks hooks, RobotTime now)
    : params_(std::move(params)),
      hooks_(std::move(hooks)),
      model_(*p2os::find_pioneer_model(params_.subclass)),
      motion_(params_.limits),
      counters_(model_),
      gyro_(model_.gyro_scaler, params_.gyro_rest_count),
      body_(params_, model_) {
  SEEKER_ASSERT(validate(params_).has_value());
  SEEKER_ASSERT(hooks_.read_base && hooks_.read_sonar && hooks_.command);
  power_cycle(now);
}

void P2osDevice::power_cycle(RobotTime now) {
  disconnect();
  reader_.clear();
  output_.clear();
  next_sonar_ = 0;
  body_.feel(hooks_.read_base(now), std::nullopt, motion_);
  counters_.power_on(body_.reading().odom_T_base);
  last_valid_ = last_control_ = now;
}

void P2osDevice::disconnect() {
  step_ = Step::kSync0;
  motion_ = PioneerMotion(params_.limits);
  motors_on_ = false;
  sonar_on_ = true;
  gyro_on_ = false;
  encoders_ = Repeat::kNever;
  bump_stall_ = 0;
  baud_ = params_.baud;
  hooks_.command({});
}

void P2osDevice::receive(std::span<const std::uint8_t> bytes, RobotTime now) {
  pass(now);
  reader_.feed(bytes, now);
  handle_packets(now);
}

void P2osDevice::handle_packets(RobotTime now) {
  while (const auto packet = reader_.next()) {
    if (step_ != Step::kOpen) {
      on_sync(*packet, now);
    } else if (const auto command = p2os::parse_command(*packet)) {
      last_valid_ = now;
      on_command(*command, now);
    }
  }
}

void P2osDevice::on_sync(const p2os::Packet& packet, RobotTime now) {
  const bool in_turn = packet.id == static_cast<std::uint8_t>(step_) && packet.data.empty();
  if (packet.is(PacketId::kSync0)) {
    // The beginning is always in turn.
    send(packet);
    step_ = Step::kSync1;
  } else if (in_turn && step_ == Step::kSync1) {
    send(packet);
    step_ = Step::kSync2;
  } else if (in_turn && step_ == Step::kSync2) {
    send(p2os::write_identity({params_.name, "Pioneer", params_.subclass}));
    step_ = Step::kSynced;
  } else if (step_ == Step::kSynced && packet.id == static_cast<std::uint8_t>(CommandId::kOpen)) {
    open(now);
  } else {
    step_ = Step::kSync0;
  }
}

void P2osDevice::open(RobotTime now) {
  step_ = Step::kOpen;
  last_valid_ = last_control_ = now;
  next_information_ = now + params_.sip_period;
}

void P2osDevice::enable(bool on) {
  motors_on_ = on && !body_.faults().e_stop_pressed;
  if (!motors_on_) {
    motion_.halt();
  }
}

void P2osDevice::on_command(const p2os::Command& command, RobotTime now) {
  if (!obey_motion(command, model_, counters_.odom_T_base(), motion_) &&
      !obey_limit(command, params_, motion_.limits())) {
    on_service(command, now);
  }
}

void P2osDevice::on_service(const p2os::Command& command, RobotTime now) {
  const int value = command.integer().value_or(0);
  switch (static_cast<CommandId>(command.number)) {
    case CommandId::kClose: disconnect(); break;
    case CommandId::kEnable: enable(value != 0); break;
    case CommandId::kSetOrigin:
      counters_.set_zero(body_.reading().odom_T_base);
      motion_.zero_odometry();
      break;
    case CommandId::kConfig: send(p2os::write_config(config_of(params_))); break;
    case CommandId::kEncoder:
      encoders_ = value == 0 ? Repeat::kNever : (value == 1 ? Repeat::kOnce : Repeat::kAlways);
      break;
    case CommandId::kSonar: sonar_on_ = value != 0; break;
    case CommandId::kBumpStall: bump_stall_ = value; break;
    case CommandId::kHostBaud: baud_ = params_.baud == 0 ? 0 : p2os::baud_of_code(value).value_or(baud_); break;
    case CommandId::kGyro:
      gyro_on_ = params_.has_gyro && value != 0;
      gyro_.start(now);
      break;
    default: break;  // PULSE, OPEN, and what other clients send besides
  }
}

void P2osDevice::pass(RobotTime now) {
  while (reader_.wake() <= now) {
    reader_.pass(now);
    handle_packets(now);
  }
  if (step_ != Step::kOpen) {
    return;
  }
  if (now >= last_control_ + kControlPeriod) {
    control(now);
  }
  if (now >= next_information_) {
    send_information(now);
    next_information_ += params_.sip_period;
    if (next_information_ <= now) {
      // What was not sent while nobody let time pass is not made up for.
      next_information_ = now + params_.sip_period;
    }
  }
}

RobotTime P2osDevice::wake() const {
  return step_ == Step::kOpen ? std::min({reader_.wake(), last_control_ + kControlPeriod, next_information_})
                              : reader_.wake();
}

void P2osDevice::control(RobotTime now) {
  const auto bearing_rad = hooks_.contact_bearing_rad ? hooks_.contact_bearing_rad() : std::nullopt;
  body_.feel(hooks_.read_base(now), bearing_rad, motion_);
  counters_.follow(body_.reading().odom_T_base);
  if (gyro_on_) {
    gyro_.follow(body_.reading().velocity.omega_rad_s, now);
  }
  body_.watch_for_stalls(motion_, motors_on_ && !watchdog_holds(now), bump_stall_, now);
  hooks_.command(motion_.step(counters_.odom_T_base(), to_seconds(now - last_control_), power(now)));
  last_control_ = now;
}

PioneerMotion::Power P2osDevice::power(RobotTime now) const {
  if (!motors_on_ || body_.stalled()) {
    return PioneerMotion::Power::kOff;
  }
  return watchdog_holds(now) ? PioneerMotion::Power::kHold : PioneerMotion::Power::kFull;
}

void P2osDevice::set_faults(const P2osFaults& faults) {
  body_.set_faults(faults);
  if (faults.e_stop_pressed) {
    enable(false);
  }
}

void P2osDevice::send(const p2os::Packet& packet) {
  if (body_.faults().silent || output_.size() > kMaxOutputBytes) {
    return;
  }
  const std::vector<std::uint8_t> bytes = p2os::encode(packet);
  output_.insert(output_.end(), bytes.begin(), bytes.end());
}

void P2osDevice::send_information(RobotTime now) {
  p2os::Sip sip;
  counters_.show(sip);
  body_.show(sip);
  const double heading_rad = motion_.heading_rad(counters_.odom_T_base());
  sip.control = static_cast<std::int16_t>(std::lround(heading_rad / p2os::kAngleUnit_rad));
  if (motors_on_) {
    sip.flags |= p2os::flag::kMotorsOn;
  }
  if (sonar_on_) {
    sip.flags |= p2os::flag::kFrontSonar;
    add_sonars(sip, now);
  }
  send(p2os::write_sip(sip));
  if (gyro_on_) {
    send(p2os::write_gyro(gyro_.take()));
  }
  if (encoders_ != Repeat::kNever) {
    send_encoders();
    encoders_ = encoders_ == Repeat::kOnce ? Repeat::kNever : encoders_;
  }
}

void P2osDevice::add_sonars(p2os::Sip& sip, RobotTime now) {
  const SonarScan scan = hooks_.read_sonar(now);
  const std::size_t fitted = std::min(scan.readings.size(), model_.base_T_sonar.size());
  const std::size_t polled = std::min(params_.sonars_per_sip, fitted);
  sip.sonars.reserve(polled);
  for (std::size_t k = 0; k < polled; ++k) {
    next_sonar_ %= fitted;
    const double range = std::min(scan.readings[next_sonar_].range_m / model_.range_unit_m, double{kNoEcho_mm});
    sip.sonars.push_back({static_cast<std::uint8_t>(next_sonar_), static_cast<std::uint16_t>(std::lround(range))});
    ++next_sonar_;
  }
}

void P2osDevice::send_encoders() {
  p2os::FieldWriter out;
  for (const double way_m : {counters_.left_distance_m(), counters_.right_distance_m()}) {
    out.u32(static_cast<std::uint32_t>(std::llround(way_m / p2os::kMetre * kTicksPerMm)));
  }
  send({static_cast<std::uint8_t>(PacketId::kEncoder), out.take()});
}

std::vector<std::uint8_t> P2osDevice::take_output() { return std::exchange(output_, {}); }

}  // namespace seeker::emulator
