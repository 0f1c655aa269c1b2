#include "server/drivers/rplidar/revolution_collector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace seeker::drivers {
namespace {

/// Corrections for short distances turn the bearing of a sample back by up to 8 degrees against the one before.
constexpr double kMaxBack_rad = deg_to_rad(15.0);
/// Between samples that follow each other nothing was lost; slow devices with fast rotors turn a few degrees.
constexpr double kMaxStep_rad = deg_to_rad(5.0);
/// Two successive returns come from one surface if it is seen at less than this angle from its normal, or if their
/// ranges differ by no more than they are in error.
constexpr double kMaxIncidence_rad = deg_to_rad(70.0);
constexpr double kRangeErrorShare = 0.02;
/// A turn that took so much longer than the one before has a whole turn missing in it.
constexpr double kTooLong = 1.5;

}  // namespace

RevolutionCollector::RevolutionCollector(const RplidarParams& params) : params_(params) {
  const double beams = std::max(1.0, std::round(kTwoPi / params.angle_step_rad));
  step_rad_ = kTwoPi / beams;
  cells_.resize(std::min(static_cast<std::size_t>(beams), kMaxScanBeams));
}

void RevolutionCollector::restart() {
  first_.reset();
  usual_revolution_.reset();
}

std::optional<LaserScan> RevolutionCollector::add(const rplidar::PolarSample& sample, RobotTime measured) {
  const double from_back_rad = sample.angle_cw_rad + kPi;
  const Moment now{from_back_rad < kTwoPi ? from_back_rad : from_back_rad - kTwoPi, measured};
  if (!first_) {
    begin(now);
    put(sample, now.turned_rad);
    return std::nullopt;
  }
  const double ahead_rad = now.turned_rad - last_.turned_rad;
  if (ahead_rad > kTwoPi - kMaxBack_rad) {
    return std::nullopt;  // a bearing turned back over the seam: its turn is over
  }
  if (ahead_rad < -kMaxBack_rad) {
    std::optional<LaserScan> turn = finish();
    begin(now);
    put(sample, now.turned_rad);
    return turn;
  }
  seen_rad_ += std::clamp(ahead_rad, 0.0, kMaxStep_rad);
  if (ahead_rad > 0.0) {
    last_ = now;
  }
  put(sample, now.turned_rad);
  return std::nullopt;
}

void RevolutionCollector::begin(const Moment& first) {
  first_ = first;
  last_ = first;
  seen_rad_ = std::min(first.turned_rad, kMaxStep_rad);
  last_return_.reset();
  std::fill(cells_.begin(), cells_.end(), Cell{});
}

void RevolutionCollector::put(const rplidar::PolarSample& sample, double turned_rad) {
  const bool echo = static_cast<double>(sample.range_m) >= params_.range_min_m &&
                    static_cast<double>(sample.range_m) <= params_.range_max_m;
  // Beam 0 looks back, just left of the seam, and the beams go counter-clockwise; so does a scanner that hangs.
  const Seen seen{params_.upside_down ? turned_rad : kTwoPi - turned_rad, echo ? sample.range_m : kNoReturn,
                  echo ? sample.quality : std::uint8_t{0}};
  put_nearest(seen);
  if (echo && last_return_) {
    join(*last_return_, seen);
  }
  last_return_ = echo ? std::optional(seen) : std::nullopt;
}

void RevolutionCollector::put_nearest(const Seen& seen) {
  const double place = seen.along_rad / step_rad_;
  const auto at = std::min(static_cast<std::size_t>(place), cells_.size() - 1);
  const double off_centre_rad = std::abs(place - static_cast<double>(at) - 0.5) * step_rad_;
  if (off_centre_rad < cells_[at].off_centre_rad) {
    cells_[at] = {seen.range_m, seen.quality, off_centre_rad};
  }
}

void RevolutionCollector::join(const Seen& one, const Seen& other) {
  const auto& [right, left] =
      std::minmax(one, other, [](const Seen& a, const Seen& b) { return a.along_rad < b.along_rad; });
  const double gap_rad = left.along_rad - right.along_rad;
  const double nearer_m = std::min(right.range_m, left.range_m);
  const double most_m = nearer_m * std::max(kRangeErrorShare, std::tan(kMaxIncidence_rad) * gap_rad);
  if (gap_rad <= 0.0 || gap_rad > kMaxStep_rad || std::abs(left.range_m - right.range_m) > most_m) {
    return;
  }
  const double first = std::ceil(right.along_rad / step_rad_ - 0.5);
  const double last = std::floor(left.along_rad / step_rad_ - 0.5);
  const Point2 right_end(right.range_m, 0.0);
  const Point2 left_end(left.range_m * std::cos(gap_rad), left.range_m * std::sin(gap_rad));
  for (double beam = first; beam <= last; ++beam) {
    const double from_right_rad = (beam + 0.5) * step_rad_ - right.along_rad;
    const double range_m = range_on_line_m(right_end, left_end, from_right_rad);
    cells_[static_cast<std::size_t>(beam)] = {static_cast<float>(range_m), std::min(right.quality, left.quality), 0.0};
  }
}

std::optional<LaserScan> RevolutionCollector::finish() {
  const double turned_rad = last_.turned_rad - first_->turned_rad;
  if (seen_rad_ < params_.least_revolution_share * kTwoPi || !(turned_rad > 0.0)) {
    return std::nullopt;
  }
  const Duration turn = seconds(to_seconds(last_.time - first_->time) * kTwoPi / turned_rad);
  const std::optional<Duration> usual = std::exchange(usual_revolution_, turn);
  if (turn <= Duration::zero() || turn > kMaxSweep || (usual && to_seconds(turn) > kTooLong * to_seconds(*usual))) {
    return std::nullopt;
  }
  return to_scan();
}

LaserScan RevolutionCollector::to_scan() const {
  LaserScan scan;
  const double s_per_rad = to_seconds(last_.time - first_->time) / (last_.turned_rad - first_->turned_rad);
  scan.stamp = first_->time + seconds((kPi - first_->turned_rad) * s_per_rad);
  const Duration sweep = seconds((kTwoPi - step_rad_) * s_per_rad);
  scan.sweep = params_.upside_down ? sweep : -sweep;
  scan.angle_min_rad = -kPi + 0.5 * step_rad_;
  scan.angle_step_rad = step_rad_;
  scan.range_min_m = params_.range_min_m;
  scan.range_max_m = params_.range_max_m;
  scan.base_T_laser = params_.base_T_laser;
  scan.ranges_m.reserve(cells_.size());
  scan.quality.reserve(cells_.size());
  for (const Cell& cell : cells_) {
    scan.ranges_m.push_back(cell.range_m);
    scan.quality.push_back(cell.quality);
  }
  return scan;
}

}  // namespace seeker::drivers
