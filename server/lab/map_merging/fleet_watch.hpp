/// \file
/// Compares the robots of a fleet run with the true state: their contacts, and the use of their time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/app/loop/robot_loop.hpp"
#include "server/sim/simulation.hpp"

namespace seeker::lab {

class FleetWatch {
 public:
  /// Adds a robot. Both objects must outlive the watch.
  void add(std::string id, const app::RobotLoop& loop, const sim::Simulation& simulation);
  /// Call between two ticks, while no robot's loop runs.
  void look(RobotTime now);

  /// Number of contacts with another robot; a contact of two robots counts for each of them that drove at the time.
  [[nodiscard]] int robot_touches() const { return robot_touches_; }
  /// Robot time that all robots together waited for others, in seconds.
  [[nodiscard]] double waited_s() const { return waited_s_; }
  /// When the first robot had ended; 0 while none has.
  [[nodiscard]] double first_end_s() const { return first_end_s_; }
  /// One line for every contact and for every activity that a robot began: robot time, robot, text.
  [[nodiscard]] std::string log() const { return log_; }

 private:
  struct Watched {
    std::string id;
    const app::RobotLoop* loop = nullptr;
    const sim::Simulation* simulation = nullptr;
    int contacts = 0;
    Twist2 velocity;  ///< velocity at the previous check, because a contact ends motion
    std::string activity;
    bool ended = false;
  };

  void check_contacts(std::size_t index, RobotTime now);
  void check_activity(Watched& robot, RobotTime now);
  void note(RobotTime now, const Watched& robot, const std::string& what);

  std::vector<Watched> robots_;
  int robot_touches_ = 0;
  double waited_s_ = 0.0;
  double first_end_s_ = 0.0;
  RobotTime last_;
  std::string log_;
};

}  // namespace seeker::lab
