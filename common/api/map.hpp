/// \file
/// The map of segments as an asset: what a robot keeps of it on disk, what changes in it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/line_map.hpp"

namespace seeker::api {

/// What a loaded map is used for.
enum class MapUse : std::uint8_t {
  kContinue,  ///< the map grows on
  kLocalise,  ///< the map is only read; neither it nor its file is changed
};
[[nodiscard]] std::string_view to_string(MapUse use);

/// A map file in figures. Times are wall time, seconds since 1970 (UTC).
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
  std::uint32_t loops = 0;  ///< of the edges: loop closures
  std::uint32_t segments = 0;
  std::uint32_t keyframes = 0;  ///< kept scans
  std::string problem;          ///< why the file cannot be used; empty when it can

  friend bool operator==(const MapSummary&, const MapSummary&) = default;
};

inline constexpr std::size_t kMaxMaps = 10'000;
/// A map that travels to or from a client fits into one frame of the protocol.
inline constexpr std::size_t kMaxMapTransferBytes = 15UL * 1024 * 1024;

/// What to do with a map file that a client sends.
struct MapUpload {
  std::string name;  ///< under which it is kept; whatever the file says
  std::vector<std::uint8_t> bytes;
  bool replace = false;     ///< an existing map of this name
  bool check_only = false;  ///< verify the file and keep nothing

  friend bool operator==(const MapUpload&, const MapUpload&) = default;
};

/// Segments changed since a revision. Apply `removed` and `changed` to what is there; when `full`, throw away what is
/// there first.
struct SegmentUpdate {
  std::uint64_t revision = 0;  ///< of the map after this update; ask for changes since it next time
  std::uint32_t map_epoch = 0;
  bool full = false;
  std::vector<MapSegment> changed;  ///< new ones too; by rising id
  std::vector<std::uint64_t> removed;

  friend bool operator==(const SegmentUpdate&, const SegmentUpdate&) = default;
};
inline constexpr std::size_t kMaxSegmentsPerUpdate = 4096;   ///< changed and removed together
inline constexpr std::size_t kMaxSegmentsOfMap = 1'000'000;  ///< of one answer, in parts

/// Parts of at most kMaxSegmentsPerUpdate entries; only the first is `full`. At least one.
[[nodiscard]] std::vector<SegmentUpdate> split(const SegmentUpdate& update);

/// What the estimator's map is at the moment.
struct LineMapStatus {
  std::string name;  ///< under which it was saved or loaded last; empty: neither
  MapUse use = MapUse::kContinue;
  std::uint32_t segments = 0;
  std::uint64_t revision = 0;  ///< of the segments
  bool relocalising = false;   ///< the robot looks for its place in the map

  friend bool operator==(const LineMapStatus&, const LineMapStatus&) = default;
};

}  // namespace seeker::api
