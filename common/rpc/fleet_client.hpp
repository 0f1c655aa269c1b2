/// \file
/// Calls to the main robot of a fleet, one after another.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/api/fleet.hpp"
#include "common/core/result.hpp"
#include "common/pki/bundle.hpp"
#include "common/rpc/endpoint.hpp"

namespace seeker::rpc {

inline constexpr std::uint16_t kDefaultFleetPort = 7473;

/// Used by one thread, which waits for each reply. After an error of the link the next call connects again.
class FleetClient {
 public:
  /// With `tls` the calls are made over TLS with these files, which are read for each connection.
  FleetClient(Endpoint main, Duration call_timeout, std::optional<pki::BundleFiles> tls = std::nullopt);
  FleetClient(FleetClient&& other) noexcept;
  FleetClient& operator=(FleetClient&& other) noexcept;
  ~FleetClient();

  /// Sends the manifest of a robot. kRefused: another robot has this id.
  [[nodiscard]] Result<api::FleetAnswer> announce(const api::FleetManifest& manifest);
  /// Sends the topology of a robot and receives those of the others. kNotFound: the robot has to announce itself first;
  /// kRefused: another robot has this id.
  [[nodiscard]] Result<api::FleetShared> share(const api::FleetShare& share);
  /// Sends what a robot has observed and receives what the others have. kNotFound: the robot has to announce itself
  /// first.
  [[nodiscard]] Result<api::FleetSightings> seen(const api::FleetSeen& seen);
  /// Sends a part of a piece and returns the number of its bytes that the main robot has then. kCorrupt, kNotFound,
  /// kTooLarge.
  [[nodiscard]] Result<std::uint64_t> send(const api::FleetChunk& chunk);
  [[nodiscard]] Result<api::FleetStatus> status();
  [[nodiscard]] Result<api::FleetStatus> decide(const api::FleetDecision& decision);
  /// What all robots have reported, in the frame `map` of the main robot. kNotReady: nothing yet.
  [[nodiscard]] Result<api::FleetScene> scene();
  /// The joint map as the bytes of a map file.
  [[nodiscard]] Result<std::vector<std::uint8_t>> map();

 private:
  struct Link;
  std::unique_ptr<Link> link_;
};

}  // namespace seeker::rpc
