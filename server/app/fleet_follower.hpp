/// \file
/// A robot that joins the fleet of another one: tells the main robot what it has, sends what that one lacks, and hears
/// how all lie. Without a link it goes on alone, and catches up when the link is back.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/api/fleet.hpp"
#include "common/rpc/endpoint.hpp"
#include "common/rpc/fleet_client.hpp"
#include "server/app/fleet_pieces.hpp"
#include "server/app/own_map.hpp"

namespace seeker::app {

struct FleetFollowerParams {
  rpc::Endpoint main;
  std::string robot_id;
  Duration period = std::chrono::seconds(5);         ///< wall time between announcements
  Duration call_timeout = std::chrono::seconds(10);  ///< wall time
};

/// Works on a thread of its own.
class FleetFollower {
 public:
  FleetFollower(FleetFollowerParams params, OwnMapSource own_map);
  FleetFollower(const FleetFollower&) = delete;
  FleetFollower& operator=(const FleetFollower&) = delete;
  ~FleetFollower();

  /// What the main robot said last; any thread. kNotReady, kLinkLost, or its refusal, before it has said anything.
  [[nodiscard]] Result<api::FleetStatus> status() const;

 private:
  void run();
  [[nodiscard]] Status once();
  [[nodiscard]] Result<OwnMap> ask_own_map() const;
  [[nodiscard]] Status send(const PackedMap& packed, const api::FleetMissing& missing);
  void note(const Status& outcome);
  [[nodiscard]] bool stopping() const;

  FleetFollowerParams params_;
  OwnMapSource own_map_;
  std::uint64_t instance_;
  rpc::FleetClient main_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable wake_;
  bool stopping_ = false;
  Status last_;
  std::optional<api::FleetStatus> fleet_;
  std::thread thread_;
};

}  // namespace seeker::app
