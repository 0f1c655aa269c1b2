/// \file
/// Common parts of all experiments with a simulated robot: robot and world of a run, and the observation of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/api/robot_state.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/app/loop/robot_loop.hpp"
#include "server/lab/experiments/text_hash.hpp"
#include "server/sim/simulation.hpp"

namespace seeker::lab {

/// Robot, world and seed of one run.
struct SimSpec {
  std::filesystem::path robot_file = "config/robots/sim.yaml";
  std::filesystem::path world_file;
  std::uint64_t seed = 1;
  bool random_target = false;          ///< the world's first target stands at a place drawn from the seed
  double time_limit_s = 3600.0;        ///< robot time
  std::vector<std::string> overrides;  ///< "key.path=value" of the robot file
};

/// The robot file with the run's world, seed and overrides, at the highest speed.
[[nodiscard]] Result<app::RobotOptions> sim_options(const SimSpec& spec);

/// Hash of what affects every run: the options (world by name, without seed), the world's file and its base, the time
/// limit. A kind of run adds its further parameters. Errors: those of the options and of the world's files.
[[nodiscard]] Result<TextHash> settings_hash(Result<app::RobotOptions> options, const SimSpec& spec);

/// The true pose of the robot at one step.
struct TrueStep {
  RobotTime stamp;
  Pose2 world_T_base;
};

/// Observes a loop and the true state of its robot from outside while it runs. Both must outlive it.
class RunWatch {
 public:
  RunWatch(app::RobotLoop& loop, const sim::Simulation& simulation);

  /// Call before every pass of the loop.
  void look();

  /// The true pose at a stamp; for later stamps that of the last step. At least one step must be recorded.
  [[nodiscard]] const Pose2& world_T_base_at(RobotTime stamp) const;
  [[nodiscard]] sim::GroundTruth truth() const { return simulation_.truth(); }
  [[nodiscard]] const std::vector<TrueStep>& steps() const { return steps_; }
  [[nodiscard]] std::vector<Pose2> true_path() const;  ///< in the frame `world`, thinned out
  [[nodiscard]] const std::vector<api::Event>& events() const { return events_; }
  /// Over kinds, texts, severities and mission times.
  [[nodiscard]] std::string event_hash() const { return hash_.hex(); }
  [[nodiscard]] double error_m() const { return error_m_; }  ///< estimated against true pose at the last look()
  [[nodiscard]] double error_rad() const { return error_rad_; }
  [[nodiscard]] double max_error_m() const { return max_error_m_; }

 private:
  void take(const api::Event& event);

  app::RobotLoop& loop_;
  const sim::Simulation& simulation_;
  std::vector<TrueStep> steps_;
  std::vector<api::Event> events_;
  TextHash hash_;
  double error_m_ = 0.0;
  double error_rad_ = 0.0;
  double max_error_m_ = 0.0;
};

/// Starts the loop and the mission and steps until the mission has ended, at the highest speed; `look` is called before
/// every pass of the loop. Returns the wall time in seconds, or the robot's own error where it refuses the mission.
[[nodiscard]] Result<double> run_mission(app::RobotLoop& loop, const api::MissionRequest& request,
                                         const std::function<void()>& look);

/// The log of a mission for people: robot time of the mission, kind and text of every event.
[[nodiscard]] std::string log_text(const std::vector<api::Event>& events);

}  // namespace seeker::lab
