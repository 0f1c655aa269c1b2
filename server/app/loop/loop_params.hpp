/// \file
/// The parameters of the robot loop, and the parts that it is put together from.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "common/core/wheel_calibration.hpp"
#include "server/app/estimators/estimator.hpp"
#include "server/app/loop/configuration.hpp"
#include "server/app/maps/robot_map.hpp"
#include "server/app/missions/mission_executor.hpp"
#include "server/app/runtime/devices.hpp"
#include "server/app/safety/safety_supervisor.hpp"
#include "server/lines/make_extractor.hpp"
#include "server/nav/occupancy_map.hpp"
#include "server/vision/stereo_features.hpp"
#include "server/vision/view_features.hpp"

namespace seeker::app {

/// What is assumed of other robots of the fleet that drive about.
struct FleetMotionParams {
  double robot_radius_m = 0.26;
  double slack_m = 0.15;                       ///< error of a reported place: of both poses and of both maps
  double slack_m_s = 0.5;                      ///< growth of that error for each second since the report
  Duration max_age = std::chrono::seconds(2);  ///< an older report says nothing about where the robot is now
};

/// Which of the sensors with ranges an occupancy map is written from.
enum class RangeSensor : std::uint8_t { kLidar, kSonar };

/// Which sensors feed the estimator, besides the odometry of the base.
struct PoseInputs {
  bool scan = true;      ///< of the lidar
  bool pictures = true;  ///< of the stereo camera
};

/// What feeds the occupancy map, besides the pose.
struct MapInputs {
  RangeSensor ranges = RangeSensor::kLidar;  ///< a robot without a lidar maps with its sonar in any case
};

/// Which sensors feed a part of the robot that keeps clear of obstacles; it goes without one that does not feed it.
struct RangeInputs {
  bool scan = true;    ///< of the lidar
  bool echoes = true;  ///< of the sonar ring
};

/// Who feeds whom, as the robot file composes it. All other connections between components are always there.
struct Connections {
  PoseInputs pose;
  MapInputs map;
  RangeInputs planner;
  RangeInputs safety;
};

/// When features of the camera's pictures are extracted for the fleet.
enum class PicturesAt : std::uint8_t {
  kNever,
  kNodes,   ///< spec S4.5, KEYFRAME: at each node of the topology
  kFrames,  ///< spec S4.5, FRAME: all the time; those at nodes are kept
};
[[nodiscard]] std::string_view to_string(PicturesAt at);

struct NodePictureParams {
  PicturesAt at = PicturesAt::kNodes;
  Duration frame_period = std::chrono::seconds(1);  ///< robot time between two pictures of PicturesAt::kFrames
  int features = 300;                               ///< number of features of a picture
};

struct LoopParams {
  std::string robot_id = "seeker-1";  ///< under which its topology is reported
  Duration period = std::chrono::milliseconds(100);
  Duration base_timeout = std::chrono::milliseconds(500);  ///< the base counts as silent after this robot time
  Duration lidar_timeout = std::chrono::seconds(1);
  Duration sonar_timeout = std::chrono::seconds(1);
  Duration tile_period = std::chrono::milliseconds(500);  ///< robot time between publications of changed tiles
  Duration grid_period =
      std::chrono::seconds(2);  ///< robot time between publications of a search's cell lists and evidence
  Duration topology_period = std::chrono::seconds(1);  ///< robot time between publications of the topology
  double trajectory_spacing_m = 0.1;
  std::size_t max_trajectory = 100'000;  ///< most poses kept; beyond it every second pose of the older half is dropped
  SafetyParams safety;
  MissionParams mission;
  RobotMapParams map;
  FleetMotionParams fleet;
  Connections connections;
  NodePictureParams pictures;
  WheelCalibration odometry_calibration;  ///< taken out of all odometry before anything goes by it
};

/// What the loop is put together from.
struct LoopParts {
  Devices devices;
  std::unique_ptr<Estimator> estimator;
  std::shared_ptr<const vision::StereoExtractor> stereo;  ///< null when no stereo features are needed
  /// Extracts the features of the pictures that are taken for the fleet; null: none are.
  std::shared_ptr<const vision::ViewFeatureExtractor> pictures;
  std::string estimator_type;
  std::string recogniser_type = "by_target";
  std::string planner_type = "by_mission";
  std::function<Status()> activate_recogniser;   ///< reads what the recogniser needs; may be empty
  std::shared_ptr<Configuration> configuration;  ///< null: nothing can be set or exchanged while the robot runs
  BehaviourFactory behaviours;
  nav::OccupancyParams occupancy;
  lines::ExtractorParams lines;         ///< of the lines that clients follow
  std::function<void()> forget_places;  ///< called when another map takes over, so that missions forget their places
};

}  // namespace seeker::app
