#include "server/slam/segment_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

using Segment = MapSegment;

constexpr double kBucket_m = 2.0;

/// Where segments lie, for look-ups by place. A segment is in every bucket that its length crosses.
class Buckets {
 public:
  void add(const Segment& segment, std::size_t index) {
    for (const std::int64_t key : keys(segment)) {
      std::vector<std::size_t>& bucket = buckets_[key];
      if (bucket.empty() || bucket.back() != index) {
        bucket.push_back(index);
      }
    }
  }
  /// Indices near the segment, rising, each once.
  [[nodiscard]] std::vector<std::size_t> near(const Segment& segment) const {
    std::vector<std::size_t> found;
    for (const std::int64_t key : keys(segment)) {
      for (std::int64_t dj = -1; dj <= 1; ++dj) {
        for (std::int64_t di = -1; di <= 1; ++di) {
          const auto bucket = buckets_.find(key + di * kColumn + dj);
          if (bucket != buckets_.end()) {
            found.insert(found.end(), bucket->second.begin(), bucket->second.end());
          }
        }
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  static constexpr std::int64_t kColumn = std::int64_t{1} << 32;

  [[nodiscard]] static std::int64_t key_of(const Point2& p) {
    return static_cast<std::int64_t>(std::floor(p.x() / kBucket_m)) * kColumn +
           static_cast<std::int64_t>(std::floor(p.y() / kBucket_m));
  }
  [[nodiscard]] static std::vector<std::int64_t> keys(const Segment& segment) {
    std::vector<std::int64_t> found;
    const int steps = static_cast<int>(std::ceil(segment.length_m / kBucket_m)) + 1;
    for (int k = 0; k <= steps; ++k) {
      const double x = segment.length_m * (static_cast<double>(k) / steps - 0.5);
      found.push_back(key_of(segment.map_T_segment * Point2(x, 0.0)));
    }
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  std::unordered_map<std::int64_t, std::vector<std::size_t>> buckets_;
};

double weight_of(const Segment& segment) { return segment.length_m * std::max<double>(1.0, segment.hits); }

/// Distance across the wall, or nothing when the two are not one.
std::optional<double> offset_between(const Segment& a, const Segment& b, const FusionParams& params) {
  const Pose2 a_T_b = inverse(a.map_T_segment) * b.map_T_segment;
  if (std::abs(a_T_b.theta_rad) > params.max_angle_rad) {
    return std::nullopt;
  }
  const Point2 left = a_T_b * Point2(-0.5 * b.length_m, 0.0);
  const Point2 right = a_T_b * Point2(0.5 * b.length_m, 0.0);
  const double half = 0.5 * a.length_m;
  // The gap is negative where they overlap.
  const double gap_right = left.x() - half;   // b lies to the right of a
  const double gap_left = -half - right.x();  // b lies to the left of a
  const double gap = std::max(gap_right, gap_left);
  const bool doorway = gap > 0.0 && (gap_right > 0.0 ? a.right_real && b.left_real : a.left_real && b.right_real);
  if (gap > params.max_gap_m || doorway) {
    return std::nullopt;
  }
  // Compared where they are nearest to each other: the middle of the overlap, or of the gap.
  const double x = 0.5 * (std::max(left.x(), -half) + std::min(right.x(), half));
  const double along = right.x() - left.x();
  const double y = along > 1e-6 ? left.y() + (right.y() - left.y()) * (x - left.x()) / along : left.y();
  return std::abs(y) <= params.max_offset_m ? std::optional(std::abs(y)) : std::nullopt;
}

/// `a` grows by `b`.
void absorb(Segment& a, const Segment& b) {
  const double share = weight_of(b) / std::max(1e-9, weight_of(a) + weight_of(b));
  const Pose2 a_T_b = inverse(a.map_T_segment) * b.map_T_segment;
  // The common line: mean direction, through the weighted mid-points.
  const Pose2 a_T_line{share * a_T_b.x_m, share * a_T_b.y_m, share * a_T_b.theta_rad};
  const Pose2 line_T_a = inverse(a_T_line);
  const Pose2 line_T_b = line_T_a * a_T_b;
  const double a_left = (line_T_a * Point2(-0.5 * a.length_m, 0.0)).x();
  const double a_right = (line_T_a * Point2(0.5 * a.length_m, 0.0)).x();
  const double b_left = (line_T_b * Point2(-0.5 * b.length_m, 0.0)).x();
  const double b_right = (line_T_b * Point2(0.5 * b.length_m, 0.0)).x();
  a.left_real = a_left <= b_left ? a.left_real : b.left_real;
  a.right_real = a_right >= b_right ? a.right_real : b.right_real;
  const double left = std::min(a_left, b_left);
  const double right = std::max(a_right, b_right);
  a.covariance = a.covariance.trace() <= b.covariance.trace() ? a.covariance : b.covariance;
  a.map_T_segment = a.map_T_segment * a_T_line * Pose2{0.5 * (left + right), 0.0, 0.0};
  a.length_m = right - left;
  a.hits += b.hits;
  a.created = std::min(a.created, b.created);
  a.last_seen = std::max(a.last_seen, b.last_seen);
}

}  // namespace

std::vector<Segment> fuse(std::vector<Segment> segments, const FusionParams& params) {
  std::sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) { return a.id < b.id; });
  std::vector<Segment> walls;
  Buckets buckets;
  for (const Segment& segment : segments) {
    std::size_t best = walls.size();
    double best_offset_m = params.max_offset_m;
    for (const std::size_t index : buckets.near(segment)) {
      const std::optional<double> offset_m = offset_between(walls[index], segment, params);
      if (offset_m && *offset_m <= best_offset_m) {
        best = index;
        best_offset_m = *offset_m;
      }
    }
    if (best == walls.size()) {
      walls.push_back(segment);
    } else {
      absorb(walls[best], segment);
    }
    buckets.add(walls[best], best);
  }
  return walls;
}

}  // namespace seeker::slam
