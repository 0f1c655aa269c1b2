/// \file
/// WorldLink knows the robot's time, and whether the world that its devices are in can be reached.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/core/result.hpp"
#include "common/core/tick_timing.hpp"
#include "common/core/time.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/missions/mission_executor.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::app {

/// A world that cannot be reached is one fault of all drivers, which are in ERROR until it is back. Robot time stands
/// still meanwhile, so that patience with it is counted on the wall clock. Lives on the loop's thread.
class WorldLink {
 public:
  /// `type` names the devices ("sim", "replay") where a fault does. A tick lasts `period` of robot time. A world that
  /// is away for longer than `patience` of wall time ends what the robot does. `diagnostics` outlives the link.
  WorldLink(std::shared_ptr<drivers::Clock> clock, std::string type, Duration period, Duration patience,
            Diagnostics& diagnostics);

  [[nodiscard]] RobotTime now() const { return clock_->now(); }
  /// As in drivers::Clock: advance() ends a tick, await() waits for the next one, in a shared world too, hold() makes
  /// the others in it wait for this robot, let_go() lets them go on without it.
  [[nodiscard]] Status advance() { return clock_->advance(period_); }
  [[nodiscard]] Result<bool> await(Duration limit) { return clock_->await(limit); }
  void hold() { clock_->hold(); }
  void let_go() { clock_->let_go(); }
  [[nodiscard]] double speed() const { return clock_->speed(); }
  [[nodiscard]] std::optional<TickTiming> timing() const { return clock_->timing(); }
  /// True when robot time runs as fast as the wall clock.
  [[nodiscard]] bool realtime() const;

  /// Returns whether the world is there, and keeps the fault `world-lost` and the drivers' states up to date.
  bool check();
  /// Does the same as check() between ticks; returns the error of Clock::reachable() once the world has been away for
  /// too long.
  [[nodiscard]] Status watch(WallTime wall_now);
  /// True when the world was away at the last watch().
  [[nodiscard]] bool lost() const { return lost_at_.has_value(); }
  /// Returns why the robot can do nothing now: its world is away, or the source of its readings has ended.
  [[nodiscard]] Status within_reach() const;
  /// Returns when the world last came back: readings can be expected since then.
  [[nodiscard]] RobotTime back_at() const { return back_at_; }
  /// Returns the remedy for an error of Clock::reachable().
  [[nodiscard]] static std::string remedy_for(const Error& lost);
  /// Returns whether the fault was raised since the last call, so that clients get a status at once.
  [[nodiscard]] bool take_loss() { return std::exchange(newly_lost_, false); }

  /// Notes that the source of the readings has ended; returns false when that was known.
  bool end() { return !std::exchange(ended_, true); }
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  std::shared_ptr<drivers::Clock> clock_;
  std::string type_;
  Duration period_;
  Duration patience_;
  Diagnostics& diagnostics_;
  std::optional<WallTime> lost_at_;
  RobotTime back_at_;
  bool newly_lost_ = false;
  bool ended_ = false;
};

}  // namespace seeker::app
