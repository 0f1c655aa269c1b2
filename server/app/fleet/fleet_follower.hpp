/// \file
/// A robot that joins the fleet of another one: it announces its map to the main robot, sends the pieces that
/// are missing there, and receives how all maps lie. More often it reports where it has been and means to go, and
/// receives the same of the others. Without a link it goes
/// on alone, and catches up when the link is back.
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
#include "server/app/fleet/fleet_pieces.hpp"
#include "server/app/fleet/known_others.hpp"
#include "server/app/fleet/own_map.hpp"

namespace seeker::app {

struct FleetFollowerParams {
  rpc::Endpoint main;
  std::optional<pki::BundleFiles> tls;  ///< nothing: plain TCP
  std::string robot_id;
  Duration period = std::chrono::seconds(5);         ///< wall time between announcements of the map
  Duration share_period = std::chrono::seconds(1);   ///< wall time between those of where the robot goes
  Duration floor_period = std::chrono::seconds(5);   ///< wall time between those of what it has seen
  Duration call_timeout = std::chrono::seconds(10);  ///< wall time
};

/// Works on a thread of its own, on which it calls its host. Any thread may call status(): a mutex guards what that
/// thread and the callers share, and neither the host nor the main robot is called while it is locked.
class FleetFollower {
 public:
  FleetFollower(FleetFollowerParams params, FleetHost host);
  FleetFollower(const FleetFollower&) = delete;
  FleetFollower& operator=(const FleetFollower&) = delete;
  ~FleetFollower();

  /// What the main robot said last; any thread. kNotReady, kLinkLost, or its refusal, before it has said anything.
  [[nodiscard]] Result<api::FleetStatus> status() const;

 private:
  void run();
  [[nodiscard]] Status once();
  [[nodiscard]] Status announce();
  [[nodiscard]] Status send(const PackedMap& packed, const api::FleetMissing& missing);
  [[nodiscard]] Status share();
  [[nodiscard]] Status exchange_seen();
  void note(const Status& outcome);
  [[nodiscard]] bool stopping() const;

  using WallTime = std::chrono::steady_clock::time_point;

  FleetFollowerParams params_;
  FleetHost host_;
  std::uint64_t instance_;
  rpc::FleetClient main_;
  // For the thread only.
  WallTime announce_at_;
  WallTime share_at_;
  WallTime floor_at_;
  KnownOthers others_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable wake_;
  bool stopping_ = false;
  Status last_;
  std::optional<api::FleetStatus> fleet_;
  std::thread thread_;
};

}  // namespace seeker::app
