/// \file
/// One exploration in the simulator, in this process and without network: the loop of seekerd, scored against the true
/// state that the loop has no access to.
#pragma once

#include <optional>
#include <vector>

#include "common/api/mission.hpp"
#include "common/core/line_map.hpp"
#include "server/lab/active_slam/explore_result.hpp"
#include "server/lab/experiments/behaviour_timer.hpp"
#include "server/lab/experiments/sim_run.hpp"
#include "server/lab/scoring/wall_share.hpp"

namespace seeker::lab {

struct ExploreSpec : SimSpec {
  api::ExploreStrategy strategy = api::ExploreStrategy::kActive;
  std::optional<Polygon> bound;  ///< explore only inside it; frame `map`, whose origin is the start
  bool return_to_start = false;
  double wall_near_m = 0.25;  ///< see WallShareParams::near_m
};

/// A place of the true path, and whether the robot followed a wall there.
struct PathPlace {
  Point2 p_world = Point2::Zero();
  bool along_wall = false;
};

/// A run with the data for pictures.
struct ExploreRecord {
  ExploreResult result;
  std::vector<ExploreSample> samples;  ///< one for each second
  std::vector<api::Event> events;
  std::vector<PathPlace> true_path;
  std::vector<Pose2> believed_path;  ///< estimated path, frame `map`
  std::vector<MapSegment> segments;  ///< frame `map`
  std::vector<Point2> unreachable;   ///< frame `map`
  Topology topology;                 ///< frame `map`; empty where the strategy keeps none
  WallShare walls;
  TrueWalls truth_walls;
  sim::GroundTruth truth;
  sim::World world;
  double robot_radius_m = 0.26;
};

/// Hash of everything that affects a run except the seed.
[[nodiscard]] Result<std::string> settings_of(const ExploreSpec& spec);

/// Called before every pass of the loop.
using ExploreWatcher = std::function<void(const app::RobotLoop&, sim::Simulation&)>;

/// Runs until the mission's end. Errors: those of the files, and a refused mission.
[[nodiscard]] Result<ExploreRecord> run_explore(const ExploreSpec& spec, const ExploreWatcher& watcher = {});

}  // namespace seeker::lab
