#include "server/drivers/p2os/p2os_handshake.hpp"

#include <algorithm>
#include <utility>

#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace seeker::drivers {
namespace {

using p2os::CommandId;
using p2os::PacketId;

/// Old connections that are closed before the base counts as one that cannot be closed.
constexpr int kMaxCloses = 5;

/// Whether only a base in a connection sends this.
bool is_stream(const p2os::Packet& packet) {
  return p2os::is_sip(packet) || packet.is(PacketId::kConfig) || packet.is(PacketId::kEncoder) ||
         packet.is(PacketId::kGyro);
}

}  // namespace

void P2osHandshake::begin(RobotTime now) {
  rates_ = params_.serial ? params_.bauds : std::vector<std::uint32_t>{0};
  if (params_.serial && baud_ != 0) {
    std::erase(rates_, baud_);
    rates_.insert(rates_.begin(), baud_);
  }
  closes_ = 0;
  search_again_ = false;
  identity_.reset();
  failure_.reset();
  bytes_before_ = line_.statistics().bytes_in;
  use_rate(0);
  send_sync(Step::kSync0, now);
}

void P2osHandshake::use_rate(std::size_t rate) {
  rate_ = rate;
  tries_ = 0;
  baud_ = rates_[rate];
  if (params_.serial) {
    line_.set_baud(baud_);
  }
  line_.drop_input();
}

void P2osHandshake::send_sync(Step step, RobotTime now) {
  step_ = step;
  line_.write(p2os::encode({static_cast<std::uint8_t>(step), {}}));
  deadline_ = now + params_.sync_timeout;
}

void P2osHandshake::pause(Duration duration, RobotTime now) {
  step_ = Step::kPause;
  deadline_ = now + duration;
}

void P2osHandshake::close_old_connection(RobotTime now) {
  line_.write(p2os::encode_command(CommandId::kClose, 1));
  pause(params_.close_settle, now);
}

void P2osHandshake::on_packet(const p2os::Packet& packet, RobotTime now) {
  if (step_ == Step::kPause || step_ == Step::kEnd) {
    return;
  }
  const auto expected = static_cast<std::uint8_t>(step_);
  if (is_stream(packet)) {
    on_stream(now);
  } else if (packet.id < expected) {
    // A late answer to an earlier try.
  } else if (packet.id > expected) {
    try_again(params_.restart_pause, now);
  } else if (step_ == Step::kSync2) {
    on_identity(packet, now);
  } else {
    send_sync(step_ == Step::kSync0 ? Step::kSync1 : Step::kSync2, now);
  }
}

void P2osHandshake::on_stream(RobotTime now) {
  if (++closes_ > kMaxCloses) {
    end_with(Errc::kBusy,
             "the base stays in a connection of before and does not close it; another program may be connected: end "
             "it, or press the base's reset button");
    return;
  }
  search_again_ = true;
  tries_ = 0;
  close_old_connection(now);
}

void P2osHandshake::on_identity(const p2os::Packet& packet, RobotTime now) {
  Result<p2os::Identity> identity = p2os::read_identity(packet);
  if (!identity) {
    line_.count_bad_content();
    try_again(params_.restart_pause, now);
    return;
  }
  identity_ = std::move(*identity);
  step_ = Step::kEnd;
  deadline_ = RobotTime::max();
}

void P2osHandshake::try_again(Duration pause_before, RobotTime now) {
  if (++tries_ >= params_.sync_tries) {
    next_rate(now);
  } else if (tries_ + 1 == params_.sync_tries) {
    // A base in a connection that happens to send nothing takes SYNC0 for PULSE: the last try closes first.
    close_old_connection(now);
  } else {
    pause(pause_before, now);
  }
}

void P2osHandshake::next_rate(RobotTime now) {
  const std::size_t next = std::exchange(search_again_, false) ? 0 : rate_ + 1;
  if (next >= rates_.size()) {
    end_with(Errc::kTimeout, silence());
    return;
  }
  use_rate(next);
  send_sync(Step::kSync0, now);
}

void P2osHandshake::pass(RobotTime now) {
  if (step_ == Step::kEnd || now < deadline_) {
    return;
  }
  if (step_ == Step::kPause) {
    line_.drop_input();
    send_sync(Step::kSync0, now);
  } else {
    try_again(params_.restart_pause, now);
  }
}

void P2osHandshake::end_with(Errc code, std::string message) {
  step_ = Step::kEnd;
  deadline_ = RobotTime::max();
  failure_ = Error{code, std::move(message)};
}

std::string P2osHandshake::silence() const {
  const bool heard = line_.statistics().bytes_in > bytes_before_;
  if (!params_.serial) {
    return heard ? "what answers at the base's address speaks another protocol; check address and port"
                 : "the base does not answer; check that it is on and that nothing else is connected to it";
  }
  return heard ? "what is heard on the base's line is not its protocol at any rate; check port, cable and the base's "
                 "rate"
               : "the base answers at none of its rates; check that it is on, and the port and the cable";
}

std::string P2osHandshake::progress() const {
  const std::string at = params_.serial ? " at " + std::to_string(baud_) + " baud" : "";
  if (step_ == Step::kPause) {
    return "waiting before a new handshake with the base" + at;
  }
  return "waiting for the base's answer to SYNC" + std::to_string(static_cast<int>(step_)) + at;
}

}  // namespace seeker::drivers
