/// \file
/// The one loop that owns the robot's state: sense, estimate, decide, act, publish (design section 3). Everything here
/// runs on one thread; others reach it through a Mailbox.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"
#include "server/app/estimators/estimator.hpp"
#include "server/app/estimators/odometry_history.hpp"
#include "server/app/maps/robot_map.hpp"
#include "server/app/missions/mission_executor.hpp"
#include "server/app/runtime/background.hpp"
#include "server/app/runtime/components.hpp"
#include "server/app/runtime/devices.hpp"
#include "server/app/runtime/faults.hpp"
#include "server/app/runtime/update_hub.hpp"
#include "server/app/safety/motion_authority.hpp"
#include "server/app/safety/safety_supervisor.hpp"
#include "server/app/state/checkpoint.hpp"
#include "server/nav/occupancy_map.hpp"
#include "server/nav/seen_movers.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::app {

/// What is assumed of other robots of the fleet that drive about.
struct FleetMotionParams {
  double robot_radius_m = 0.26;
  double slack_m = 0.15;                       ///< how far off a told place may be: of both poses and of both maps
  double slack_m_s = 0.5;                      ///< more for each second since it was told
  Duration max_age = std::chrono::seconds(2);  ///< what is older says nothing any more
};

struct LoopParams {
  Duration period = std::chrono::milliseconds(100);
  Duration base_timeout = std::chrono::milliseconds(500);  ///< silence that is a fault, robot time
  Duration lidar_timeout = std::chrono::seconds(1);
  Duration sonar_timeout = std::chrono::seconds(1);
  Duration tile_period = std::chrono::milliseconds(500);  ///< between publications of changed tiles, robot time
  Duration grid_period = std::chrono::seconds(2);         ///< between publications of lists and evidence
  double trajectory_spacing_m = 0.1;
  std::size_t max_trajectory = 100'000;  ///< poses; the oldest half is thinned out beyond it
  SafetyParams safety;
  MissionParams mission;
  RobotMapParams map;
  FleetMotionParams fleet;
};

/// How the loop is put together.
struct LoopParts {
  Devices devices;
  std::unique_ptr<Estimator> estimator;
  std::shared_ptr<const vision::StereoExtractor> stereo;  ///< what looks at stereo pictures; null: nobody wants them
  std::string estimator_type;
  BehaviourFactory behaviours;
  nav::OccupancyParams occupancy;
  std::function<void()> forget_places;  ///< what missions remember of the map is void: another one was loaded
};

class RobotLoop {
 public:
  RobotLoop(const LoopParams& params, LoopParts parts, UpdateHub& hub);
  ~RobotLoop();
  RobotLoop(const RobotLoop&) = delete;
  RobotLoop& operator=(const RobotLoop&) = delete;

  /// Starts the components and takes the first readings. Faults are reported, not returned: the loop always runs.
  void start();
  /// One pass, at the end of which robot time has advanced by one period.
  void tick(WallTime wall_now);
  /// Waits at most `limit` of wall time for the end of the tick in a world that others are in too. False: not yet. A
  /// world that cannot be reached is a fault at once, and the end of a mission when it lasts.
  [[nodiscard]] bool await(Duration limit, WallTime wall_now);
  /// See drivers::Clock: a shared world waits for this robot, or goes on without it.
  void hold_world() { parts_.devices.clock->hold(); }
  void let_world_go() { parts_.devices.clock->let_go(); }
  /// True when nothing would change by ticking: a simulated world stands still while no mission runs.
  [[nodiscard]] bool idle() const;
  /// The source of a replay has been read to its end.
  [[nodiscard]] bool ended() const { return ended_; }
  /// Publishes what subscribers need while the world stands still.
  void publish_idle();
  /// Halts the base and stops the components.
  void shut_down();

  [[nodiscard]] RobotTime now() const { return parts_.devices.clock->now(); }
  [[nodiscard]] bool realtime() const;
  [[nodiscard]] api::RobotStatus status() const;
  [[nodiscard]] const nav::OccupancyMap& map() const { return map_.occupancy(); }
  [[nodiscard]] const RobotMap& robot_map() const { return map_; }
  [[nodiscard]] const std::vector<api::StampedPose>& stamped_trajectory() const { return trajectory_; }
  [[nodiscard]] std::vector<Pose2> trajectory() const;
  [[nodiscard]] Components& components() { return components_; }
  [[nodiscard]] const MissionExecutor& missions() const { return missions_; }
  [[nodiscard]] MissionExecutor& missions() { return missions_; }
  [[nodiscard]] std::vector<std::string> capabilities() const;

