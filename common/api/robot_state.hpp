/// \file
/// State of a robot as values.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/api/component.hpp"
#include "common/api/map.hpp"
#include "common/api/mission.hpp"
#include "common/core/occupancy_tile.hpp"
#include "common/core/pose_estimate.hpp"
#include "common/core/scan.hpp"
#include "common/core/tick_timing.hpp"

namespace seeker::api {

inline constexpr std::uint32_t kProtocolMajor = 1;
inline constexpr std::uint32_t kProtocolMinor = 7;

/// Identity and capabilities of a robot, as sent in the answer to hello.
struct RobotInfo {
  std::string robot_id;  ///< as in validate_robot_id()
  std::string software_version;
  std::uint32_t protocol_major = kProtocolMajor;
  std::uint32_t protocol_minor = kProtocolMinor;
  std::vector<std::string> capabilities;  ///< "search", "goto", "lidar", "camera:omni", ...
  double robot_radius_m = 0.0;
  bool realtime = true;  ///< false in lockstep at another speed than 1

  friend bool operator==(const RobotInfo&, const RobotInfo&) = default;
};

/// 1 to 64 letters, digits, '-', '_' and '.', which is not the first: the id also names folders and files.
[[nodiscard]] Status validate_robot_id(std::string_view robot_id);

enum class Severity : std::uint8_t { kInfo, kWarning, kError, kCritical };
[[nodiscard]] std::string_view to_string(Severity severity);

/// A fault that is present now; it ends when its cause does.
struct Fault {
  std::string id;  ///< stable, e.g. "sonar-silent"
  std::string component;
  Severity severity = Severity::kError;
  RobotTime onset;
  std::string message;
  std::string remedy;

  friend bool operator==(const Fault&, const Fault&) = default;
};

/// State of the lease, the right to command motion.
struct LeaseState {
  std::string owner;           ///< name of the client that holds it; empty: no client
  std::uint64_t epoch = 0;     ///< rises with every change of owner, with a stop and when the lease becomes stale
  std::string requested_by;    ///< name of the client that asks the owner for the lease; empty: no client
  bool stale = false;          ///< the owner is silent: others may acquire the lease, the owner refresh it
  std::uint64_t sequence = 0;  ///< highest number of the commands that were taken under this epoch
  Duration request_left{};     ///< wall time in which the owner may answer the request; zero without one

  friend bool operator==(const LeaseState&, const LeaseState&) = default;
};

enum class LeaseAction : std::uint8_t { kAcquire, kRequest, kGrant, kDeny, kTakeOver, kRelease };

/// What a client wants of the lease.
struct LeaseCommand {
  LeaseAction action = LeaseAction::kAcquire;
  bool intended =
      false;  ///< a person knows of the owner and wants the lease; without it only an admin may take it over

  friend bool operator==(const LeaseCommand&, const LeaseCommand&) = default;
};

/// A mission that was running when the robot program ended, and that can be resumed.
struct CutOffMission {
  MissionId id;
  std::string kind;  ///< kind of its task, as in MissionStatus

  friend bool operator==(const CutOffMission&, const CutOffMission&) = default;
};

struct RobotStatus {
  RobotTime stamp;
  PoseEstimate pose;
  Pose2 odom_T_base;
  Twist2 velocity;
  std::optional<double> battery_v;  ///< voltage of the battery; absent where the base does not report it
  bool estop = false;               ///< true: the emergency stop is latched
  bool motors_armed = false;
  LeaseState lease;
  std::optional<MissionStatus> mission;  ///< the running or paused mission, or the last one
  std::vector<Fault> faults;
  std::string safety;                           ///< why the last command was clamped or refused; empty when it was not
  double clock_speed = 1.0;                     ///< requested robot seconds per wall second; 0: as fast as possible
  std::optional<TickTiming> timing;             ///< lateness of the loop; absent where no wall clock paces it
  std::uint64_t map_revision = 0;               ///< revision of the occupancy map
  std::optional<LineMapStatus> line_map;        ///< absent where the estimator keeps no map of segments
  std::optional<CutOffMission> cut_off;         ///< until it is resumed or another mission is started
  std::optional<LinkCountdown> link_countdown;  ///< while the client that started the running mission is silent

  friend bool operator==(const RobotStatus&, const RobotStatus&) = default;
};

/// The estimated pose of the robot at one time.
struct StampedPose {
  RobotTime stamp;
  Pose2 map_T_base;

  friend bool operator==(const StampedPose&, const StampedPose&) = default;
};

/// A log entry of a mission or of the robot. Mission events are stamped from the mission's start.
struct Event {
  std::uint64_t sequence = 0;
  RobotTime stamp;
  std::optional<Duration> mission_time;
  MissionId mission;  ///< empty: not part of a mission
  Severity severity = Severity::kInfo;
  std::string kind;  ///< stable word, e.g. "cell-searched", "target-found", "link-lost"
  std::string text;

  friend bool operator==(const Event&, const Event&) = default;
};

struct ImageFrame {
  std::string camera;
  CameraFrame frame;
  Pose2 map_T_base;

  friend bool operator==(const ImageFrame&, const ImageFrame&) = default;
};

/// A velocity that is valid for `ttl`; the robot stops when no newer command arrives in that time.
struct DriveCommand {
  Twist2 velocity;
  Duration ttl = std::chrono::milliseconds(300);
  std::uint64_t lease_epoch = 0;
  std::uint64_t sequence = 0;          ///< numbers the commands of one epoch from 1; 0: not numbered
  std::optional<RobotTime> sent = {};  ///< when it was given, from where the ttl counts; nothing: when it arrives

  friend bool operator==(const DriveCommand&, const DriveCommand&) = default;
};
/// Largest DriveCommand::ttl, so that a robot without a link stops soon.
inline constexpr Duration kMaxDriveTtl = std::chrono::seconds(1);

/// How far a command may come from the future: an error of the comparison of clocks.
inline constexpr Duration kMaxDriveClockError = std::chrono::milliseconds(250);

/// Tiles that have changed since a revision.
struct TileUpdate {
  std::uint64_t revision = 0;  ///< of the whole map; the next request names it
  std::uint32_t map_epoch = 0;
  std::vector<OccupancyTile> tiles;

  friend bool operator==(const TileUpdate&, const TileUpdate&) = default;
};

}  // namespace seeker::api
