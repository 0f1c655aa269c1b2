/// \file
/// One search in the simulator, in this process and without network: the loop of seekerd, scored against the true state
/// that the loop has no access to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/api/mission.hpp"
#include "common/api/robot_state.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/lab/experiments/sim_run.hpp"
#include "server/lab/search/run_result.hpp"
#include "server/search/search_types.hpp"
#include "server/sim/simulation.hpp"

namespace seeker::lab {

/// Parameters of a run.
struct RunSpec : SimSpec {
  std::filesystem::path target_folder;  ///< folder of the target files; empty: `targets` beside the folder of the world
  search::Strategy strategy = search::Strategy::kPlan;
  api::OnFound on_found = api::OnFound::kApproach;
  bool explore = false;  ///< true: the search maps the building too
};

/// A run with the data for pictures. Points of the robot are in its frame `map`.
struct RunRecord {
  RunResult result;
  api::MissionStatus status;
  std::vector<api::Event> events;  ///< the mission's log
  std::vector<Pose2> trajectory;   ///< estimated poses
  std::vector<Pose2> true_path;    ///< in the frame `world`
  std::optional<Grid<std::uint8_t>> occupancy;
  std::optional<api::GridReport> grid;
  std::vector<api::Detection> detections;
  sim::GroundTruth truth;
  sim::World world;
  double robot_radius_m = 0.26;
};

/// The robot file with the run's world, seed and overrides.
[[nodiscard]] Result<app::RobotOptions> options_of(const RunSpec& spec);
/// Hash of everything that affects a run except the seed.
[[nodiscard]] Result<std::string> settings_of(const RunSpec& spec);
/// The target that a search in this world looks for: the world's first target, or "cross" where it has none.
[[nodiscard]] Result<api::TargetSpec> target_of(const sim::World& world, const RunSpec& spec);

/// Runs until the mission's end. Errors: those of the files, and a refused mission.
[[nodiscard]] Result<RunRecord> run_search(const RunSpec& spec);

}  // namespace seeker::lab
