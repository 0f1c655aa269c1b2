/// \file
/// Calls to the main robot of a fleet, one after the other.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/api/fleet.hpp"
#include "common/core/result.hpp"
#include "common/rpc/endpoint.hpp"

namespace seeker::rpc {

inline constexpr std::uint16_t kDefaultFleetPort = 7473;

/// Used by one thread, which waits for each answer. After an error of the link the next call connects again.
class FleetClient {
 public:
  FleetClient(Endpoint main, Duration call_timeout);
  FleetClient(FleetClient&& other) noexcept;
  FleetClient& operator=(FleetClient&& other) noexcept;
  ~FleetClient();

  /// Tells what a robot has. kRefused: another robot has this id.
  [[nodiscard]] Result<api::FleetAnswer> announce(const api::FleetManifest& manifest);
  /// Tells where a robot has been and means to go, and hears of the others. kNotFound: it has to announce itself first;
  /// kRefused: another robot has this id.
  [[nodiscard]] Result<api::FleetShared> share(const api::FleetShare& share);
  /// Tells what a robot has seen, and hears what the others have. kNotFound: as above.
  [[nodiscard]] Result<api::FleetSightings> seen(const api::FleetSeen& seen);
  /// Bytes of the piece that are there afterwards. kCorrupt, kNotFound, kTooLarge.
  [[nodiscard]] Result<std::uint64_t> send(const api::FleetChunk& chunk);
  [[nodiscard]] Result<api::FleetStatus> status();
  [[nodiscard]] Result<api::FleetStatus> decide(const api::FleetDecision& decision);
  /// The joint map as the bytes of a map file.
  [[nodiscard]] Result<std::vector<std::uint8_t>> map();

 private:
  struct Link;
  std::unique_ptr<Link> link_;
};

}  // namespace seeker::rpc
