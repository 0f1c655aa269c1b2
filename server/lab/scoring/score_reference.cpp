#include "server/lab/scoring/score_reference.hpp"

#include <cmath>
#include <vector>

#include "common/core/angle.hpp"
#include "server/fleet/icp.hpp"

namespace seeker::lab {
namespace {

double rms(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) {
    squares += value * value;
  }
  return std::sqrt(squares / static_cast<double>(values.size()));
}

}  // namespace

Result<ReferenceReport> score_reference(const Trajectory& trajectory, const Trajectory& reference, double max_gap_s) {
  std::vector<Pose2> estimates;
  std::vector<Pose2> truths;
  std::vector<Point2> estimated_points;
  std::vector<Point2> true_points;
  for (const StampedPose& pose : trajectory) {
    const std::optional<Pose2> truth = pose_at(reference, pose.stamp_s);
    if (truth && time_to_nearest_s(reference, pose.stamp_s) <= max_gap_s) {
      estimates.push_back(pose.map_T_base);
      truths.push_back(*truth);
      estimated_points.push_back(pose.map_T_base.translation());
      true_points.push_back(truth->translation());
    }
  }
  if (estimates.size() < 2) {
    return fail(Errc::kInvalidArgument, "trajectory and reference share no time: check their clocks");
  }
  ReferenceReport report;
  report.used = estimates.size();
  report.missed = trajectory.size() - estimates.size();
  report.reference_T_map = fleet::rigid_fit(true_points, estimated_points);
  std::vector<double> translation_m;
  std::vector<double> rotation_deg;
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    const Pose2 aligned = report.reference_T_map * estimates[k];
    translation_m.push_back(distance_m(aligned, truths[k]));
    rotation_deg.push_back(rad_to_deg(std::abs(wrap_angle(aligned.theta_rad - truths[k].theta_rad))));
  }
  report.translation_rms_m = rms(translation_m);
  report.rotation_rms_deg = rms(rotation_deg);
  report.translation_m = figures_of(translation_m);
  report.rotation_deg = figures_of(rotation_deg);
  return report;
}

Trajectory apply_corrections(const Trajectory& map_T_odom, const Trajectory& odometry, double max_gap_s) {
  Trajectory corrected;
  for (const StampedPose& pose : odometry) {
    const std::optional<Pose2> correction = pose_at(map_T_odom, pose.stamp_s);
    if (correction && time_to_nearest_s(map_T_odom, pose.stamp_s) <= max_gap_s) {
      corrected.push_back({pose.stamp_s, *correction * pose.map_T_base});
    }
  }
  return corrected;
}

}  // namespace seeker::lab
