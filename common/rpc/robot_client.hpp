/// \file
/// A robot over the network: RobotApi over one connection, which is made again when it breaks.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/api/robot_api.hpp"
#include "common/pki/bundle.hpp"
#include "common/rpc/endpoint.hpp"

namespace seeker::rpc {

/// State of the link as the client sees it.
enum class LinkState : std::uint8_t {
  kConnected,  ///< hello was exchanged; calls and streams work
  kStale,      ///< no frame was received for longer than a heartbeat: shown values may be old
  kLost,       ///< the connection broke or is silent; the client tries again if allowed to
  kClosed,     ///< for good: closed by this client, refused by the robot, or out of attempts
};
[[nodiscard]] std::string_view to_string(LinkState state);

/// A change of the link, reported on the client's thread.
struct LinkEvent {
  LinkState state = LinkState::kConnected;
  std::string why;               ///< cause and remedy for people; empty when connected for the first time
  bool robot_restarted = false;  ///< connected again, to another run of the robot: its streams count from 1 again
};

struct ReconnectParams {
  bool enabled = true;
  /// Wall time between attempts, and from the hello of a connection to the next attempt: one that has lasted so long is
  /// made again at once.
  Duration first_delay = std::chrono::milliseconds(100);
  Duration max_delay = std::chrono::seconds(5);  ///< the delay doubles up to this
};

/// All times are wall time.
struct ClientParams {
  std::string client_name = "seeker";  ///< program and instance, stable over reconnects; printable ASCII, no spaces
  /// Files with which to speak TLS, read for each connection; nothing: plain TCP. The client's name becomes
  /// "NAME/client_name" then, NAME being that of the certificate.
  std::optional<pki::BundleFiles> tls;
  std::string robot_id;                                ///< refuse any other robot; empty: any
  api::Role role = api::Role::kOperator;               ///< asked for; see RobotClient::role()
  Duration connect_timeout = std::chrono::seconds(3);  ///< for address look-up, connection and hello together
  Duration call_timeout = std::chrono::seconds(5);
  Duration heartbeat = std::chrono::seconds(1);  ///< send at least this often; stale after 1.5, lost after 3 of them
  ReconnectParams reconnect;
  /// Connections beside the first that carry nothing but copies of stop() and of engaging the emergency stop, of which
  /// the first to arrive counts: a lost packet holds back a copy, not the stop. At most 8; none to a robot that speaks
  /// less than 1.7.
  int stop_links = 0;
  std::function<void(const LinkEvent&)> on_link;  ///< on the client's thread; must not block
};

/// Estimate of the offset between the robot's and this machine's clock, from the exchange with the shortest round trip.
struct TimeSync {
  Duration robot_minus_local = Duration::zero();  ///< robot time = local steady clock + this
  Duration round_trip = Duration::zero();
  bool realtime = true;  ///< false: robot time does not run with the wall clock, and the offset has no meaning
  /// Wall clock of the robot minus that of this machine, known to half the round trip; nothing: the robot speaks less
  /// than 1.6.
  std::optional<Duration> robot_wall_minus_local = std::nullopt;
};

/// RobotApi over TCP or TLS. Calls may come from any thread; replies, sinks and link events are called on the client's
/// own thread and must not block or wait for another call. A call ends with kTimeout when no answer came in time and
/// with kLinkLost when the connection broke while it was open (it may or may not have been carried out).
///
/// Subscriptions survive a reconnect: RELIABLE topics resume after the last item that was delivered, so that nothing
/// is lost or delivered twice; where the robot no longer keeps the items, Update::dropped is the number of missing
/// ones.
class RobotClient final : public api::RobotApi {
 public:
  /// Connects and exchanges hello; waits at most `connect_timeout`. Errors: kLinkLost (nobody answers there),
  /// kTimeout, kUnsupportedVersion, kRefused (also: one side does not believe the other's certificate), kBusy,
  /// kNotFound (another robot), kInvalidArgument (name), those of the files of `tls`.
  [[nodiscard]] static Result<std::shared_ptr<RobotClient>> connect(const Endpoint& endpoint, ClientParams params);
  /// Ends the session on purpose: link policies of missions do not apply.
  ~RobotClient() override;

  /// Identity of the robot as received in hello, without another call.
  [[nodiscard]] api::RobotInfo robot() const;
  /// Role that the robot has granted.
  [[nodiscard]] api::Role role() const;
  [[nodiscard]] LinkState link() const;
  /// The name by which the robot knows this client.
  [[nodiscard]] std::string client_name() const;
  /// Ends the session on purpose and all open calls with kCancelled. Further calls have no effect.
  void close();
  /// Compares the clocks once; replies with the best estimate so far.
  void sync_time(const api::Reply<TimeSync>& reply);

