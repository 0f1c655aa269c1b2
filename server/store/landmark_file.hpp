/// \file
/// A database of stereo landmarks on disk: one SQLite file each, with the version before the last change.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::store {

/// Version of the tables this program writes; a newer file is refused.
inline constexpr std::int64_t kLandmarkSchemaVersion = 1;
/// Most landmarks of a file, and most sides of one landmark.
inline constexpr std::int64_t kMaxLandmarkRecords = 1'000'000;
inline constexpr std::int64_t kMaxLandmarkSides = 16;

using Vector3Record = std::array<double, 3>;

/// How a landmark looks from one side.
struct LandmarkSide {
  Vector3Record to_eye{};
  std::int64_t seen = 0;
  std::array<std::uint8_t, 128> descriptor{};

  friend bool operator==(const LandmarkSide&, const LandmarkSide&) = default;
};

/// One landmark as plain numbers; what they mean is told in server/localize/landmark.hpp.
struct LandmarkRecord {
  std::uint64_t id = 0;
  Vector3Record p_map{};
  std::array<double, 6> information{};  ///< xx, xy, xz, yy, yz, zz
  Vector3Record to_eye{};
  double concentration = 0.0;
  double scale_m = 0.0;
  std::int64_t seen = 0;
  std::int64_t expected = 0;
  std::int64_t misses = 0;
  double log_odds = 0.0;
  std::uint64_t last_seen = 0;
  std::vector<LandmarkSide> sides;

  friend bool operator==(const LandmarkRecord&, const LandmarkRecord&) = default;
};

/// Everything that a localiser needs. Landmarks by rising id.
struct LandmarkContent {
  std::uint64_t calibration = 0;
  std::uint64_t next_id = 1;
  std::uint64_t sightings = 0;
  std::vector<LandmarkRecord> landmarks;

  friend bool operator==(const LandmarkContent&, const LandmarkContent&) = default;
};

/// Where a database comes from. Times are wall time, seconds since 1970 (UTC).
struct LandmarkOrigin {
  std::string robot_id;
  std::string software_version;
  std::string map_name;  ///< whose frame the landmarks are in; empty: that of the survey
  std::int64_t created_unix_s = 0;
  std::int64_t saved_unix_s = 0;

  friend bool operator==(const LandmarkOrigin&, const LandmarkOrigin&) = default;
};

/// A file in figures.
struct LandmarkHeader {
  LandmarkOrigin origin;
  std::uint64_t calibration = 0;
  std::uint64_t revision = 0;  ///< rises with every change, a revert too
  std::uint64_t landmarks = 0;
  std::uint64_t file_bytes = 0;
  bool can_revert = false;  ///< the version before is kept

  friend bool operator==(const LandmarkHeader&, const LandmarkHeader&) = default;
};

/// A whole file.
struct LandmarkFile {
  LandmarkHeader header;
  LandmarkContent content;  ///< the present version
};

// Errors of all: kNotFound (no such file), kIo, kCorrupt, kUnsupportedVersion (both versions named), kInvalidArgument
// (a database of another kind, numbers that are not finite), kTooLarge. A failure leaves the file as it was.

/// Writes a new file under a temporary name and renames it over `file`.
[[nodiscard]] Status write_landmark_file(const std::filesystem::path& file, const LandmarkOrigin& origin,
                                         const LandmarkContent& content);
/// Makes `content` the present version and keeps the one before. In one transaction: whoever is killed meanwhile leaves
/// the old version or the new one.
[[nodiscard]] Status update_landmark_file(const std::filesystem::path& file, std::int64_t saved_unix_s,
                                          const LandmarkContent& content);
/// Makes the version before the present one. kNotReady: none is kept.
[[nodiscard]] Status revert_landmark_file(const std::filesystem::path& file, std::int64_t saved_unix_s);
/// The header alone; the landmarks are not looked at.
[[nodiscard]] Result<LandmarkHeader> read_landmark_header(const std::filesystem::path& file);
/// The present version, checked as a whole.
[[nodiscard]] Result<LandmarkFile> read_landmark_file(const std::filesystem::path& file);

}  // namespace seeker::store
