/// \file
/// The robot as a whole: the loop on its own thread, and the API body that others call.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "common/api/robot_api.hpp"
#include "server/app/diagnosis/diagnosis_service.hpp"
#include "server/app/fleet/own_map.hpp"
#include "server/app/landmarks/landmark_service.hpp"
#include "server/app/loop/robot_loop.hpp"
#include "server/app/robot/checkpoint_service.hpp"
#include "server/app/robot/drive_recorder.hpp"
#include "server/app/robot/loop_clock.hpp"
#include "server/app/robot/map_service.hpp"
#include "server/app/robot/transfer_service.hpp"
#include "server/app/runtime/mailbox.hpp"
#include "server/app/state/audit_trail.hpp"
#include "server/app/state/journal.hpp"

namespace seeker::app {

struct RobotIdentity {
  std::string robot_id = "seeker-1";
  std::string software_version;
  double robot_radius_m = 0.26;
};

/// Owns loop, mailbox and thread. RobotApi calls from any thread become tasks of the loop's thread.
class Robot final : public api::RobotHost {
 public:
  /// `journal` may be null: nothing is kept over a restart then. An empty `maps` folder: no maps are kept.
  /// An empty `incoming` folder: nothing is taken that arrives in pieces.
  Robot(RobotIdentity identity, const LoopParams& params, LoopParts parts, std::unique_ptr<Journal> journal = nullptr,
        const std::filesystem::path& maps = {},
        std::shared_ptr<LandmarkLibrary> landmarks = std::make_shared<LandmarkLibrary>(LandmarkStorage{}),
        const std::filesystem::path& incoming = {});
  ~Robot() override;

  /// Records what the robot drives on from its start, which comes later. A recording that fails is a warning.
  void record(std::unique_ptr<DriveRecorder> recorder);
  /// Keeps who commanded what, and answers for it. A record that cannot be written is a warning.
  void keep_audit(std::unique_ptr<AuditTrail> audit);
  /// Answers what there is to say of the machine; `sources` without journal and audit trail, which are the robot's.
  void diagnose(HostSources sources);
  /// Starts the components, then the thread. With `wait_for_client` a replay begins with the first session.
  void start(bool wait_for_client = false);
  /// Halts the robot, answers what was asked, joins the thread. Harmless when repeated.
  void stop();
  /// Runs until the source has ended (a replay) or `deadline` robot time; for programs without a network.
  [[nodiscard]] RobotLoop& loop() { return loop_; }
  /// Raises these faults, which concern the link to clients, and clears those of the last call that are not among them;
  /// any thread.
  void set_link_faults(std::vector<api::Fault> faults);
  /// The robot for its fleet; valid while this lives.
  [[nodiscard]] FleetHost fleet_host();
  /// True once a replay's source has been read to its end.
  [[nodiscard]] bool ended() const { return ended_.load(); }
  /// Robot time, and number of passes of the loop; any thread.
  [[nodiscard]] RobotTime now() const { return clock_.now(std::chrono::steady_clock::now()); }
  [[nodiscard]] std::uint64_t passes() const { return clock_.passes(); }

  [[nodiscard]] std::shared_ptr<api::RobotApi> open(const api::Caller& caller) override;
  void closed(const api::Caller& caller) override;
  void silent(const api::Caller& caller, Duration silence) override;
  void returned(const api::Caller& caller) override;
  void lost(const api::Caller& caller, const std::string& why) override;
  void commanded(const api::AuditRecord& record) override;

 private:
  class Session;

  void give_own_map(const api::Reply<OwnMap>& reply);
  void give_own_topology(const api::Reply<OwnTopology>& reply);
  void give_own_seen(const api::Reply<OwnSeen>& reply);
  void keep_journal();
  void watch_journal();
  void keep_estop(bool engaged, const api::Reply<void>& reply);
  void accept(const api::MissionAccepted& accepted, bool again, const api::Reply<api::MissionAccepted>& reply);
  void answer_kept(const Status& done, const api::Reply<void>& reply);
  [[nodiscard]] bool pass();
  void run(bool wait_for_client);
  [[nodiscard]] api::RobotInfo info() const;

  RobotIdentity identity_;
  UpdateHub hub_;
  RobotLoop loop_;
  Mailbox mailbox_;
  std::unique_ptr<Journal> journal_;
  std::unique_ptr<AuditTrail> audit_;
  std::unique_ptr<DiagnosisService> diagnosis_;
  std::unique_ptr<DriveRecorder> recorder_;
  MapStore map_store_;
  MapService maps_;
  CheckpointService checkpoints_;
  LandmarkService landmarks_;
  TransferService transfers_;
  std::vector<std::string> link_faults_;  ///< ids of those that are raised; the loop's thread
  std::thread thread_;
  /// Stops that were asked for, counted before they are carried out.
  std::atomic<std::uint64_t> stops_{0};
  std::atomic<bool> client_seen_{false};
  std::atomic<bool> ended_{false};
  LoopClock clock_;
};

}  // namespace seeker::app
