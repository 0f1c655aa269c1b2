#include "server/drivers/lms200/scan_clock.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace seeker::drivers {
namespace {

/// Part of a scan's time by which an arrival may lie below the line and still lower it.
constexpr double kEarlyScans = 0.25;
/// Part of a scan's time over which every recent arrival lies if the device changed its phase.
constexpr double kLateScans = 0.5;

/// A distance is nearly a multiple of a step if it differs by less than both: a part of the step, and scans.
constexpr double kNearStep = 0.25;
constexpr double kNearScans = 0.8;
/// Telegrams are never farther apart: the longest one needs 64 of the shortest scans at 9600 baud.
constexpr std::int64_t kLongestStep = 100;

/// The step, at least 1, of which most distances, in scans, are nearly multiples; of several such the largest.
std::int64_t common_step(const std::vector<double>& apart) {
  std::int64_t best = 1;
  std::ptrdiff_t most = 0;
  for (std::int64_t step = 1; step <= kLongestStep; ++step) {
    const auto length = static_cast<double>(step);
    const double near = std::min(kNearStep * length, kNearScans);
    const auto fitting = std::count_if(apart.begin(), apart.end(), [&](double distance) {
      return distance > length / 2.0 && std::abs(std::remainder(distance, length)) < near;
    });
    if (fitting >= most) {
      most = fitting;
      best = step;
    }
  }
  return best;
}

}  // namespace

void ScanClock::reset() {
  points_.clear();
  scans_apart_ = 0;
}

void ScanClock::begin_with(RobotTime arrival) {
  reset();
  origin_ = arrival;
  points_.push_back({});
}

RobotTime ScanClock::place(RobotTime arrival) {
  if (points_.empty()) {
    begin_with(arrival);
    return arrival;
  }
  const double arrival_s = to_seconds(arrival - origin_);
  if (!distance_known()) {
    points_.push_back({0.0, arrival_s});
    if (points_.size() < params_.learning) {
      return arrival;
    }
    learn();
  } else {
    points_.push_back({next_device_s(arrival_s), arrival_s});
    if (phase_changed()) {
      begin_with(arrival);
      return arrival;
    }
    if (points_.size() > params_.window) {
      points_.pop_front();
    }
  }
  line_ = lower_line();
  return std::min(arrival, origin_ + seconds(line_.at(points_.back().device_s)));
}

void ScanClock::learn() {
  std::vector<double> apart;
  apart.reserve(points_.size());
  for (std::size_t i = 1; i < points_.size(); ++i) {
    apart.push_back((points_[i].arrival_s - points_[i - 1].arrival_s) / params_.period_s);
  }
  scans_apart_ = common_step(apart);
  number_points(static_cast<double>(scans_apart_) * params_.period_s);
}

void ScanClock::number_points(double step_s) {
  // Counted from the arrival that was delayed least: from any other one, an undelayed arrival could seem early by more
  // than half a step.
  double least_s = 0.0;
  for (const Point& point : points_) {
    const double delay_s = point.arrival_s - std::round(point.arrival_s / step_s) * step_s;
    least_s = std::min(least_s, delay_s);
  }
  double device_s = -step_s;
  for (Point& point : points_) {
    const double early_s = kEarlyScans * params_.period_s;
    const double counted_s = std::floor((point.arrival_s - least_s + early_s) / step_s) * step_s;
    device_s = std::max(counted_s, device_s + step_s);
    point.device_s = device_s;
  }
}

double ScanClock::next_device_s(double arrival_s) const {
  const double step_s = static_cast<double>(scans_apart_) * params_.period_s;
  const double last_s = points_.back().device_s;
  // Telegrams come late and never early: what is nearly the next step but one is the next one.
  const double early_s = kEarlyScans * params_.period_s;
  const double steps = std::floor((arrival_s - line_.at(last_s) + early_s) / step_s);
  return last_s + std::max(steps, 1.0) * step_s;
}

bool ScanClock::phase_changed() const {
  const Point& newest = points_.back();
  if (newest.arrival_s - line_.at(newest.device_s) < -kEarlyScans * params_.period_s) {
    return true;
  }
  if (points_.size() < params_.learning) {
    return false;
  }
  return std::all_of(points_.end() - static_cast<std::ptrdiff_t>(params_.learning), points_.end(), [&](const Point& p) {
    return p.arrival_s - line_.at(p.device_s) > kLateScans * params_.period_s;
  });
}

double ScanClock::hull_slope(double mean_device_s) const {
  std::vector<Point> hull;
  hull.reserve(points_.size());
  const auto above_chord = [](const Point& a, const Point& b, const Point& c) {
    return (b.device_s - a.device_s) * (c.arrival_s - a.arrival_s) <=
           (c.device_s - a.device_s) * (b.arrival_s - a.arrival_s);
  };
  for (const Point& point : points_) {
    while (hull.size() >= 2 && above_chord(hull[hull.size() - 2], hull.back(), point)) {
      hull.pop_back();
    }
    hull.push_back(point);
  }
  std::size_t end = 1;
  while (end + 1 < hull.size() && hull[end].device_s < mean_device_s) {
    ++end;
  }
  return (hull[end].arrival_s - hull[end - 1].arrival_s) / (hull[end].device_s - hull[end - 1].device_s);
}

ScanClock::Line ScanClock::lower_line() const {
  double sum_s = 0.0;
  for (const Point& point : points_) {
    sum_s += point.device_s;
  }
  const auto count = static_cast<double>(points_.size());
  // Few arrivals say little about the slope, and their delays would be taken for it.
  const double free = params_.tolerance * std::min(1.0, count / static_cast<double>(params_.free_slope));
  Line line;
  line.slope = std::clamp(hull_slope(sum_s / count), 1.0 - free, 1.0 + free);
  line.at_zero_s = std::numeric_limits<double>::infinity();
  for (const Point& point : points_) {
    line.at_zero_s = std::min(line.at_zero_s, point.arrival_s - line.slope * point.device_s);
  }
  return line;
}

}  // namespace seeker::drivers
