#include "server/drivers/sim/tick_barrier.hpp"

#include <utility>

#include "common/core/result.hpp"

namespace seeker::drivers {

TickBarrier::TickBarrier(std::shared_ptr<sim::SharedWorld> world) : world_(std::move(world)), gate_(world_->size()) {}

void TickBarrier::hold(std::size_t robot) {
  const std::lock_guard lock(mutex_);
  gate_.hold(robot);
}

void TickBarrier::let_go(std::size_t robot) {
  const std::lock_guard lock(mutex_);
  gate_.let_go(robot);
  go_on_if_due();
}

void TickBarrier::advance(std::size_t robot, Duration period) {
  SEEKER_ASSERT(period > Duration::zero());
  std::unique_lock lock(mutex_);
  gate_.wait(robot, world_->now() + period);
  go_on_if_due();
  gone_on_.wait(lock, [&] { return !gate_.waiting(robot); });
}

void TickBarrier::go_on_if_due() {
  const std::optional<RobotTime> next = gate_.next();
  if (!next) {
    return;
  }
  world_->advance(*next - world_->now());
  if (between) {
    between(*next);
  }
  gate_.reached(*next);
  gone_on_.notify_all();
}

}  // namespace seeker::drivers
