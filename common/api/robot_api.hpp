/// \file
/// The interface of a robot, in plain values. The robot itself implements it (server/app), and so does the remote
/// client (common/rpc). Handlers, the command line and experiments use no other interface.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/api/audit.hpp"
#include "common/api/component.hpp"
#include "common/api/diagnosis.hpp"
#include "common/api/landmarks.hpp"
#include "common/api/map.hpp"
#include "common/api/mission.hpp"
#include "common/api/perception.hpp"
#include "common/api/robot_state.hpp"
#include "common/api/scan_lines.hpp"
#include "common/api/transfer.hpp"
#include "common/core/result.hpp"
#include "common/core/topology.hpp"

namespace seeker::api {

/// Receives the result of a call. It is called exactly once, on a thread that the implementation chooses, and must not
/// block.
template <class T>
using Reply = std::function<void(Result<T>)>;

/// Streams that a client can subscribe to.
enum class Topic : std::uint8_t {
  kStatus,     ///< RobotStatus                      LATEST
  kScan,       ///< LaserScan                        LATEST
  kSonar,      ///< SonarScan                        LATEST
  kTiles,      ///< TileUpdate                       LATEST per tile: the newest revision of each
  kGrid,       ///< GridReport                       LATEST
  kImage,      ///< ImageFrame                       LATEST
  kMission,    ///< MissionStatus                    RELIABLE
  kEvent,      ///< Event                            RELIABLE
  kDetection,  ///< Detection (new, refined, gone)   RELIABLE
  kSegments,   ///< SegmentUpdate                    RELIABLE
  kLines,      ///< LineReport                       LATEST
  kTopology,   ///< RobotTopology                    LATEST
};
inline constexpr std::size_t kTopicCount = 12;

/// LATEST: a slow receiver gets the newest item and the number of items it missed. RELIABLE: the items are numbered,
/// complete, and resumable after a reconnect.
enum class StreamClass : std::uint8_t { kLatest, kReliable };
[[nodiscard]] StreamClass stream_class(Topic topic);
[[nodiscard]] std::string_view to_string(Topic topic);

using Payload = std::variant<RobotStatus, LaserScan, SonarScan, TileUpdate, GridReport, ImageFrame, MissionStatus,
                             Event, Detection, SegmentUpdate, LineReport, RobotTopology>;

/// One item of a stream. Immutable and shared between all who receive it.
struct Update {
  Topic topic = Topic::kStatus;
  std::uint64_t sequence = 0;  ///< per topic, from 1, without gaps at the source
  std::uint64_t dropped = 0;   ///< items left out for this receiver since the one before (LATEST only)
  RobotTime stamp;
  Payload payload;
};
using UpdatePtr = std::shared_ptr<const Update>;
/// Receives the updates of a subscription, in order per topic, on a thread that the implementation chooses; it must not
/// block.
using UpdateSink = std::function<void(const UpdatePtr&)>;

struct TopicRequest {
  Topic topic = Topic::kStatus;
  double max_rate_hz =
      0.0;  ///< LATEST: updates per second of wall time; 0: every update. A robot in process ignores it.
  std::uint64_t resume_after = 0;  ///< RELIABLE: sequence after which delivery starts; 0: from now on
  friend bool operator==(const TopicRequest&, const TopicRequest&) = default;
};

/// Ends the subscription when destroyed; the sink is not called afterwards.
class Subscription {
 public:
  Subscription() = default;
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;
  virtual ~Subscription() = default;
};

/// A robot as one client sees it. All calls return at once; the result comes through the reply.
class RobotApi {
 public:
  RobotApi() = default;
  RobotApi(const RobotApi&) = delete;
  RobotApi& operator=(const RobotApi&) = delete;
  virtual ~RobotApi() = default;

  virtual void get_info(Reply<RobotInfo> reply) = 0;
  virtual void get_status(Reply<RobotStatus> reply) = 0;
  virtual void list_components(Reply<std::vector<ComponentInfo>> reply) = 0;
  virtual void restart_component(const std::string& name, Reply<void> reply) = 0;
  /// Activates or deactivates a component. One that is not active holds the robot still by a fault. kNotFound lists the
  /// names there are.
  virtual void switch_component(const std::string& name, bool active, Reply<void> reply) = 0;
  /// Puts another type of an estimator, recogniser or planner in place of the present one. kBusy: a mission runs;
  /// kRefused: the component cannot be exchanged, or the robot moves. All stays as it was after an error. Where an
  /// estimator is exchanged a new map begins.
  virtual void exchange_component(const std::string& name, const std::string& type, Reply<void> reply) = 0;
  /// The configuration set of a component as it is in use.
  virtual void get_settings(const std::string& component, Reply<std::vector<ComponentSetting>> reply) = 0;
  /// Changes settings, each given as "key=value", all or none; answers with the changed ones. kInvalidArgument names
  /// the path in the robot file of a value that is wrong; kRefused: the change needs a restart.
  virtual void set_settings(const std::string& component, const std::vector<std::string>& assignments,
                            Reply<std::vector<ComponentSetting>> reply) = 0;

