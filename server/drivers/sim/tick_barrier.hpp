/// \file
/// Runs several robot loops of one process in one simulated world, each on its own thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>

#include "server/drivers/sim/tick_gate.hpp"
#include "server/sim/shared_world.hpp"

namespace seeker::drivers {

/// A barrier for the ticks of several loops; it is thread-safe. The thread that finishes a tick last advances the world
/// while all others wait.
class TickBarrier {
 public:
  explicit TickBarrier(std::shared_ptr<sim::SharedWorld> world);

  /// See Clock::hold() and Clock::let_go().
  void hold(std::size_t robot);
  void let_go(std::size_t robot);
  /// Blocks until the world has advanced by `period`, which is above zero, for this robot.
  void advance(std::size_t robot, Duration period);

  /// Called whenever the world has advanced, while all robots stand still. Loops exchange data here, so that the result
  /// does not depend on the timing of their threads. Set it before the first tick; it must not call this object.
  std::function<void(RobotTime now)> between;

 private:
  void go_on_if_due();

  std::shared_ptr<sim::SharedWorld> world_;
  std::mutex mutex_;
  std::condition_variable gone_on_;
  TickGate gate_;
};

}  // namespace seeker::drivers
