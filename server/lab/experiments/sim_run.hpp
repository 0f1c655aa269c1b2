/// \file
/// What every experiment with a simulated robot shares: what to run, in which world, and who watches it.
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

/// The robot file with the run's world, seed and overrides; as fast as the machine can.
[[nodiscard]] Result<app::RobotOptions> sim_options(const SimSpec& spec);

/// Of what shapes every run: the options (world by name, seed left out), the world's file and its base, the time limit.
/// A kind of run adds what else shapes it. Errors: those of the options, and of the world's files.
[[nodiscard]] Result<TextHash> settings_hash(Result<app::RobotOptions> options, const SimSpec& spec);

/// Where the robot really was at one step.
struct TrueStep {
  RobotTime stamp;
  Pose2 world_T_base;
};

/// Watches a loop and the truth behind it from outside while it runs. Both must outlive it.
class RunWatch {
 public:
  RunWatch(app::RobotLoop& loop, const sim::Simulation& simulation);

  /// Before every pass of the loop.
  void look();

  /// At the moment of a stamp; of the last step for later ones. There must have been one.
  [[nodiscard]] const Pose2& world_T_base_at(RobotTime stamp) const;
  [[nodiscard]] sim::GroundTruth truth() const { return simulation_.truth(); }
  [[nodiscard]] const std::vector<TrueStep>& steps() const { return steps_; }
  [[nodiscard]] std::vector<Pose2> true_path() const;  ///< in the frame `world`, thinned out
  [[nodiscard]] const std::vector<api::Event>& events() const { return events_; }
  [[nodiscard]] std::string event_hash() const { return hash_.hex(); }  ///< kinds, texts, severities, mission times
  [[nodiscard]] double error_m() const { return error_m_; }             ///< believed against true pose, last look
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

/// Starts the loop and the mission and goes on until it has ended, as fast as the machine can; `look` is called before
/// every pass of the loop. The wall time it took, in seconds; the robot's own error where it refuses the mission.
[[nodiscard]] Result<double> run_mission(app::RobotLoop& loop, const api::MissionRequest& request,
                                         const std::function<void()>& look);

/// A mission's log for people: robot time of the mission, kind and text of every event.
[[nodiscard]] std::string log_text(const std::vector<api::Event>& events);

}  // namespace seeker::lab