  /// Answers at once; progress comes as Topic::kMission. Repeating a request with the id of the mission that runs
  /// is accepted and changes nothing; another one while one runs is kBusy.
  virtual void start_mission(const MissionRequest& request, Reply<MissionAccepted> reply) = 0;
  virtual void command_mission(MissionCommand command, Reply<void> reply) = 0;
  /// The running mission or the last one.
  virtual void get_mission(Reply<MissionStatus> reply) = 0;

  /// Ends mission and motion. Needs no lease.
  virtual void stop(Reply<void> reply) = 0;
  /// Latches until released on purpose, also over a restart of the robot's program: the reply comes when that is on the
  /// disk. Needs no lease.
  virtual void set_estop(bool engaged, Reply<void> reply) = 0;
  /// kRefused names the owner of the lease and the remedy.
  virtual void command_lease(const LeaseCommand& command, Reply<LeaseState> reply) = 0;
  virtual void drive(const DriveCommand& command, Reply<void> reply) = 0;

  /// Tiles changed since `revision` (0: all of them).
  virtual void get_tiles(std::uint64_t since_revision, Reply<TileUpdate> reply) = 0;
  virtual void get_grid(Reply<GridReport> reply) = 0;
  /// Detections in the present map, by rising id: those of the running or last mission, and the newest of those before
  /// it.
  virtual void get_detections(Reply<std::vector<Detection>> reply) = 0;
  /// Poses of the robot since it was started or a map was loaded, thinned, in the frame `map` as it was then: a loop
  /// closure moves later poses only.
  virtual void get_trajectory(Reply<std::vector<StampedPose>> reply) = 0;
  virtual void grab_image(const std::string& camera, Reply<ImageFrame> reply) = 0;

  // The map of segments. Every one of these is kNotReady where the estimator keeps no such map, or where there is no
  // folder to keep maps in.

  /// Segments changed since `revision`; all of them, marked as full, for 0 and for a revision that is too old.
  virtual void get_segments(std::uint64_t since_revision, Reply<SegmentUpdate> reply) = 0;
  /// Keeps the present map under a name. kRefused: there is another map of that name and `replace` is false, or it is
  /// the one the robot localises in.
  virtual void save_map(const std::string& name, bool replace, Reply<MapSummary> reply) = 0;
  /// Replaces the present map; the robot then relocalises in it. kRefused: the robot moves; kBusy: a mission
  /// runs; kNotFound, kCorrupt, kUnsupportedVersion: the file is absent, damaged or too new.
  virtual void load_map(const std::string& name, MapUse use, Reply<MapSummary> reply) = 0;
  /// All map files, by name; a damaged one has its `problem` set.
  virtual void list_maps(Reply<std::vector<MapSummary>> reply) = 0;
  /// Summary of one map; with `verify` the whole file is read and checked.
  virtual void inspect_map(const std::string& name, bool verify, Reply<MapSummary> reply) = 0;
  virtual void delete_map(const std::string& name, Reply<void> reply) = 0;
  /// The bytes of a map file. kTooLarge above kMaxMapTransferBytes.
  virtual void download_map(const std::string& name, Reply<std::vector<std::uint8_t>> reply) = 0;
  virtual void upload_map(const MapUpload& upload, Reply<MapSummary> reply) = 0;
  /// Starts relocalisation near a pose, or in the whole map, and answers at once. RobotStatus::pose has quality
  /// kUnknown meanwhile, then kLocalised, or kLost with the cause. kRefused: the robot moves; kBusy: a mission runs.
  virtual void relocalise(const std::optional<Pose2>& map_T_base, Reply<void> reply) = 0;

  // Databases of landmarks, which `survey` builds and `localise` reads. kNotReady: there is no folder to keep them in.

