#include "server/drivers/interfaces/pacer.hpp"

#include <algorithm>
#include <thread>

#include "common/core/assert.hpp"

namespace seeker::drivers {

Pacer::Pacer(double speed) : speed_(speed) { SEEKER_ASSERT(speed >= 0.0); }

void Pacer::start(Duration period) {
  if (speed_ > 0.0) {
    static_cast<void>(due(period, std::chrono::steady_clock::now()));
    awaited_ = true;
  }
}

bool Pacer::await(Duration limit) {
  if (!awaited_) {
    return true;
  }
  const WallTime until = std::chrono::steady_clock::now() + limit;
  std::this_thread::sleep_until(std::min(until, *due_));
  if (until < *due_) {
    return false;
  }
  awaited_ = false;
  begun(std::chrono::steady_clock::now());
  return true;
}

Pacer::WallTime Pacer::due(Duration period, WallTime now) {
  due_ = due_ ? *due_ + seconds(to_seconds(period) / speed_) : now;
  return *due_;
}

void Pacer::begun(WallTime now) {
  SEEKER_ASSERT(due_);
  const Duration late = std::max(Duration::zero(), Duration(now - *due_));
  ++timing_.ticks;
  timing_.late += late > TickTiming::kLate ? 1 : 0;
  timing_.worst = std::max(timing_.worst, late);
  if (late > kMaxLag) {
    due_ = now;
  }
}

std::optional<TickTiming> Pacer::timing() const {
  return speed_ > 0.0 ? std::optional<TickTiming>(timing_) : std::nullopt;
}

}  // namespace seeker::drivers
