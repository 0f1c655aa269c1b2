#include "server/app/loop/world_link.hpp"

#include <utility>

namespace seeker::app {
namespace {

constexpr const char* kWorldLost = "world-lost";

}  // namespace

WorldLink::WorldLink(std::shared_ptr<drivers::Clock> clock, std::string type, Duration period, Duration patience,
                     Diagnostics& diagnostics)
    : clock_(std::move(clock)),
      type_(std::move(type)),
      period_(period),
      patience_(patience),
      diagnostics_(diagnostics),
      back_at_(clock_->now()) {}

bool WorldLink::realtime() const { return !clock_->lockstep() || clock_->speed() == 1.0; }

std::string WorldLink::remedy_for(const Error& lost) {
  return lost.code == Errc::kCancelled
             ? "restart seekerd: it enters the world that is there now"
             : "check that seeker-emulator runs and the network to it; the robot goes on when its world is back";
}

bool WorldLink::check() {
  const Status there = clock_->reachable();
  if (there) {
    if (diagnostics_.clear(kWorldLost)) {
      diagnostics_.components().go_on();
      back_at_ = now();
    }
    return true;
  }
  const Error& lost = there.error();
  diagnostics_.components().hold_up("driver", lost.message);
  const std::optional<api::Fault> before = diagnostics_.faults().find(kWorldLost);
  if (!before || before->message != lost.message) {
    diagnostics_.raise(kWorldLost, type_, lost.message, remedy_for(lost));
    newly_lost_ = true;
  }
  return false;
}

Status WorldLink::watch(WallTime wall_now) {
  if (check()) {
    lost_at_.reset();
    return {};
  }
  lost_at_ = lost_at_.value_or(wall_now);
  return wall_now - *lost_at_ > patience_ ? clock_->reachable() : Status();
}

Status WorldLink::within_reach() const {
  if (const Status there = clock_->reachable(); !there) {
    return fail(Errc::kNotReady, there.error().message + "; " + remedy_for(there.error()));
  }
  return ended_ ? fail(Errc::kNotReady, "what the robot senses has ended; restart seekerd") : Status();
}

}  // namespace seeker::app
