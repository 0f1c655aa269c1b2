/// \file
/// Limits of the protocol. A message above a limit is refused before memory is spent on it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace seeker::wire {

inline constexpr std::size_t kFrameHeaderBytes = 4;
inline constexpr std::size_t kMaxFrameBytes = 16UL * 1024 * 1024;  ///< largest payload of one frame

inline constexpr std::size_t kMaxNameBytes = 64;    ///< client, component, camera, target, mission
inline constexpr std::size_t kMaxTextBytes = 4096;  ///< one sentence for people; a longer one is cut by the sender
inline constexpr std::size_t kMaxCapabilities = 256;
inline constexpr std::size_t kMaxComponents = 1024;
inline constexpr std::size_t kMaxPorts = 64;             ///< of a component, and connections of a port
inline constexpr std::size_t kMaxSettings = 1024;        ///< of a component
inline constexpr std::size_t kMaxAssignments = 64;       ///< of one change of settings
inline constexpr std::size_t kMaxPortNameBytes = 129;    ///< "component.port"
inline constexpr std::size_t kMaxSettingKeyBytes = 256;  ///< key or path of a setting
inline constexpr std::size_t kMaxFaults = 256;
inline constexpr std::size_t kMaxFindings = 256;     ///< of a diagnosis
inline constexpr std::size_t kMaxAddressBytes = 64;  ///< of a client in a record of who commanded what
inline constexpr std::size_t kMaxSonars = 256;
inline constexpr std::size_t kMaxTilesPerUpdate = 1024;  ///< 4 MiB without compression
inline constexpr std::size_t kMaxTileParts = 1024;       ///< of one answer: 10 km2 of map
inline constexpr std::size_t kMaxMapNameBytes = 256;     ///< any text of a MapSummary but its problem
inline constexpr std::size_t kMaxPathPoints = 65'536;
inline constexpr std::size_t kMaxListPoints = 250'000;  ///< cells of a grid list
inline constexpr std::size_t kMaxTrajectoryPoses = 500'000;
inline constexpr std::size_t kMaxDetections = 10'000;
inline constexpr std::size_t kMaxGaps = 10'000;
inline constexpr std::size_t kMaxUnreachablePlaces = 1024;  ///< with their causes; more are sent as points alone
inline constexpr std::size_t kMaxGridCells = 8UL * 1024 * 1024;
inline constexpr std::size_t kMaxImageBytes = 64UL * 1024 * 1024;  ///< of pixels, after decompression
inline constexpr std::int32_t kMaxTileIndex = 1 << 20;             ///< 3355 km from the origin
inline constexpr double kMaxStreamRate_hz = 1000.0;
/// Messages inside one frame: the smallest takes two bytes on the wire but a hundred in memory.
inline constexpr std::size_t kMaxMessagesPerFrame = 200'000;

}  // namespace seeker::wire
