#include "server/drivers/p2os/p2os_session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/assert.hpp"
#include "server/drivers/p2os/unseen_motion.hpp"
#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/gyro_packet.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace seeker::drivers {
namespace {

using p2os::CommandId;

/// Time from one information packet to the next of a base that does not state it.
constexpr Duration kSipCycle = std::chrono::milliseconds(100);
/// Time without a command after which a base that does not state it halts.
constexpr Duration kWatchdog = std::chrono::seconds(2);
/// PULSE comes so often within the base's watchdog interval that two may be lost.
constexpr int kPulsesPerWatchdog = 3;
/// Start bit, data, stop bit.
constexpr double kBitsPerByte = 10.0;

/// Without a stated cycle or watchdog the defaults stand.
Duration sip_cycle(const std::optional<p2os::ConfigPacket>& config) {
  return config && config->sip_cycle_ms > 0 ? std::chrono::milliseconds(config->sip_cycle_ms) : kSipCycle;
}

Duration watchdog(const std::optional<p2os::ConfigPacket>& config) {
  return config && config->watchdog_ms > 0 ? std::chrono::milliseconds(config->watchdog_ms) : kWatchdog;
}

Duration pulse_period(const P2osParams& params, const std::optional<p2os::ConfigPacket>& config) {
  if (!config || config->watchdog_ms == 0) {
    return params.pulse_period;
  }
  return std::min<Duration>(params.pulse_period, std::chrono::milliseconds(config->watchdog_ms) / kPulsesPerWatchdog);
}

}  // namespace

P2osSession::P2osSession(P2osParams params)
    : params_(std::move(params)),
      handshake_(params_, line_),
      setup_(params_, line_),
      odometry_(params_),
      sonar_(params_),
      condition_(params_),
      motion_(params_) {
  SEEKER_ASSERT(validate(params_).has_value());
}

void P2osSession::open(RobotTime now) {
  failure_.reset();
  phase_ = Phase::kHandshake;
  handshake_.begin(now);
}

void P2osSession::receive(std::span<const std::uint8_t> bytes, RobotTime now) {
  line_.feed(bytes, now);
  handle_packets(now);
  serve(now);
}

void P2osSession::pass(RobotTime now) {
  while (line_.wake() <= now) {
    line_.pass(now);
    handle_packets(now);
  }
  serve(now);
}

RobotTime P2osSession::wake() const {
  switch (phase_) {
    case Phase::kClosed: return RobotTime::max();
    case Phase::kHandshake: return std::min(line_.wake(), handshake_.wake());
    case Phase::kSetup: return std::min(line_.wake(), setup_.wake());
    case Phase::kRunning: break;
  }
  return std::min({line_.wake(), motion_.wake(), motors_.wake(), last_information_ + params_.sip_timeout});
}

void P2osSession::handle_packets(RobotTime now) {
  while (const auto packet = line_.next()) {
    handle(*packet, now);
  }
}

void P2osSession::handle(const p2os::Packet& packet, RobotTime now) {
  switch (phase_) {
    case Phase::kClosed: break;
    case Phase::kHandshake:
      handshake_.on_packet(packet, now);
      if (handshake_.identity()) {
        on_identity(now);
      }
      break;
    case Phase::kSetup:
      setup_.on_packet(packet, now);
      if (setup_.done()) {
        begin_running(now);
      }
      break;
    case Phase::kRunning:
      if (p2os::is_sip(packet)) {
        on_information(packet, now);
      } else if (packet.is(p2os::PacketId::kGyro)) {
        on_gyro(packet);
      }
      break;
  }
}

void P2osSession::on_identity(RobotTime now) {
  const std::string& subclass = params_.subclass.value_or(handshake_.identity()->subclass);
  model_ = p2os::find_pioneer_model(subclass);
  if (model_ == nullptr) {
    line_.write(p2os::encode_command(CommandId::kClose, 1));
    lose({Errc::kUnsupportedVersion, "the base is a '" + subclass +
                                         "', whose units are not known; if it counts as one of " +
                                         p2os::known_subclasses() + ", name that one as the base's subclass"});
    return;
  }
  phase_ = Phase::kSetup;
  setup_.begin(*model_, handshake_.baud(), now);
}

void P2osSession::begin_running(RobotTime now) {
  phase_ = Phase::kRunning;
  unheard_since_ = ++connects_ > 1 ? std::optional(last_information_) : std::nullopt;
  handshake_.note_baud(setup_.baud());
  odometry_.connect(*model_, sip_cycle(setup_.config()));
  sonar_.connect(*model_);
  condition_.connect();
  motors_.connect(now);
  motion_.connect(*model_, setup_.limits());
  pulse_period_ = pulse_period(params_, setup_.config());
  last_information_ = now;
}

void P2osSession::on_information(const p2os::Packet& packet, RobotTime now) {
  const Result<p2os::Sip> sip = p2os::read_sip(packet);
  if (!sip) {
    line_.count_bad_content();
    return;
  }
  note_unseen_motion(now);
  last_information_ = now;
  driving_ = motion_.commanded();
  last_stamp_ = std::max(last_stamp_, sent_at(packet, now));
  odometry_.add(*sip, last_stamp_);
  sonar_.add(*sip, last_stamp_);
  motors_.show((sip->flags & p2os::flag::kMotorsOn) != 0);
  motion_.show(sip->left_velocity != 0 || sip->right_velocity != 0);
  if (condition_.update(*sip, motion_.commanded())) {
    motion_.halt();
  }
  keep_sample(*sip, last_stamp_);
}