  // Commands of clients.
  [[nodiscard]] Result<api::MissionId> start_mission(const api::MissionRequest& request, const std::string& client);
  /// `client` becomes the owner of a mission that it has go on after a crash.
  [[nodiscard]] Status command_mission(api::MissionCommand command, const std::string& client);
  void stop();
  void set_estop(bool engaged);
  [[nodiscard]] Result<api::LeaseState> command_lease(const std::string& client, api::LeaseAction action);
  [[nodiscard]] Status drive(const std::string& client, const api::DriveCommand& command);
  [[nodiscard]] Status restart_component(const std::string& name);
  [[nodiscard]] Result<api::ImageFrame> grab_image(const std::string& camera);
  /// The present map, to be saved under a name (robot_map_commands.cpp).
  [[nodiscard]] Result<LoopMap> map_to_save(const std::string& name) const;
  /// kRefused when the robot localises in the map of this name: its file stays as it is.
  [[nodiscard]] Status map_not_in_use(const std::string& name) const;
  void map_saved(const MapIdentity& identity);
  [[nodiscard]] Status load_map(const LineMap& map, const MapIdentity& identity);
  [[nodiscard]] Status relocalise(const std::optional<Pose2>& map_T_base);

  // Checkpoints (robot_checkpoint.cpp): a mission that builds the map keeps it on disk, for its resumption after a
  // crash.
  /// The cut-off mission whose map may be there; nothing when there is none to resume or it needs no map.
  [[nodiscard]] std::optional<api::MissionId> checkpoint_to_resume() const;
  /// Loads the map of the cut-off mission and looks for the robot's place in it, first where it was last; then the
  /// mission goes on. Where there is no map to load, or the robot is not found in it, a new map is begun.
  [[nodiscard]] Status resume_in_map(const Result<LineMap>& map, const MapIdentity& identity, const std::string& client,
                                     KeptState kept = {});
  /// The present map is not the robot's own yet: the one that its mission was building waits for `resume`.
  [[nodiscard]] bool map_waits_for_resume() const;
  /// The answer to on_checkpoint.
  void checkpoint_written(const Status& written);
  /// The answer to on_place. A place that was not kept is no loss: the next one follows soon.
  void place_written() { place_waits_ = false; }
  void client_lost(const std::string& client, const std::string& why, WallTime wall_now);
  void client_back(const std::string& client);
  /// The client left on purpose: its lease is free, its mission goes on.
  void client_closed(const std::string& client);
  /// The mission that a crash cut off: `resume` starts it again while no other has been started.
  void offer_unfinished(std::optional<api::MissionRequest> request) { unfinished_ = std::move(request); }
  /// What the robot knows of its fleet from now on, frame `map`; nothing: it is alone.
  void set_fleet(std::optional<FleetView> fleet);
  /// What it tells its fleet of its newest exploration by topology, frame `map`; inactive after that has ended. Its id
  /// is the teller's.
  [[nodiscard]] const RobotTopology& own_topology() const { return own_topology_; }
  /// An event outside of missions; also from outside the loop's own parts (the fleet).
  void log(const std::string& kind, const std::string& text, api::Severity severity = api::Severity::kInfo);
  /// A fault from outside the loop's own parts (the journal).
  void report_fault(const api::Fault& fault);
  /// Everything a new subscriber needs is published in the next pass.
  void republish() { republish_ = true; }

  /// Called with every event, before it is published (journal, tests).
  std::function<void(const api::Event&)> on_event;
  std::function<void(const api::MissionRequest&)> on_mission_started;
  std::function<void(const api::MissionStatus&)> on_mission;
  std::function<void(const api::Detection&)> on_detection;
  /// Keeps the map of a mission that is building it; answer with checkpoint_written().
  std::function<void(const api::MissionId&, Checkpoint)> on_checkpoint;
  /// Keeps where the robot is in that map; answer with place_written().
  std::function<void(const api::MissionId&, const MissionPlace&)> on_place;
  /// The robot was not found in the map that is kept for a mission, which goes on without it.
  std::function<void(const api::MissionId&)> on_checkpoint_unused;
  /// No mission needs its checkpoint any more.
  std::function<void()> on_checkpoints_void;

