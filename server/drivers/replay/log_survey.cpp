#include "server/drivers/replay/log_survey.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::drivers {
namespace {

constexpr double kMoved_m = 0.3;
constexpr double kMoved_rad = 0.3;

/// No wall is as far, to kSame_m, from places this far apart, one after the other.
constexpr double kApart_m = 0.5;
constexpr double kSame_m = 0.01;
constexpr int kPlaces = 4;

/// A laser that sees no farther fades out near its reach, at one range or another; what it writes for nothing comes
/// often.
constexpr double kLeastShare = 0.05;

/// Enough scans to show what the recorder wrote; many more where the robot stands until the end of them.
constexpr std::uint64_t kScans = 500;
constexpr std::uint64_t kMostScans = 5000;

/// Fewer changes of the stamp in so many scans, and the clock counted so slowly that the scans' rate is not to be had.
constexpr std::uint64_t kChanges = 3;
constexpr std::uint64_t kFewScans = 20;

/// Speed and rotation speed that a mapping robot usually does not exceed, and the usual scan rate.
constexpr double kUsual_m_s = 0.5;
constexpr double kUsual_rad_s = 0.8;
constexpr double kShortestScan_s = 0.05;
constexpr double kLongestScan_s = 1.0;
/// Of all scans so many are no faster than usual: a few more are jumps of the odometry, or gaps of the log.
constexpr double kUsualShare = 0.95;

}  // namespace

void LogSurvey::Motion::add(double stamp_s, const std::optional<Pose2>& pose) {
  first_s = records == 0 ? stamp_s : first_s;
  changes += records > 0 && stamp_s != last_s ? 1 : 0;
  last_s = stamp_s;
  ++records;
  if (!pose) {
    return;
  }
  if (!first) {
    first = pose;
  }
  moved = moved || distance_m(*first, *pose) > kMoved_m ||
          std::abs(wrap_angle(pose->theta_rad - first->theta_rad)) > kMoved_rad;
}

double LogSurvey::Motion::period_s() const {
  constexpr double kShortest_s = 1e-3;
  constexpr double kLongest_s = 1.0;
  const double mean_s = records > 1 ? (last_s - first_s) / static_cast<double>(records - 1) : LogTraits{}.scan_period_s;
  return std::clamp(mean_s, kShortest_s, kLongest_s);
}

void LogSurvey::add(const CarmenRecord& record) {
  if (const auto* odometry = std::get_if<CarmenOdometry>(&record)) {
    odometry_.add(odometry->stamp_s, odometry->odom_T_base);
    robot_ = odometry->odom_T_base;
  } else {
    add_scan(std::get<CarmenScan>(record));
  }
}

void LogSurvey::add_scan(const CarmenScan& scan) {
  scans_.add(scan.stamp_s, scan.odom_T_base);
  raw_scans_ += scan.odom_T_base ? 0 : 1;
  if (odometry_.records == 0) {
    robot_ = scan.odom_T_base;
  }
  watch_motion();
  double farthest_m = 0.0;
  for (const float range_m : scan.ranges_m) {
    farthest_m = std::isfinite(range_m) ? std::max(farthest_m, static_cast<double>(range_m)) : farthest_m;
  }
  watch_reach(farthest_m);
}

void LogSurvey::watch_reach(double farthest_m) {
  if (farthest_m > farthest_m_ + kSame_m) {
    places_ = 0;
    as_far_ = 0;
    last_place_.reset();
  }
  farthest_m_ = std::max(farthest_m_, farthest_m);
  const bool as_far = farthest_m > 0.0 && farthest_m >= farthest_m_ - kSame_m;
  as_far_ += as_far ? 1 : 0;
  if (as_far && robot_ && (!last_place_ || distance_m(*last_place_, *robot_) > kApart_m)) {
    ++places_;
    last_place_ = robot_;
  }
}

void LogSurvey::watch_motion() {
  if (robot_ && robot_at_scan_) {
    const double rotated_rad = std::abs(wrap_angle(robot_->theta_rad - robot_at_scan_->theta_rad));
    least_s_.push_back(std::max(distance_m(*robot_at_scan_, *robot_) / kUsual_m_s, rotated_rad / kUsual_rad_s));
  }
  robot_at_scan_ = robot_;
}

bool LogSurvey::stamps_are_coarse() const { return scans_.records >= kFewScans && scans_.changes < kChanges; }

double LogSurvey::plausible_period_s() const {
  if (least_s_.empty()) {
    return LogTraits{}.scan_period_s;
  }
  std::vector<double> least_s = least_s_;
  const auto usual =
      least_s.begin() + static_cast<std::ptrdiff_t>(kUsualShare * static_cast<double>(least_s.size() - 1));
  std::nth_element(least_s.begin(), usual, least_s.end());
  return std::clamp(*usual, kShortestScan_s, kLongestScan_s);
}

bool LogSurvey::knows_enough() const {
  return scans_.records >= kMostScans || (scans_.records >= kScans && places_ >= kPlaces && !stamps_are_coarse());
}

LogTraits LogSurvey::traits() const {
  LogTraits traits;
  if (places_ >= kPlaces && static_cast<double>(as_far_) >= kLeastShare * static_cast<double>(scans_.records)) {
    traits.reach_m = farthest_m_;
  }
  traits.raw_scans_repeat = raw_scans_ > 0 && scans_.first;
  traits.scan_poses_stand = scans_.first && !scans_.moved && odometry_.moved;
  traits.odometry_period_s = odometry_.period_s();
  traits.scan_period_s = scans_.period_s();
  if (stamps_are_coarse()) {
    traits.invented_period_s = plausible_period_s();
    traits.records_per_scan =
        static_cast<double>(scans_.records + odometry_.records) / static_cast<double>(scans_.records);
  }
  return traits;
}

}  // namespace seeker::drivers