  void get_info(api::Reply<api::RobotInfo> reply) override;
  void get_status(api::Reply<api::RobotStatus> reply) override;
  void list_components(api::Reply<std::vector<api::ComponentInfo>> reply) override;
  void restart_component(const std::string& name, api::Reply<void> reply) override;
  void switch_component(const std::string& name, bool active, api::Reply<void> reply) override;
  void exchange_component(const std::string& name, const std::string& type, api::Reply<void> reply) override;
  void get_settings(const std::string& component, api::Reply<std::vector<api::ComponentSetting>> reply) override;
  void set_settings(const std::string& component, const std::vector<std::string>& assignments,
                    api::Reply<std::vector<api::ComponentSetting>> reply) override;
  void start_mission(const api::MissionRequest& request, api::Reply<api::MissionAccepted> reply) override;
  void command_mission(api::MissionCommand command, api::Reply<void> reply) override;
  void get_mission(api::Reply<api::MissionStatus> reply) override;
  void stop(api::Reply<void> reply) override;
  void set_estop(bool engaged, api::Reply<void> reply) override;
  void command_lease(const api::LeaseCommand& command, api::Reply<api::LeaseState> reply) override;
  /// Stamps the command with the robot's time, unless it has a stamp; the clocks are compared for that before the first
  /// command of a connection, and again every minute.
  void drive(const api::DriveCommand& command, api::Reply<void> reply) override;
  void get_tiles(std::uint64_t since_revision, api::Reply<api::TileUpdate> reply) override;
  void get_grid(api::Reply<api::GridReport> reply) override;
  void get_detections(api::Reply<std::vector<api::Detection>> reply) override;
  void get_trajectory(api::Reply<std::vector<api::StampedPose>> reply) override;
  void grab_image(const std::string& camera, api::Reply<api::ImageFrame> reply) override;
  void get_segments(std::uint64_t since_revision, api::Reply<api::SegmentUpdate> reply) override;
  void save_map(const std::string& name, bool replace, api::Reply<api::MapSummary> reply) override;
  void load_map(const std::string& name, api::MapUse use, api::Reply<api::MapSummary> reply) override;
  void list_maps(api::Reply<std::vector<api::MapSummary>> reply) override;
  void inspect_map(const std::string& name, bool verify, api::Reply<api::MapSummary> reply) override;
  void delete_map(const std::string& name, api::Reply<void> reply) override;
  void download_map(const std::string& name, api::Reply<std::vector<std::uint8_t>> reply) override;
  void upload_map(const api::MapUpload& upload, api::Reply<api::MapSummary> reply) override;
  void list_landmarks(api::Reply<std::vector<api::LandmarkSummary>> reply) override;
  void inspect_landmarks(const std::string& name, bool verify, api::Reply<api::LandmarkSummary> reply) override;
  void get_landmarks(const std::string& name, api::Reply<std::vector<api::LandmarkPoint>> reply) override;
  void prune_landmarks(const std::string& name, int min_views, api::Reply<api::LandmarkSummary> reply) override;
  void revert_landmarks(const std::string& name, api::Reply<api::LandmarkSummary> reply) override;
  void delete_landmarks(const std::string& name, api::Reply<void> reply) override;
  void relocalise(const std::optional<Pose2>& map_T_base, api::Reply<void> reply) override;
  /// These four wait for an answer for a minute at least.
  void begin_upload(const api::FileOffer& offer, api::Reply<std::uint64_t> reply) override;
  void upload_piece(const api::UploadPiece& piece, api::Reply<std::uint64_t> reply) override;
  void finish_upload(const api::UploadEnd& end, api::Reply<api::UploadedFile> reply) override;
  void read_file(const api::FileRead& wish, api::Reply<api::FilePiece> reply) override;
  void get_diagnosis(api::Reply<std::vector<api::Finding>> reply) override;
  void get_audit(const api::AuditQuery& query, api::Reply<std::vector<api::AuditRecord>> reply) override;
  /// Returns at once. Fails (kInvalidArgument) for an empty list, a topic named twice or a negative rate.
  [[nodiscard]] Result<std::unique_ptr<api::Subscription>> subscribe(const std::vector<api::TopicRequest>& topics,
                                                                     api::UpdateSink sink) override;

 private:
  class Impl;
  explicit RobotClient(std::shared_ptr<Impl> impl);
  std::shared_ptr<Impl> impl_;
};

}  // namespace seeker::rpc
