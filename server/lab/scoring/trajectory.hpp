/// \file
/// Poses over time: output of estimators, contents of recordings, and their files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/drivers/replay/line_file.hpp"

namespace seeker::lab {

struct StampedPose {
  double stamp_s = 0.0;  ///< on the log's own clock
  Pose2 map_T_base;

  friend bool operator==(const StampedPose&, const StampedPose&) = default;
};

/// Poses with strictly rising stamps.
using Trajectory = std::vector<StampedPose>;

/// Contents of a trajectory file.
struct TrajectoryFile {
  Trajectory poses;
  drivers::BadLines bad;  ///< malformed, or with a stamp that does not rise
  std::string damage;     ///< why the file ended early; empty otherwise
};

/// Parses one line of a TUM file, `t x y z qx qy qz qw`, or of `t,x,y,theta`. Nothing: an empty line, a comment or a
/// line of column names. kParse: malformed, or a rotation that is not about the vertical.
[[nodiscard]] Result<std::optional<StampedPose>> parse_pose_line(std::string_view line);

/// Reads a file of such lines, plain or .gz. kNotFound, kIo; kParse when it holds no pose.
[[nodiscard]] Result<TrajectoryFile> read_trajectory(const std::filesystem::path& path);

/// TUM lines with times in microseconds and lengths in nanometres.
[[nodiscard]] std::string tum_text(const Trajectory& trajectory);

/// The pose interpolated between its neighbours at constant speed. Nothing: the stamp lies outside the trajectory.
[[nodiscard]] std::optional<Pose2> pose_at(const Trajectory& trajectory, double stamp_s);

/// The last entry that is not after the stamp. Nothing: the stamp is before the first.
[[nodiscard]] std::optional<std::size_t> index_before(const Trajectory& trajectory, double stamp_s);

/// Distance in time to the nearest entry; infinite for an empty trajectory.
[[nodiscard]] double time_to_nearest_s(const Trajectory& trajectory, double stamp_s);

/// Sum of the distances between neighbours.
[[nodiscard]] double length_m(const Trajectory& trajectory);

}  // namespace seeker::lab