void P2osSession::note_unseen_motion(RobotTime now) {
  if (unheard_since_) {
    odometry_.go_unseen(halfway_unseen(driving_, now - *unheard_since_, watchdog(setup_.config()), setup_.limits()));
  }
}

void P2osSession::on_gyro(const p2os::Packet& packet) {
  if (const auto readings = p2os::read_gyro(packet)) {
    odometry_.add(*readings);
  } else {
    line_.count_bad_content();
  }
}

RobotTime P2osSession::sent_at(const p2os::Packet& packet, RobotTime now) const {
  if (setup_.baud() == 0) {
    return now;
  }
  const double bytes = static_cast<double>(packet.data.size() + p2os::kPrefixBytes + p2os::kMinCount);
  return now - seconds(bytes * kBitsPerByte / setup_.baud());
}

void P2osSession::keep_sample(const p2os::Sip& sip, RobotTime stamp) {
  constexpr double kTenthVolt = 0.1;
  OdometrySample sample;
  sample.stamp = stamp;
  sample.odom_T_base = odometry_.odom_T_base();
  sample.velocity = odometry_.velocity();
  sample.battery_v = sip.battery_x10.value_or(sip.battery_dv) * kTenthVolt;
  sample.motors_enabled = motors_.on();
  sample.stalled = condition_.stalled();
  sample.bumped = condition_.bumped();
  sample.discontinued = std::exchange(unheard_since_, std::nullopt).has_value() || (sample_ && sample_->discontinued);
  sample_ = sample;
}

void P2osSession::serve(RobotTime now) {
  if (phase_ == Phase::kHandshake) {
    handshake_.pass(now);
    if (handshake_.failure()) {
      lose(*handshake_.failure());
    }
  } else if (phase_ == Phase::kSetup) {
    setup_.pass(now);
    if (setup_.failure()) {
      lose(*setup_.failure());
    } else if (setup_.done()) {
      begin_running(now);
    }
  }
  if (phase_ != Phase::kRunning) {
    return;
  }
  if (now - last_information_ >= params_.sip_timeout) {
    line_.write(p2os::encode_command(CommandId::kStop));
    lose({Errc::kLinkLost, "the base has sent no information for " +
                               std::to_string(static_cast<int>(std::lround(1e3 * to_seconds(params_.sip_timeout)))) +
                               " ms; check that it is on, and its cable"});
    return;
  }
  motors_.pass(now, line_);
  motion_.pass(now, condition_, line_);
}

void P2osSession::lose(Error why) {
  failure_ = std::move(why);
  phase_ = Phase::kClosed;
}

void P2osSession::line_lost() {
  static_cast<void>(line_.take_actions());
  phase_ = Phase::kClosed;
}

void P2osSession::close(RobotTime /*now*/) {
  if (phase_ == Phase::kRunning) {
    const auto send = [&](CommandId id, int argument) { line_.write(p2os::encode_command(id, argument)); };
    line_.write(p2os::encode_command(CommandId::kStop));
    send(params_.use_vel2 ? CommandId::kVel2 : CommandId::kVel, 0);
    send(CommandId::kEnable, 0);
    send(CommandId::kSonar, 0);
  }
  if (phase_ == Phase::kRunning || phase_ == Phase::kSetup) {
    if (setup_.baud() != setup_.first_baud()) {
      line_.write(p2os::encode_command(CommandId::kHostBaud, p2os::baud_code(setup_.first_baud()).value()));
      line_.set_baud(setup_.first_baud());
      handshake_.note_baud(setup_.first_baud());
    }
    line_.write(p2os::encode_command(CommandId::kClose, 1));
  }
  phase_ = Phase::kClosed;
}

Status P2osSession::state() const {
  if (failure_) {
    return tl::unexpected<Error>(*failure_);
  }
  switch (phase_) {
    case Phase::kClosed: return fail(Errc::kNotReady, "the base's line is closed; activate the base");
    case Phase::kHandshake: return fail(Errc::kNotReady, handshake_.progress());
    case Phase::kSetup: return fail(Errc::kNotReady, setup_.progress());
    case Phase::kRunning: break;
  }
  return {};
}

LinkStatistics P2osSession::statistics() const {
  LinkStatistics statistics = line_.statistics();
  statistics.connects = connects_;
  return statistics;
}

void P2osSession::set_velocity(const Twist2& velocity, RobotTime now) {
  SEEKER_ASSERT(std::isfinite(velocity.v_m_s) && std::isfinite(velocity.omega_rad_s));
  if (phase_ == Phase::kRunning) {
    motion_.want(velocity, now);
    motion_.pass(now, condition_, line_);
  }
}

void P2osSession::set_motors(bool enabled, RobotTime now) {
  motors_.want(enabled, now);
  if (phase_ == Phase::kRunning && !enabled) {
    // Before ENABLE, which may be lost on its way.
    line_.write(p2os::encode_command(CommandId::kStop));
    motion_.halt();
    motion_.pass(now, condition_, line_);
  }
  if (phase_ == Phase::kRunning) {
    motors_.pass(now, line_);
  }
}

void P2osSession::loop_alive(RobotTime now) {
  if (phase_ == Phase::kRunning && now >= last_pulse_ + pulse_period_) {
    line_.write(p2os::encode_command(CommandId::kPulse));
    last_pulse_ = now;
  }
}

std::optional<OdometrySample> P2osSession::take_odometry() { return std::exchange(sample_, std::nullopt); }

std::optional<Error> P2osSession::base_fault() const {
  if (phase_ != Phase::kRunning) {
    return std::nullopt;
  }
  const auto fault = condition_.fault();
  return fault ? fault : motors_.fault();
}

}  // namespace seeker::drivers