  /// All databases of landmarks, by name; a damaged one has its `problem` set.
  virtual void list_landmarks(Reply<std::vector<LandmarkSummary>> reply) = 0;
  /// Summary of one database; with `verify` the whole file is read and checked.
  virtual void inspect_landmarks(const std::string& name, bool verify, Reply<LandmarkSummary> reply) = 0;
  /// All landmarks of a database, by rising id.
  virtual void get_landmarks(const std::string& name, Reply<std::vector<LandmarkPoint>> reply) = 0;
  /// Deletes the landmarks that fewer pictures than `min_views` have shown. kRefused: no landmark would be left, or the
  /// robot localises by this database.
  virtual void prune_landmarks(const std::string& name, int min_views, Reply<LandmarkSummary> reply) = 0;
  /// Takes back the last change of a database: an update, or a pruning. kNotReady: there is no version before the
  /// present one; kRefused: the robot localises by this database.
  virtual void revert_landmarks(const std::string& name, Reply<LandmarkSummary> reply) = 0;
  virtual void delete_landmarks(const std::string& name, Reply<void> reply) = 0;

  // Files of any size, in pieces. kNotReady: there is no folder to keep them in.

  /// Answers with the number of bytes, from the first one on, that the robot has of a file already; send on from there.
  /// Harmless when repeated. kTooLarge; kIo: the disk is full.
  virtual void begin_upload(const FileOffer& offer, Reply<std::uint64_t> reply) = 0;
  /// Adds bytes of a file that was begun, and answers as begin_upload() does; what the robot has already is left out.
  /// kNotFound: it was not begun, or was deleted to make room for others; kRefused: bytes before the piece are missing;
  /// kInvalidArgument: it ends beyond the file; kCorrupt: with it the file has another hash, and was deleted; kIo: the
  /// disk is full, what was sent before stays.
  virtual void upload_piece(const UploadPiece& piece, Reply<std::uint64_t> reply) = 0;
  /// Keeps a file that has arrived under its name, whole or not at all, after the checks of upload_map(), or only
  /// checks it. Harmless when repeated. kNotFound: it is not here as a whole.
  virtual void finish_upload(const UploadEnd& end, Reply<UploadedFile> reply) = 0;
  /// Some bytes of a map or a database. kRefused: the file has another hash than the one named; begin again.
  virtual void read_file(const FileRead& wish, Reply<FilePiece> reply) = 0;

  /// What the robot finds out about its machine: disk, memory, clock, journal, certificates. kNotReady: this robot does
  /// not check it.
  virtual void get_diagnosis(Reply<std::vector<Finding>> reply) = 0;
  /// The newest records of who commanded what, in the order in which they were kept. kNotReady: this robot keeps none.
  virtual void get_audit(const AuditQuery& query, Reply<std::vector<AuditRecord>> reply) = 0;

  [[nodiscard]] virtual Result<std::unique_ptr<Subscription>> subscribe(const std::vector<TopicRequest>& topics,
                                                                        UpdateSink sink) = 0;
};

enum class Role : std::uint8_t { kObserver, kOperator, kAdmin };
/// "observer", "operator" or "admin".
[[nodiscard]] std::string_view to_string(Role role);

/// The client on the other end of a session.
struct Caller {
  std::string client_name;  ///< program and instance, stable over reconnects
  Role role = Role::kOperator;
  friend bool operator==(const Caller&, const Caller&) = default;
};

/// The robot as the network server sees it: opens one RobotApi per client and is notified when a client is lost.
class RobotHost {
 public:
  RobotHost() = default;
  RobotHost(const RobotHost&) = delete;
  RobotHost& operator=(const RobotHost&) = delete;
  virtual ~RobotHost() = default;

  [[nodiscard]] virtual std::shared_ptr<RobotApi> open(const Caller& caller) = 0;
  /// Nothing has been received from the client for `silence` of wall time, more than it needs between two signs of
  /// life; returned() or open() with the same name undoes it. By default nothing is done.
  virtual void silent(const Caller& /*caller*/, Duration /*silence*/) {}
  /// A silent client has sent something again.
  virtual void returned(const Caller& /*caller*/) {}
  /// The client has ended its session on purpose.
  virtual void closed(const Caller& caller) = 0;
  /// The client is silent or its connection broke; link policies apply. A later open() with the same name undoes it.
  virtual void lost(const Caller& caller, const std::string& why) = 0;
  /// A client has commanded something, or was refused. To be kept; must return at once. By default nothing is done.
  virtual void commanded(const AuditRecord& /*record*/) {}
};

}  // namespace seeker::api
