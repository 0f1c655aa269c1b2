/// \file
/// Watches the robots of a fleet run against the truth: what each touches, and what it spends its time on.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/app/loop/robot_loop.hpp"
#include "server/sim/simulation.hpp"

namespace seeker::lab {

class FleetWatch {
 public:
  /// Both must outlive the watch.
  void add(std::string id, const app::RobotLoop& loop, const sim::Simulation& simulation);
  /// Between two ticks, while no robot's loop runs.
  void look(RobotTime now);

  /// Touches of another robot; one of two robots counts for each of them that drove when it happened.
  [[nodiscard]] int robot_touches() const { return robot_touches_; }
  /// Robot time that all robots together stood and waited for others, seconds.
  [[nodiscard]] double waited_s() const { return waited_s_; }
  /// When the first robot had ended; 0 when none has.
  [[nodiscard]] double first_end_s() const { return first_end_s_; }
  /// One line for every touch, and for whatever a robot began to do: robot time, robot, what.
  [[nodiscard]] std::string log() const { return log_; }

 private:
  struct Watched {
    std::string id;
    const app::RobotLoop* loop = nullptr;
    const sim::Simulation* simulation = nullptr;
    int contacts = 0;
    Twist2 velocity;  ///< at the look before: a touch ends motion
    std::string activity;
    bool ended = false;
  };

  void look_at_touches(std::size_t index, RobotTime now);
  void look_at_activity(Watched& robot, RobotTime now);
  void note(RobotTime now, const Watched& robot, const std::string& what);

  std::vector<Watched> robots_;
  int robot_touches_ = 0;
  double waited_s_ = 0.0;
  double first_end_s_ = 0.0;
  RobotTime last_;
  std::string log_;
};

}  // namespace seeker::lab
