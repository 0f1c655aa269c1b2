#include "server/drivers/replay/replay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"

namespace seeker::drivers {
namespace {

/// Logs state the range of a beam without echo as the scanner's maximum, or a little less.
constexpr double kAtMaximum_m = 0.01;

/// FLASER states no angles. 180 degrees but for scanners known by their beams, as other readers of such logs take them.
double front_laser_view_rad(std::size_t beams) {
  struct Known {
    std::size_t beams;
    double view_deg;
  };
  constexpr std::array<Known, 5> kKnown{{{401, 100.0}, {541, 270.0}, {683, 240.0}, {1081, 270.0}, {0, 180.0}}};
  // Some loggers leave the last beam out.
  return deg_to_rad(std::find_if(kKnown.begin(), kKnown.end() - 1, [&](const Known& scanner) {
                      return beams == scanner.beams || beams + 1 == scanner.beams;
                    })->view_deg);
}

/// The signal quality of a beam with a usable range: as logged, or 1 where the log has none. Logs whose strengths are
/// shares of 1 are scaled to a byte.
std::uint8_t quality_of(const CarmenScan& scan, std::size_t beam, float strongest) {
  constexpr float kLargest = 255.0F;
  if (scan.strengths.empty()) {
    return 1;
  }
  const float scale = strongest <= 1.0F ? kLargest : 1.0F;
  return static_cast<std::uint8_t>(std::clamp(std::round(scale * scan.strengths[beam]), 1.0F, kLargest));
}

tl::unexpected<Error> refused() {
  return fail(Errc::kRefused,
              "this robot replays a log, which cannot be driven; use the simulator or hardware to move");
}

}  // namespace

LaserScan to_laser_scan(const CarmenScan& scan, const ReplayParams& params, RobotTime stamp) {
  LaserScan result;
  result.stamp = stamp;
  const std::size_t beams = scan.ranges_m.size();
  const std::size_t steps = beams % 2 == 1 && beams > 1 ? beams - 1 : std::max<std::size_t>(beams, 1);
  const bool configured = params.angle_step_rad != 0.0;
  const double view_rad = front_laser_view_rad(beams);
  const double first_rad = params.angle_min_rad - 0.5 * (view_rad - kPi);
  result.angle_min_rad = configured ? params.angle_min_rad : scan.angle_min_rad.value_or(first_rad);
  result.angle_step_rad =
      configured ? params.angle_step_rad : scan.angle_step_rad.value_or(view_rad / static_cast<double>(steps));
  result.range_min_m = params.range_min_m;
  result.range_max_m = std::min(params.range_max_m, scan.range_max_m.value_or(params.range_max_m));
  const double reach_m = scan.range_max_m ? result.range_max_m - kAtMaximum_m : result.range_max_m;
  result.base_T_laser = params.base_T_laser;
  result.ranges_m.reserve(beams);
  result.quality.reserve(beams);
  const float strongest =
      scan.strengths.empty() ? 0.0F : *std::max_element(scan.strengths.begin(), scan.strengths.end());
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const float range_m = scan.ranges_m[beam];
    const bool usable = range_m >= params.range_min_m;
    result.ranges_m.push_back(usable && range_m < reach_m ? range_m : kNoReturn);
    result.quality.push_back(usable ? quality_of(scan, beam, strongest) : std::uint8_t{0});
  }
  return result;
}

Result<std::shared_ptr<ReplaySource>> ReplaySource::open(const std::filesystem::path& path,
                                                         const ReplayParams& params) {
  auto reader = CarmenReader::open(path);
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  std::shared_ptr<ReplaySource> source(new ReplaySource(std::move(*reader), params));
  if (source->finished()) {
    return fail(Errc::kParse, path.string() + " holds no record of a CARMEN log or of scans with commas: " +
                                  describe(source->summary()));
  }
  return source;
}

ReplaySource::ReplaySource(CarmenReader reader, const ReplayParams& params)
    : reader_(std::move(reader)), params_(params) {
  fetch();
  if (pending_) {
    first_stamp_s_ = stamp_of(*pending_);
  }
}

RobotTime ReplaySource::robot_time_of(const CarmenRecord& record) const {
  return robot_time_s(stamp_of(record) - *first_stamp_s_);
}

void ReplaySource::advance_to(RobotTime now) {
  bool fresh_scan = false;
  while (pending_ && robot_time_of(*pending_) <= now) {
    const bool is_scan = std::holds_alternative<CarmenScan>(*pending_);
    if (is_scan && fresh_scan) {
      return;  // the next call begins with it
    }
    fresh_scan = fresh_scan || is_scan;
    now_ = std::max(now_, robot_time_of(*pending_));
    std::visit([this](const auto& record) { deliver(record); }, *pending_);
    fetch();
    if (is_scan && !scans_have_odometry_) {
      return;  // odometry measured after the scan is delivered after it
    }
  }
  now_ = std::max(now_, now);
}

bool ReplaySource::advance_one() {
  if (!pending_) {
    return false;
  }
  now_ = std::max(now_, robot_time_of(*pending_));
  std::visit([this](const auto& record) { deliver(record); }, *pending_);
  fetch();
  return true;
}

void ReplaySource::deliver(const CarmenOdometry& odometry) {
  if (!scans_have_odometry_) {
    deliver_pose(odometry.odom_T_base, robot_time_of(odometry));
  }
}

void ReplaySource::deliver(const CarmenScan& scan) {
  const RobotTime stamp = robot_time_of(scan);
  if (scan_) {
    reader_.note_overtaken();
  }
  scan_ = to_laser_scan(scan, params_, stamp);
  if (scan.odom_T_base) {
    scans_have_odometry_ = true;
    deliver_pose(*scan.odom_T_base, stamp);
  }
}

void ReplaySource::deliver_pose(const Pose2& odom_T_base, RobotTime stamp) {
  if (last_odometry_ && stamp <= last_odometry_->stamp) {
    return;
  }
  OdometrySample sample;
  sample.stamp = stamp;
  sample.odom_T_base = odom_T_base;
  if (last_odometry_) {
    const double dt_s = to_seconds(stamp - last_odometry_->stamp);
    const Pose2 step = inverse(last_odometry_->odom_T_base) * odom_T_base;
    sample.velocity = {std::copysign(std::hypot(step.x_m, step.y_m), step.x_m) / dt_s, step.theta_rad / dt_s};
  }
  odometry_ = sample;
  last_odometry_ = sample;
}

std::optional<OdometrySample> ReplaySource::take_odometry() { return std::exchange(odometry_, std::nullopt); }

std::optional<LaserScan> ReplaySource::take_scan() { return std::exchange(scan_, std::nullopt); }

ReplayClock::ReplayClock(std::shared_ptr<ReplaySource> source, double speed)
    : source_(std::move(source)), pacer_(speed) {}

Status ReplayClock::advance(Duration period) {
  if (source_->finished()) {
    return fail(Errc::kCancelled, "the replay has ended: " + describe(source_->summary()));
  }
  const RobotTime before = source_->now();
  source_->advance_to(before + period);
  pacer_.start(source_->now() - before);
  return {};
}

Status ReplayBase::set_velocity(const Twist2& velocity, RobotTime /*now*/) {
  return velocity == Twist2{} ? Status{} : Status(refused());
}

Status ReplayBase::drivable() const { return refused(); }

Status ReplayBase::set_motors(bool enabled) { return enabled ? Status(refused()) : Status{}; }

}  // namespace seeker::drivers
