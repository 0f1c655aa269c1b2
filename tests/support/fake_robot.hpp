/// \file
/// A robot of values in memory, for tests of everything that talks to one.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "common/api/robot_api.hpp"

namespace seeker::testing {

/// What the fake robot answers and what it was asked. Change `values` through edit() while a server runs.
struct FakeRobotValues {
  api::RobotInfo info;
  api::RobotStatus status;
  std::vector<api::ComponentInfo> components;
  std::map<std::string, std::vector<api::ComponentSetting>> settings;  ///< by component
  std::optional<api::MissionStatus> mission;
  api::TileUpdate tiles;
  api::GridReport grid;
  std::vector<api::Detection> detections;
  std::vector<api::StampedPose> trajectory;
  /// What get_segments answers, whatever revision is asked for; nothing: the estimator keeps no map.
  std::optional<api::SegmentUpdate> segments;
  std::vector<api::MapSummary> maps;
  std::map<std::string, std::vector<api::LandmarkPoint>> landmarks;         ///< databases by name
  std::map<std::string, std::vector<api::LandmarkPoint>> landmarks_before;  ///< the version before, where there is one
  std::map<std::string, std::vector<std::uint8_t>> map_files;
  std::vector<api::MapUpload> uploads;
  std::map<std::string, std::vector<std::uint8_t>> landmark_files;
  /// A file that arrives in pieces, as far as it is here, and the size that was announced.
  struct Incoming {
    std::uint64_t size_bytes = 0;
    std::vector<std::uint8_t> bytes;
  };
  std::map<api::FileHash, Incoming> incoming;
  std::uint64_t piece_bytes = 0;  ///< of all pieces that have come, those that were here already included
  bool too_old_for_pieces = false;
  std::vector<std::optional<Pose2>> relocalisations;
  std::map<std::string, api::ImageFrame> cameras;
  /// What get_diagnosis and get_audit answer; nothing: kNotReady.
  std::optional<std::vector<api::Finding>> diagnosis = std::vector<api::Finding>{};
  std::optional<std::vector<api::AuditRecord>> audit = std::vector<api::AuditRecord>{};
  std::vector<api::AuditQuery> audit_queries;
  std::vector<api::AuditRecord> commanded;  ///< what the server has told of commands
  api::LeaseState lease;
  bool estop = false;
  /// When set, every call fails with it.
  std::optional<Error> failure;
  /// Calls that arrived, in order, e.g. "operator-1 stop".
  std::vector<std::string> calls;
  std::vector<api::DriveCommand> drives;
  /// Called for each of `drives` when it arrives; may be empty.
  std::function<void(const api::DriveCommand&)> on_drive;
  std::vector<api::MissionRequest> missions;
  std::vector<api::Caller> opened;
  std::vector<api::Caller> closed;
  std::vector<std::pair<api::Caller, std::string>> lost;
  std::vector<std::pair<api::Caller, Duration>> silent;
  std::vector<api::Caller> returned;
};

/// Robot id "fake", one component, one camera "omni", four tiles, one detection, a mission when one was started.
[[nodiscard]] FakeRobotValues default_fake_values();

/// All clients see the same robot. Every method may be called from any thread; replies come at once on the calling
/// thread, unless hold_replies(true) keeps them back until release_replies().
class FakeRobotHost : public api::RobotHost {
 public:
  FakeRobotHost();
  ~FakeRobotHost() override;

  [[nodiscard]] std::shared_ptr<api::RobotApi> open(const api::Caller& caller) override;
  void closed(const api::Caller& caller) override;
  void silent(const api::Caller& caller, Duration silence) override {
    edit([&](FakeRobotValues& v) { v.silent.emplace_back(caller, silence); });
  }
  void returned(const api::Caller& caller) override {
    edit([&](FakeRobotValues& v) { v.returned.push_back(caller); });
  }
  void lost(const api::Caller& caller, const std::string& why) override;
  void commanded(const api::AuditRecord& record) override {
    edit([&](FakeRobotValues& v) { v.commanded.push_back(record); });
  }

  /// A copy of the values as they are now.
  [[nodiscard]] FakeRobotValues values() const;
  void edit(const std::function<void(FakeRobotValues&)>& change);
  /// Numbers the payload in its topic and hands it to all subscribers, on the calling thread.
  void publish(api::Topic topic, RobotTime stamp, api::Payload payload);
  void hold_replies(bool hold);
  /// Answers everything that was held, on the calling thread.
  void release_replies();

 private:
  friend class FakeRobot;
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace seeker::testing
