/// \file
/// Everything a robot file may say: one tree that mirrors the parameter structs.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/config/yaml.hpp"
#include "server/app/estimators/landmark_estimator.hpp"
#include "server/app/fleet/fleet_settings.hpp"
#include "server/app/loop/loop_params.hpp"
#include "server/app/metrics/metrics_settings.hpp"
#include "server/app/missions/goto_behaviour.hpp"
#include "server/app/missions/search_behaviour.hpp"
#include "server/app/missions/survey_behaviour.hpp"
#include "server/drivers/camera/cameras.hpp"
#include "server/drivers/hardware/hardware_settings.hpp"
#include "server/drivers/replay/replay.hpp"
#include "server/drivers/sim/sim_devices.hpp"
#include "server/explore/explore_params.hpp"
#include "server/fleet/topological_strategy.hpp"
#include "server/lines/make_extractor.hpp"
#include "server/net/server.hpp"
#include "server/sim/robot_model.hpp"
#include "server/slam/line_slam_params.hpp"
#include "server/slam/scan_map_tracker.hpp"

namespace seeker::app {

enum class DriverType : std::uint8_t { kSim, kReplay, kEmulator, kHardware };

struct SimSettings {
  std::string world = "../worlds/demo.yaml";  ///< relative to the robot file, else to the working directory
  std::uint64_t seed = 1;
  double speed = 0.0;          ///< robot seconds per wall second; 0: as fast as possible
  std::uint64_t start = 0;     ///< which of the world's start poses
  bool random_target = false;  ///< put the world's first target at a place drawn from the seed
  bool people = false;         ///< people walk, also where the world file does not say so
  sim::RobotModel robot;
  drivers::SimDeviceParams devices;
};

/// A place in the world of a seeker-emulator.
struct EmulatorSettings {
  std::string address = "127.0.0.1:7472";  ///< host:port
  std::uint64_t robot = 0;                 ///< which robot of the world, from 0
  bool tls = false;                        ///< the world is reached over TLS, with the files of `server.tls`
};

/// Real devices.
struct RealSettings {
  drivers::HardwareSettings devices;
  /// The camera that looks for targets, with omnidirectional optics or not. Nothing: the robot has none.
  std::optional<drivers::CaptureParams> camera;
  drivers::PictureReaderParams camera_reader;
};

struct ReplaySettings {
  std::string log;              ///< CARMEN log, plain or .gz
  double speed = 1.0;           ///< 0: as fast as possible
  bool wait_for_client = true;  ///< the log starts when the first client has connected
  bool exit_at_end = false;
  drivers::ReplayParams params;
};

/// Which sensors of its driver a robot has. One that it has not is never opened, and nothing is expected of it.
struct FittedSensors {
  bool lidar = true;
  bool sonar = true;
  bool camera = true;
  bool stereo = true;
};

/// Whose method the stereo camera serves.
enum class StereoMode : std::uint8_t {
  kDefault,  ///< ours
  kPaper,    ///< as printed in the paper of spec S2: gates, search, association, database, filter, update
};

/// The stereo camera, and what is made of its pictures.
struct StereoSettings {
  /// A file that names another mode than its base means all parameters of that mode, before its own ones; the mounting
  /// of the camera and the numbers of key points stay.
  StereoMode mode = StereoMode::kDefault;
  std::optional<drivers::StereoCameraParams> camera;  ///< a real one, or recorded pictures; else the simulated one
  vision::StereoFeatureParams features;
  localize::DatabaseParams database;
  localize::LocaliserParams localiser;
  LandmarkEstimatorParams estimator;
  SurveyParams survey;
};

struct RobotOptions {
  std::string base;  ///< the robot file that a file builds on; empty once both are read
  std::string robot_id = "seeker-1";
  std::string record;  ///< file of a CARMEN log that the drive is recorded into, plain or .gz; empty: none
  std::optional<MetricsSettings> metrics;  ///< nothing: no page
  DriverType driver = DriverType::kSim;
  /// Of its body. A file that names another value means all radii that plans and checks go by, too, unless it says
  /// them.
  double robot_radius_m = 0.26;
  FittedSensors sensors;
  SimSettings sim;
  EmulatorSettings emulator;
  ReplaySettings replay;
  RealSettings hardware;
  FleetSettings fleet;
  LoopParams loop;
  EstimatorType estimator = EstimatorType::kLineSlam;
  slam::ScanMapParams tracking;  ///< its `odometry` part also drives pure dead reckoning
  lines::ExtractorParams lines;  ///< of every estimator that uses lines, and of the topic `lines`
  slam::LineSlamParams slam;     ///< its `extractor` is the section `lines`
  nav::OccupancyParams occupancy;
  GotoParams go;
  std::optional<api::RecogniserKind> recogniser;  ///< of all targets with a picture; nothing: as each target says
  SearchBehaviourParams search;                   ///< its `strategy` is the field `planner`
  search::ControlTableParams control_table;
  explore::ExploreParams explore;
  fleet::TopologicalParams topology;
  StereoSettings stereo;
  server_net::ServerParams server;
  std::vector<std::filesystem::path> folders;  ///< of the robot file, then of its bases; not a field
};

void describe(config::Fields& f, RobotOptions& options);

/// Names as in the field `recogniser` of a robot file.
[[nodiscard]] const config::Choices<std::optional<api::RecogniserKind>>& recogniser_names();
/// Names as in the field `planner` of a robot file: what plans a search. Nothing: as the mission says.
[[nodiscard]] const config::Choices<std::optional<search::Strategy>>& planner_names();

/// The name of one of these choices.
template <class E>
[[nodiscard]] std::string name_of(const config::Choices<E>& choices, const E& value) {
  for (const auto& [name, choice] : choices) {
    if (choice == value) {
      return std::string(name);
    }
  }
  return "unknown";
}

/// Checks what spans several fields. Errors name the section that is wrong.
[[nodiscard]] Status validate(const RobotOptions& options);

/// Robot files that may lie on top of one another by `base`.
inline constexpr int kMaxRobotFiles = 8;

/// A robot file's text; `name` is what messages call it. Opens no file, so that the text cannot have a `base`.
[[nodiscard]] Result<RobotOptions> parse_robot_options(std::string_view text, const std::string& name,
                                                       const std::vector<std::string>& overrides = {});

/// Reads a robot file over its `base`, which is named relative to the file's folder: what a file does not say is as its
/// base says, and only then as the defaults. `overrides` are "key.path=value". Errors name the file and line.
[[nodiscard]] Result<RobotOptions> load_robot_options(const std::filesystem::path& file,
                                                      const std::vector<std::string>& overrides = {});

/// A path written in a robot file: absolute, relative to the folder of the file or of a base of it (the first where it
/// is there), or relative to the working directory.
[[nodiscard]] std::filesystem::path resolve(const RobotOptions& options, const std::string& path);

/// The model of solids that `search.solids.model` names; null when it names none. Errors of load_solid_model().
[[nodiscard]] Result<std::shared_ptr<const vision::SolidModel>> load_solids(const RobotOptions& options);

}  // namespace seeker::app
