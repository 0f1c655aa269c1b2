#include "server/lab/scoring/trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "common/core/angle.hpp"
#include "server/drivers/replay/words.hpp"

namespace seeker::lab {
namespace {

using drivers::Words;

/// Rotations about x and y beyond this are no planar pose.
constexpr double kMaxTilt = 0.01;

Result<std::optional<StampedPose>> parse_tum(Words words) {
  StampedPose pose;
  pose.stamp_s = words.number();
  pose.map_T_base.x_m = words.number();
  pose.map_T_base.y_m = words.number();
  words.skip(1);
  const double qx = words.number();
  const double qy = words.number();
  const double qz = words.number();
  const double qw = words.number();
  const double norm = std::hypot(std::hypot(qx, qy), std::hypot(qz, qw));
  if (!words.good() || !words.at_end() || norm == 0.0 || !std::isfinite(norm)) {
    return fail(Errc::kParse, "the line is not `t x y z qx qy qz qw`");
  }
  if (std::hypot(qx, qy) > kMaxTilt * norm) {
    return fail(Errc::kParse, "the rotation is not about the vertical");
  }
  pose.map_T_base.theta_rad = wrap_angle(2.0 * std::atan2(qz, qw));
  return pose;
}

Result<std::optional<StampedPose>> parse_csv(Words words) {
  StampedPose pose;
  pose.stamp_s = words.number();
  pose.map_T_base = words.pose();
  if (!words.good() || !words.at_end()) {
    return fail(Errc::kParse, "the line is not `t,x,y,theta`");
  }
  return pose;
}

bool later(double stamp_s, const StampedPose& pose) { return stamp_s < pose.stamp_s; }

}  // namespace

Result<std::optional<StampedPose>> parse_pose_line(std::string_view line) {
  const bool commas = line.find(',') != std::string_view::npos;
  const Words words(line, commas ? Words::kCommaOrBlank : Words::kBlank);
  const std::string_view first = Words(words).word();
  if (first.empty() || first.front() == '#' || (commas && (first == "t" || first == "time" || first == "stamp"))) {
    return std::nullopt;
  }
  return commas ? parse_csv(words) : parse_tum(words);
}

Result<TrajectoryFile> read_trajectory(const std::filesystem::path& path) {
  Result<drivers::LineFile> file = drivers::LineFile::open(path);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  TrajectoryFile read;
  std::string line;
  using Line = drivers::LineFile::Line;
  for (Line kind = file->next(line); kind != Line::kEnd; kind = file->next(line)) {
    const Result<std::optional<StampedPose>> pose =
        kind == Line::kTooLong ? fail(Errc::kParse, "the line is too long") : parse_pose_line(line);
    if (!pose) {
      read.bad.add(file->number(), pose.error().message);
    } else if (*pose && !read.poses.empty() && (*pose)->stamp_s <= read.poses.back().stamp_s) {
      read.bad.add(file->number(), "its stamp does not rise");
    } else if (*pose) {
      read.poses.push_back(**pose);
    }
  }
  read.damage = file->damage();
  if (read.poses.empty()) {
    return fail(Errc::kParse,
                path.string() + " holds no pose; it must be lines `t x y z qx qy qz qw` or `t,x,y,theta`");
  }
  return read;
}

std::string tum_text(const Trajectory& trajectory) {
  std::string text;
  for (const StampedPose& pose : trajectory) {
    std::array<char, 160> line{};
    const double half_rad = pose.map_T_base.theta_rad / 2.0;
    const int length = std::snprintf(line.data(), line.size(), "%.6f %.9f %.9f 0 0 0 %.12f %.12f\n", pose.stamp_s,
                                     pose.map_T_base.x_m, pose.map_T_base.y_m, std::sin(half_rad), std::cos(half_rad));
    text.append(line.data(), static_cast<std::size_t>(std::clamp(length, 0, static_cast<int>(line.size()) - 1)));
  }
  return text;
}

std::optional<std::size_t> index_before(const Trajectory& trajectory, double stamp_s) {
  const auto next = std::upper_bound(trajectory.begin(), trajectory.end(), stamp_s, later);
  if (next == trajectory.begin()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(next - trajectory.begin()) - 1;
}

std::optional<Pose2> pose_at(const Trajectory& trajectory, double stamp_s) {
  const std::optional<std::size_t> index = index_before(trajectory, stamp_s);
  if (!index) {
    return std::nullopt;
  }
  const StampedPose& before = trajectory[*index];
  if (before.stamp_s == stamp_s) {
    return before.map_T_base;
  }
  if (*index + 1 == trajectory.size()) {
    return std::nullopt;
  }
  const StampedPose& after = trajectory[*index + 1];
  const double share = (stamp_s - before.stamp_s) / (after.stamp_s - before.stamp_s);
  const Pose2& a = before.map_T_base;
  const Pose2& b = after.map_T_base;
  return Pose2{a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m),
               wrap_angle(a.theta_rad + share * wrap_angle(b.theta_rad - a.theta_rad))};
}

double time_to_nearest_s(const Trajectory& trajectory, double stamp_s) {
  const auto next = std::upper_bound(trajectory.begin(), trajectory.end(), stamp_s, later);
  double nearest_s = std::numeric_limits<double>::infinity();
  if (next != trajectory.end()) {
    nearest_s = next->stamp_s - stamp_s;
  }
  if (next != trajectory.begin()) {
    nearest_s = std::min(nearest_s, stamp_s - std::prev(next)->stamp_s);
  }
  return nearest_s;
}

double length_m(const Trajectory& trajectory) {
  double sum_m = 0.0;
  for (std::size_t k = 1; k < trajectory.size(); ++k) {
    sum_m += distance_m(trajectory[k - 1].map_T_base, trajectory[k].map_T_base);
  }
  return sum_m;
}

}  // namespace seeker::lab
