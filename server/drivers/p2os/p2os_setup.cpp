#include "server/drivers/p2os/p2os_setup.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace seeker::drivers {
namespace {

using p2os::CommandId;

/// A limit in whole units of the wire, at least one.
int whole(double value) { return std::max(1, static_cast<int>(std::lround(value))); }
int mm(double value_m) { return whole(value_m / p2os::kMetre); }
int deg(double value_rad) { return whole(rad_to_deg(value_rad)); }

}  // namespace

void P2osSetup::begin(const p2os::PioneerModel& model, std::uint32_t baud, RobotTime now) {
  model_ = &model;
  baud_ = baud;
  first_baud_ = baud;
  config_.reset();
  failure_.reset();
  step_ = Step::kOpening;
  line_.write(p2os::encode_command(CommandId::kOpen, 1));
  deadline_ = now + params_.open_timeout;
}

void P2osSetup::on_packet(const p2os::Packet& packet, RobotTime now) {
  if (step_ == Step::kOpening && p2os::is_sip(packet)) {
    on_opened(now);
  } else if (step_ == Step::kAsking && packet.is(p2os::PacketId::kConfig)) {
    on_config(packet, now);
  } else if (step_ == Step::kListening || step_ == Step::kFallingBack) {
    set_up();
  }
}

void P2osSetup::on_opened(RobotTime now) {
  step_ = Step::kAsking;
  deadline_ = now + params_.config_timeout;
  ask_again_ = now + params_.config_retry;
  line_.write(p2os::encode_command(CommandId::kConfig, 1));
}

void P2osSetup::on_config(const p2os::Packet& packet, RobotTime now) {
  Result<p2os::ConfigPacket> config = p2os::read_config(packet);
  if (!config) {
    line_.count_bad_content();
    return;
  }
  config_ = std::move(*config);
  on_configured(now);
}

void P2osSetup::on_configured(RobotTime now) {
  const bool may_change = config_ && config_->auto_baud == p2os::kBaudMayChange;
  if (params_.serial && may_change && params_.switch_to_baud.value_or(baud_) != baud_) {
    const std::uint32_t baud = *params_.switch_to_baud;
    line_.write(p2os::encode_command(CommandId::kHostBaud, p2os::baud_code(baud).value()));
    line_.set_baud(baud);
    baud_ = baud;
    step_ = Step::kSettling;
    deadline_ = now + params_.baud_settle;
  } else {
    set_up();
  }
}

void P2osSetup::listen(Step step, RobotTime now) {
  line_.drop_input();
  line_.write(p2os::encode_command(CommandId::kPulse));
  step_ = step;
  deadline_ = now + params_.baud_timeout;
}

void P2osSetup::pass(RobotTime now) {
  if (step_ == Step::kAsking && now >= ask_again_ && now < deadline_) {
    ask_again_ = now + params_.config_retry;
    line_.write(p2os::encode_command(CommandId::kConfig, 1));
  }
  if (now < deadline_) {
    return;
  }
  switch (step_) {
    case Step::kOpening: end_with("the base accepted the connection and sends nothing; switch it off and on"); break;
    case Step::kAsking: on_configured(now); break;
    case Step::kSettling: listen(Step::kListening, now); break;
    case Step::kListening:
      // The base did not take the new rate: back to the one at which it was found.
      baud_ = first_baud_;
      line_.set_baud(baud_);
      listen(Step::kFallingBack, now);
      break;
    case Step::kFallingBack:
      end_with("the base was lost when its line changed to another rate; leave its rate as it is");
      break;
    case Step::kIdle:
    case Step::kDone: break;
  }
}

RobotTime P2osSetup::wake() const { return step_ == Step::kAsking ? std::min(deadline_, ask_again_) : deadline_; }

void P2osSetup::set_up() {
  limits_ = base_limits(params_, *model_, config_);
  const auto send = [&](CommandId id, int argument) { line_.write(p2os::encode_command(id, argument)); };
  send(CommandId::kSetV, mm(limits_.v_max_m_s));
  send(CommandId::kSetRv, deg(limits_.omega_max_rad_s));
  send(CommandId::kSetA, mm(limits_.acceleration_m_s2));
  send(CommandId::kSetA, -mm(limits_.deceleration_m_s2));
  send(CommandId::kSetRa, deg(limits_.angular_acceleration_rad_s2));
  send(CommandId::kSetRa, -deg(limits_.angular_deceleration_rad_s2));
  send(CommandId::kSonar, params_.use_sonar ? 1 : 0);
  if (config_ && config_->has_gyro == p2os::kGyroSendsPackets) {
    send(CommandId::kGyro, params_.use_gyro ? 1 : 0);
  }
  step_ = Step::kDone;
  deadline_ = RobotTime::max();
}

void P2osSetup::end_with(std::string message) {
  step_ = Step::kIdle;
  deadline_ = RobotTime::max();
  failure_ = Error{Errc::kTimeout, std::move(message)};
}

std::string P2osSetup::progress() const {
  switch (step_) {
    case Step::kOpening: return "waiting for the base's first information";
    case Step::kAsking: return "waiting for the base's configuration";
    case Step::kIdle:
    case Step::kSettling:
    case Step::kListening:
    case Step::kFallingBack:
    case Step::kDone: break;
  }
  return "waiting for the base at " + std::to_string(baud_) + " baud";
}

}  // namespace seeker::drivers
