#include "server/lines/five_modes.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::lines {

std::vector<Indices> FiveModes::run(std::size_t first, std::size_t last) {
  next_ = first;
  end_ = last + 1;
  LineMode mode = LineMode::kContinuousLine;
  // Every mode takes a point or ends what it was at; Split comes last.
  while (mode != LineMode::kSplit || next_ < end_) {
    switch (mode) {
      case LineMode::kContinuousLine: mode = continuous_line(); break;
      case LineMode::kSegmentConfirm: mode = segment_confirm(); break;
      case LineMode::kExpand: mode = expand(); break;
      case LineMode::kCorner: mode = corner(); break;
      case LineMode::kSplit: mode = split(); break;
    }
  }
  close();
  return std::move(segments_);
}

bool FiveModes::is_gap(std::size_t i) const {
  const double spacing_m = limits_.spacing_rad * std::min(row_.polar[i].range_m, row_.polar[i - 1].range_m);
  return row_.gap_m(i) > std::max(limits_.thresholds.gap_m, spacing_m);
}

double FiveModes::distance_m(std::size_t i) const { return fit_.distance_m(row_.points[i].x(), row_.points[i].y()); }

/// Collects a seed of neighbours.
LineMode FiveModes::continuous_line() {
  while (segment_.size() < static_cast<std::size_t>(std::max(params_.seed_points, 2))) {
    if (next_ == end_ || (!segment_.empty() && is_gap(next_))) {
      return LineMode::kSplit;
    }
    segment_.push_back(next_++);
  }
  return LineMode::kSegmentConfirm;
}

/// A seed that fits becomes a line, else it moves on by a point.
LineMode FiveModes::segment_confirm() {
  fit_ = fit_points(row_, segment_);
  if (std::sqrt(fit_.mean_square_m2) > limits_.max_fit_error_m) {
    segment_.erase(segment_.begin());
    return LineMode::kContinuousLine;
  }
  confirmed_ = true;
  sums_ = {};
  for (const std::size_t i : segment_) {
    sums_.add(row_.points[i].x(), row_.points[i].y(), row_.polar[i].weight);
  }
  return LineMode::kExpand;
}

LineMode FiveModes::expand() {
  if (next_ == end_ || is_gap(next_)) {
    return LineMode::kSplit;
  }
  if (std::abs(distance_m(next_)) > limits_.thresholds.corner_m) {
    return LineMode::kCorner;
  }
  sums_.add(row_.points[next_].x(), row_.points[next_].y(), row_.polar[next_].weight);
  fit_ = fit_line(sums_);
  segment_.push_back(next_++);
  return LineMode::kExpand;
}

/// The point is off the line: a corner, or an outlier when the line goes on behind it.
LineMode FiveModes::corner() {
  const double side = distance_m(next_);
  int on_line = 0;
  int looked_at = 0;
  for (std::size_t i = next_ + 1; i < end_ && looked_at < params_.look_ahead && !is_gap(i); ++i, ++looked_at) {
    const double distance = distance_m(i);
    const bool off = std::abs(distance) > limits_.thresholds.corner_m && distance * side > 0.0;
    on_line += off ? 0 : 1;
  }
  if (looked_at > 0 && on_line == looked_at) {
    ++next_;
    return LineMode::kExpand;
  }
  const std::size_t corner = segment_.back();
  close();
  segment_ = {corner};
  return LineMode::kContinuousLine;
}

/// A gap, or the end of the packet.
LineMode FiveModes::split() {
  close();
  return LineMode::kContinuousLine;
}

void FiveModes::close() {
  if (confirmed_) {
    segments_.push_back(segment_);
  }
  confirmed_ = false;
  segment_.clear();
}

}  // namespace seeker::lines
