/// \file
/// The map of segments: its files on the disk of the robot, and its changes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/line_map.hpp"

namespace seeker::api {

/// What a loaded map is used for.
enum class MapUse : std::uint8_t {
  kContinue,  ///< missions extend the map
  kLocalise,  ///< the map is only read; neither it nor its file is changed
};
[[nodiscard]] std::string_view to_string(MapUse use);

/// Summary of a map file. Times are wall time, seconds since 1970 (UTC).
struct MapSummary {
  std::string name;  ///< [a-z0-9_-]{1,64}
  std::string robot_id;
  std::string sensors;  ///< for people
  std::string software_version;
  std::int64_t created_unix_s = 0;
  std::int64_t saved_unix_s = 0;
  std::uint64_t file_bytes = 0;
  std::uint32_t epoch = 0;
  std::uint32_t nodes = 0;
  std::uint32_t edges = 0;
  std::uint32_t loops = 0;  ///< number of the edges that are loop closures
  std::uint32_t segments = 0;
  std::uint32_t keyframes = 0;  ///< number of scans kept with the map
  std::string problem;          ///< why the file cannot be used; empty when it can

  friend bool operator==(const MapSummary&, const MapSummary&) = default;
};

inline constexpr std::size_t kMaxMaps = 10'000;
/// Largest map file that is sent to or from a client; it fits into one frame of the protocol.
inline constexpr std::size_t kMaxMapTransferBytes = 15UL * 1024 * 1024;

/// A map file that a client sends to the robot.
struct MapUpload {
  std::string name;  ///< under which it is kept; the name inside the file does not count
  std::vector<std::uint8_t> bytes;
  bool replace = false;     ///< true: an existing map of this name is replaced
  bool check_only = false;  ///< true: the file is verified and not kept

  friend bool operator==(const MapUpload&, const MapUpload&) = default;
};

/// Segments changed since a revision. A receiver applies `removed` and `changed` to the segments it has; when `full`,
/// it first discards them all.
struct SegmentUpdate {
  std::uint64_t revision = 0;  ///< of the map after this update; the next request names it
  std::uint32_t map_epoch = 0;
  bool full = false;
  std::vector<MapSegment> changed;  ///< changed and new segments, by rising id
  std::vector<std::uint64_t> removed;

  friend bool operator==(const SegmentUpdate&, const SegmentUpdate&) = default;
};
inline constexpr std::size_t kMaxSegmentsPerUpdate = 4096;   ///< entries of `changed` and `removed` together
inline constexpr std::size_t kMaxSegmentsOfMap = 1'000'000;  ///< in all parts of one answer

/// Splits an update into parts of at most kMaxSegmentsPerUpdate entries, at least one; only the first may be `full`.
[[nodiscard]] std::vector<SegmentUpdate> split(const SegmentUpdate& update);

/// State of the estimator's map.
struct LineMapStatus {
  std::string name;  ///< under which the map was saved or loaded last; empty: neither
  MapUse use = MapUse::kContinue;
  std::uint32_t segments = 0;
  std::uint64_t revision = 0;  ///< of the segments
  bool relocalising = false;   ///< true: relocalisation in the map is running

  friend bool operator==(const LineMapStatus&, const LineMapStatus&) = default;
};

}  // namespace seeker::api