 private:
  void register_components();
  void sense();
  template <class Driver, class Sample>
  void read(Driver* driver, const std::string& name, Duration timeout, std::optional<Sample>& latest, bool& fresh,
            RobotTime& last);
  void estimate();
  /// Sweep and odometry, as far as they are fresh, in the order of their stamps: a sweep arrives later than it was
  /// taken. Returns the sweep as the estimator got it; null when there is none.
  const LaserScan* tell_estimator();
  void note_reading(const Status& status, const char* id);
  void end_source(const Error& error);
  // What commands can reach (robot_reach.cpp).
  /// False, a fault and drivers in ERROR while the world of the devices cannot be reached.
  bool world_there();
  void watch_world(WallTime wall_now);
  /// Why the robot can do nothing now.
  [[nodiscard]] Status within_reach() const;
  /// Why it cannot do this mission, wherever it is.
  [[nodiscard]] Status able_to(const api::MissionTask& task) const;
  void base_refused(const Error& error);
  /// The base counts its way anew from here: odometry goes on from where it was.
  void continue_odometry(drivers::OdometrySample& sample);
  [[nodiscard]] Twist2 decide(WallTime wall_now);
  // The fleet (robot_fleet.cpp).
  void note_topology();
  void move_fleet(const Pose2& new_T_old);
  /// Other robots of the fleet, frame `map`; none that has not been heard of lately.
  [[nodiscard]] std::vector<nav::Mover> movers() const;
  /// Those, and whatever the laser sees driving about; frame `base` of the robot at that place.
  [[nodiscard]] std::vector<nav::Mover> movers_base(const Pose2& map_T_base) const;
  /// The newest scan without beams that end at other robots: for pose and maps. What stops the robot sees all of it.
  [[nodiscard]] const LaserScan& scan_of_building();
  /// Takes a picture and has the mission's recogniser look at it.
  void look();
  // Looking with both eyes (robot_stereo.cpp).
  void look_with_both();
  void take_look();
  /// To the estimator, and to the mission where it asked.
  void give_look(const Result<StereoLook>& look);
  void place_at(const PoseEstimate& place);
  /// Hands a finished recognition to the mission, or reports why there is none.
  void take_recognition();
  void act(const Twist2& wanted);
  void keep_checkpoint();
  void keep_place(const api::MissionId& mission);
  void drop_checkpoints();
  void resume_when_found();
  [[nodiscard]] MissionPlace mission_place() const;
  [[nodiscard]] Twist2 look_round();
  void begin_map_anew();
  void forget_places();
  void publish();
  void publish_tiles(RobotTime stamp);
  void publish_segments(RobotTime stamp);
  /// Takes the estimate; where the map has moved, everything that holds places follows. `old_map_T_base` is where the
  /// robot would be now in the map before.
  void follow_map(const std::optional<Pose2>& old_map_T_base);
  [[nodiscard]] Status may_change_map() const;
  [[nodiscard]] bool moving() const;
  void remember_pose();
  [[nodiscard]] Situation situation() const;
  void raise(const std::string& id, const std::string& component, const std::string& message, const std::string& remedy,
             api::Severity severity = api::Severity::kError);
  void clear(const std::string& id);
  void emit(const api::Event& event);

  LoopParams params_;
  LoopParts parts_;
  UpdateHub& hub_;
  Components components_;
  FaultList faults_;
  MotionAuthority authority_;
  MissionExecutor missions_;
  Background<Recognition> recognition_;
  Background<StereoLook> looks_;
  bool look_for_mission_ = false;  ///< a mission waits for the answer to a look
  RobotMap map_;

  std::optional<drivers::OdometrySample> odometry_;
  OdometryHistory odometry_history_;
  std::optional<Pose2> odom_T_restart_;  ///< where the base was restarted, until it has told of itself again,
  std::optional<Pose2> odom_T_counted_;  ///< and the frame in which it has counted since then
  RobotTime told_odometry_;              ///< stamp of the last that the estimator got
  std::optional<LaserScan> scan_;
  std::optional<SonarScan> sonar_;
  bool fresh_odometry_ = false;
  bool fresh_scan_ = false;
  bool fresh_sonar_ = false;
  RobotTime last_odometry_;
  RobotTime last_scan_;
  RobotTime last_sonar_;

  PoseEstimate pose_;
  std::optional<Pose2> odom_T_base_at_pose_;
  std::optional<FleetView> fleet_;
  RobotTime fleet_at_;  ///< when it was told
  LaserScan building_;  ///< see scan_of_building()
  nav::SeenMovers seen_movers_;
  RobotTopology own_topology_;  ///< set in every tick
  Twist2 command_;
  std::string safety_reason_;
  bool motors_on_ = false;
  bool ended_ = false;
  std::optional<WallTime> world_lost_at_;  ///< since when it cannot be reached
  bool republish_ = false;
  std::optional<api::MissionRequest> unfinished_;
  bool resuming_ = false;  ///< unfinished_ goes on when the robot has found its place in its map
  RobotTime resuming_at_;
  std::string resuming_client_;
  std::optional<double> looked_at_rad_;  ///< heading by odometry while it turns to look round,
  double looked_round_rad_ = 0.0;        ///< and how far it has turned
  bool has_own_map_ = false;             ///< of unfinished_: it is loaded
  bool checkpoint_kept_ = false;         ///< there may be one on disk
  bool checkpoint_waits_ = false;        ///< one is being written
  std::optional<std::uint64_t> checkpoint_revision_;
  RobotTime checkpoint_at_;
  std::optional<Pose2> checkpoint_map_T_base_;  ///< where the robot was then
  bool place_waits_ = false;                    ///< one is being written
  RobotTime place_at_;
  KeptState kept_;  ///< of unfinished_, in its map; until it goes on
  std::vector<api::StampedPose> trajectory_;
  std::uint64_t event_sequence_ = 0;
  std::uint64_t published_revision_ = 0;
  std::uint64_t published_segments_ = 0;
  RobotTime tiles_at_;
  RobotTime grid_at_;
};

}  // namespace seeker::app
