/// \file
/// What decides where the robot goes while a mission runs. One body per mission task.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/api/mission.hpp"
#include "common/api/perception.hpp"
#include "common/api/robot_state.hpp"
#include "common/core/map_move.hpp"
#include "common/core/pose_estimate.hpp"
#include "common/core/scan.hpp"
#include "common/core/topology.hpp"
#include "server/app/estimators/stereo_look.hpp"
#include "server/app/missions/mission_memory.hpp"
#include "server/nav/movers.hpp"
#include "server/nav/occupancy_map.hpp"
#include "server/slam/map_tracker.hpp"
#include "server/vision/recogniser_params.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::app {

/// What a behaviour may know at one tick. Pointers are valid during the call and null where nothing is fitted or new.
struct Situation {
  RobotTime now;
  PoseEstimate pose;
  Twist2 velocity;
  const LaserScan* scan = nullptr;
  const SonarScan* sonar = nullptr;
  const nav::OccupancyMap* map = nullptr;
  const slam::MapTracker* tracker = nullptr;  ///< keeper of the map of segments; null: the estimator keeps none
  bool relocalising = false;                  ///< the robot is being looked for in the map, for a limited time
  bool map_is_read_only = false;              ///< the robot only localises in the map of segments
  std::optional<double> battery_v;
  Pose2 odom_T_base;                  ///< by dead reckoning: goes on where the pose is not known
  std::string map_name;               ///< under which the map of segments was saved or loaded; empty: neither
  bool has_stereo = false;            ///< there is a stereo camera to look with
  const FleetView* fleet = nullptr;   ///< other robots, frame `map`; null: the robot is alone
  std::vector<nav::Mover> movers;     ///< other robots where they are now, frame `map`
  std::optional<Duration> time_left;  ///< of the mission's limit; nothing: it has none
};

/// A line for the mission's log, without stamps: the executor adds them.
struct BehaviourEvent {
  std::string kind;
  std::string text;
  api::Severity severity = api::Severity::kInfo;
};

/// What a behaviour wants at one tick.
struct Decision {
  Twist2 command;
  bool wants_image = false;           ///< recognise the targets in a picture taken now
  bool wants_look = false;            ///< see with both eyes now; on_look() follows
  std::optional<PoseEstimate> place;  ///< where the robot was found to be: the estimator is set to it
  bool step_done = false;             ///< a natural place to stop (link policy FINISH_STEP)
  std::string phase;
  std::string activity;
  double progress = 0.0;
  std::vector<Point2> planned_path;
  std::vector<BehaviourEvent> events;
  std::optional<ExploreDecision> exploration;  ///< where to explore next, in the step that decided
  std::optional<api::MissionEnd> end;
};

/// The recognisers' answer to wants_image.
struct Recognition {
  RobotTime stamp;
  Pose2 map_T_base;  ///< where the picture was taken
  std::vector<vision::Sighting> sightings;
  std::optional<LaserScan> scan;  ///< newest at the exposure
  std::optional<SonarScan> sonar;
};

class Behaviour {
 public:
  Behaviour() = default;
  Behaviour(const Behaviour&) = delete;
  Behaviour& operator=(const Behaviour&) = delete;
  virtual ~Behaviour() = default;

  [[nodiscard]] virtual Decision step(const Situation& situation) = 0;
  /// What looks at the pictures this behaviour asks for; null when it asks for none.
  [[nodiscard]] virtual std::shared_ptr<const vision::Recogniser> recogniser() const { return nullptr; }
  /// Makes the recogniser again with other parameters, while the mission goes on. Errors leave it as it was.
  [[nodiscard]] virtual Status use(const vision::RecogniserParams& /*params*/) { return {}; }
  virtual void on_recognition(const Recognition& /*recognition*/) {}
  /// The answer to wants_look, or why there is none.
  virtual void on_look(const Result<StereoLook>& /*look*/) {}
  /// Whether it can go on where the pose is lost.
  [[nodiscard]] virtual bool needs_pose() const { return true; }
  /// A loop closure moved the map: `move` takes places of the map before to the map now.
  virtual void map_moved(const MapMove& /*move*/) {}
  /// Why the mission is over already, while the robot still drives back to its start.
  [[nodiscard]] virtual std::optional<api::MissionEnd> pending_end() const { return std::nullopt; }
  /// Time passes without steps while paused.
  virtual void resumed(RobotTime /*now*/) {}
  [[nodiscard]] virtual std::optional<api::GridReport> grid() const { return std::nullopt; }
  /// Of an exploration by topology: places it has been at and still means to go to, and the goal it drives to.
  [[nodiscard]] virtual const Topology* topology() const { return nullptr; }
  [[nodiscard]] virtual std::optional<Point2> target_map() const { return std::nullopt; }
  /// Whether it explores and shares that with other robots, which leave to it what is its share.
  [[nodiscard]] virtual bool shares_exploration() const { return false; }
  /// What it goes on from when the program is cut off, and is given back before its first step.
  [[nodiscard]] virtual MissionMemory memory() const { return {}; }
  virtual void remember(const MissionMemory& /*memory*/) {}
  /// Where the mission began, when that is not where the robot makes its first step. Before that.
  virtual void remember_start(const Point2& /*start_map*/) {}
  /// What it has searched itself, within a square of so many cells around a point, as it is reported to other robots.
  [[nodiscard]] virtual std::optional<SearchedFloor> searched(const Point2& /*middle_map*/, int /*side_cells*/) const {
    return std::nullopt;
  }
  /// Everything found so far, with ids from 1 that stay.
  [[nodiscard]] virtual std::vector<api::Detection> detections() const { return {}; }
};

}  // namespace seeker::app
