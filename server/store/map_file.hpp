/// \file
/// A map of segments as a portable file. Little-endian:
///
///   "SEEKRMAP"  u32 version  u32 header bytes  header  u32 CRC-32 of all before
///   body: one zstd frame                               u32 CRC-32 of all before
///
/// The header holds the origin and the size of the map, so that a folder can be listed without unpacking; the body is
/// the LineMap. The same value always gives the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/line_map.hpp"
#include "common/core/result.hpp"

namespace seeker::store {

inline constexpr std::uint32_t kMapFileVersion = 1;
inline constexpr std::string_view kMapFileEnding = ".seekermap";

/// The origin of a map. Times are wall time, seconds since 1970 (UTC), for display only.
struct MapOrigin {
  std::string name;              ///< see validate_map_name()
  std::string robot_id;          ///< at most kMaxOriginText bytes each
  std::string sensors;           ///< for people, e.g. "lidar with 361 beams of up to 8 m"
  std::string software_version;  ///< of the program that saved it
  std::int64_t created_unix_s = 0;
  std::int64_t saved_unix_s = 0;

  friend bool operator==(const MapOrigin&, const MapOrigin&) = default;
};
inline constexpr std::size_t kMaxOriginText = 256;

struct MapFile {
  MapOrigin origin;
  LineMap map;

  friend bool operator==(const MapFile&, const MapFile&) = default;
};

/// The content of the header.
struct MapFileHeader {
  MapOrigin origin;
  std::uint32_t epoch = 0;
  std::uint32_t nodes = 0;
  std::uint32_t edges = 0;
  std::uint32_t loops = 0;  ///< number of the edges that are enabled loop closures
  std::uint32_t segments = 0;
  std::uint32_t keyframes = 0;
  std::uint64_t body_bytes = 0;   ///< size of the unpacked body
  std::uint64_t frame_bytes = 0;  ///< size of the packed body

  friend bool operator==(const MapFileHeader&, const MapFileHeader&) = default;
};

struct MapFileLimits {
  std::size_t file_bytes = 256UL << 20U;
  std::size_t body_bytes = 512UL << 20U;  ///< unpacked; 100 000 segments and 50 000 scans take 50 MB
};

/// Makes the bytes of a map file. kInvalidArgument: map, name or a text is not valid; kTooLarge.
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_map_file(const MapFile& file, const MapFileLimits& limits = {});
/// Reads the bytes of a map file; the map is valid as by validate(). kParse: they are no map file; kCorrupt: cut or
/// altered; kUnsupportedVersion: made by a newer program, with both versions in the message; kTooLarge.
[[nodiscard]] Result<MapFile> decode_map_file(std::span<const std::uint8_t> bytes, const MapFileLimits& limits = {});
/// Reads the header alone; the body may be cut off or damaged. Errors as of decode_map_file().
[[nodiscard]] Result<MapFileHeader> decode_map_header(std::span<const std::uint8_t> bytes);

/// Replaces `path` as a whole or leaves it as it was. Errors of encode_map_file(), kIo (full disk, no permission).
[[nodiscard]] Status write_map_file(const std::filesystem::path& path, const MapFile& file);
/// Errors of decode_map_file() with the path in front; kNotFound, kIo.
[[nodiscard]] Result<MapFile> read_map_file(const std::filesystem::path& path, const MapFileLimits& limits = {});

}  // namespace seeker::store
