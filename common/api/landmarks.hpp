/// \file
/// Databases of visual landmarks that a robot keeps on disk.
#pragma once

#include <cstdint>
#include <string>

#include "common/core/pose2.hpp"

namespace seeker::api {

/// Summary of a database of landmarks. Times are wall time, seconds since 1970 (UTC).
struct LandmarkSummary {
  std::string name;  ///< [a-z0-9_-]{1,64}
  std::string robot_id;
  std::string software_version;
  std::string map_name;           ///< whose frame the landmarks are in; empty: that of the survey
  std::uint64_t calibration = 0;  ///< calibration_hash() of the stereo camera that took the pictures
  std::int64_t created_unix_s = 0;
  std::int64_t saved_unix_s = 0;
  std::uint64_t file_bytes = 0;
  std::uint64_t revision = 0;  ///< rises with every change
  std::uint32_t landmarks = 0;
  std::string problem;  ///< why it cannot be used; empty when it can

  friend bool operator==(const LandmarkSummary&, const LandmarkSummary&) = default;
};

/// One landmark: a point that a camera can recognise.
struct LandmarkPoint {
  std::uint64_t id = 0;
  Point2 p = Point2::Zero();  ///< in the frame of the database
  double z_m = 0.0;           ///< height above the floor
  double sigma_m = 0.0;       ///< largest standard deviation of the position
  std::uint32_t views = 0;    ///< number of pictures that have shown it

  friend bool operator==(const LandmarkPoint&, const LandmarkPoint&) = default;
};

inline constexpr std::size_t kMaxLandmarkDatabases = 10'000;
inline constexpr std::size_t kMaxLandmarks = 200'000;  ///< of one database

}  // namespace seeker::api
