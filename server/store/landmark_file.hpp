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

/// The appearance of a landmark from one side.
struct LandmarkSide {
  Vector3Record to_eye{};
  std::int64_t seen = 0;
  std::array<std::uint8_t, 128> descriptor{};

  friend bool operator==(const LandmarkSide&, const LandmarkSide&) = default;
};

/// One landmark as plain numbers; server/localize/landmark.hpp explains them.
struct LandmarkRecord {
  std::uint64_t id = 0;
  Vector3Record p_map{};
  std::array<double, 6> information{};  ///< information matrix of the position: xx, xy, xz, yy, yz, zz
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

/// The content of a database that a localiser needs, landmarks by rising id.
struct LandmarkContent {
  std::uint64_t calibration = 0;
  std::uint64_t next_id = 1;
  std::uint64_t sightings = 0;
  std::vector<LandmarkRecord> landmarks;

  friend bool operator==(const LandmarkContent&, const LandmarkContent&) = default;
};

/// The origin of a database. Times are wall time, seconds since 1970 (UTC).
struct LandmarkOrigin {
  std::string robot_id;
  std::string software_version;
  std::string map_name;  ///< whose frame the landmarks are in; empty: that of the survey
  std::int64_t created_unix_s = 0;
  std::int64_t saved_unix_s = 0;

  friend bool operator==(const LandmarkOrigin&, const LandmarkOrigin&) = default;
};

/// Summary of a file.
struct LandmarkHeader {
  LandmarkOrigin origin;
  std::uint64_t calibration = 0;
  std::uint64_t revision = 0;  ///< rises with every change, a revert too
  std::uint64_t landmarks = 0;
  std::uint64_t file_bytes = 0;
  bool can_revert = false;  ///< the version before is kept

  friend bool operator==(const LandmarkHeader&, const LandmarkHeader&) = default;
};

/// A file with its origin and content.
struct LandmarkFile {
  LandmarkHeader header;
  LandmarkContent content;  ///< the present version
};

// Errors of all: kNotFound (no such file), kIo, kCorrupt, kUnsupportedVersion (both versions named), kInvalidArgument
// (a database of another kind, numbers that are not finite), kTooLarge. A failure leaves the file as it was.

/// Writes a new file under a temporary name and renames it over `file`.
[[nodiscard]] Status write_landmark_file(const std::filesystem::path& file, const LandmarkOrigin& origin,
                                         const LandmarkContent& content);
/// Makes `content` the present version and keeps the one before, in one transaction: a program that is killed meanwhile
/// leaves the old version or the new one.
[[nodiscard]] Status update_landmark_file(const std::filesystem::path& file, std::int64_t saved_unix_s,
                                          const LandmarkContent& content);
/// Replaces the present version by the one before. kNotReady: none is kept.
[[nodiscard]] Status revert_landmark_file(const std::filesystem::path& file, std::int64_t saved_unix_s);
/// Reads the header alone, without the landmarks.
[[nodiscard]] Result<LandmarkHeader> read_landmark_header(const std::filesystem::path& file);
/// Reads and checks the present version.
[[nodiscard]] Result<LandmarkFile> read_landmark_file(const std::filesystem::path& file);

}  // namespace seeker::store
