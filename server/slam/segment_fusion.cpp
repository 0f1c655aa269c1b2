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

/// A bucket's number: neighbours along x differ by kColumn, along y by 1.
constexpr std::int64_t kColumn = std::int64_t{1} << 32;

/// Buckets that a segment's length crosses.
void find_keys(const Segment& segment, std::vector<std::int64_t>& keys) {
  keys.clear();
  const Point2 middle = segment.map_T_segment.translation();
  const Point2 along(std::cos(segment.map_T_segment.theta_rad), std::sin(segment.map_T_segment.theta_rad));
  const int steps = static_cast<int>(std::ceil(segment.length_m / kBucket_m)) + 1;
  for (int k = 0; k <= steps; ++k) {
    const Point2 p = middle + segment.length_m * (static_cast<double>(k) / steps - 0.5) * along;
    const std::int64_t key = static_cast<std::int64_t>(std::floor(p.x() / kBucket_m)) * kColumn +
                             static_cast<std::int64_t>(std::floor(p.y() / kBucket_m));
    if (keys.empty() || keys.back() != key) {
      keys.push_back(key);
    }
  }
}

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

/// The walls found so far, in buckets of the places that they cross.
class Walls {
 public:
  explicit Walls(const FusionParams& params) : params_(params) {}

  /// The wall that the segment is a piece of; nothing when it is the first of its wall.
  [[nodiscard]] std::optional<std::size_t> wall_of(const Segment& segment) {
    std::optional<std::size_t> best;
    double best_offset_m = params_.max_offset_m;
    find_near(segment);
    for (const std::size_t index : near_) {
      const std::optional<double> offset_m = offset_between(walls_[index], segment, params_);
      if (offset_m && *offset_m <= best_offset_m) {
        best = index;
        best_offset_m = *offset_m;
      }
    }
    return best;
  }
  void add(const Segment& segment) {
    walls_.push_back(segment);
    looks_.emplace_back();
    note(walls_.size() - 1);
  }
  void grow(std::size_t index, const Segment& segment) {
    absorb(walls_[index], segment);
    note(index);
  }
  [[nodiscard]] std::vector<Segment> take() { return std::move(walls_); }

 private:
  /// What a wall is passed over by, before anything is computed exactly: in a large building nearly all are.
  struct Look {
    double theta_rad = 0.0;
    Point2 middle = Point2::Zero();
    Point2 across = Point2::Zero();
    std::uint64_t asked = 0;  ///< the question that came by last
  };

  void note(std::size_t index) {
    const Pose2& pose = walls_[index].map_T_segment;
    Look& look = looks_[index];
    look.theta_rad = pose.theta_rad;
    look.middle = pose.translation();
    look.across = {-std::sin(pose.theta_rad), std::cos(pose.theta_rad)};
    find_keys(walls_[index], keys_);
    for (const std::int64_t key : keys_) {
      std::vector<std::size_t>& bucket = buckets_[key];
      if (std::find(bucket.begin(), bucket.end(), index) == bucket.end()) {
        bucket.push_back(index);
      }
    }
  }

  /// To near_: rising, each once.
  void find_near(const Segment& segment) {
    ++asked_;
    near_.clear();
    find_keys(segment, keys_);
    for (const std::int64_t key : keys_) {
      for (std::int64_t dj = -1; dj <= 1; ++dj) {
        for (std::int64_t di = -1; di <= 1; ++di) {
          const auto bucket = buckets_.find(key + di * kColumn + dj);
          if (bucket != buckets_.end()) {
            pick(bucket->second, segment);
          }
        }
      }
    }
    std::sort(near_.begin(), near_.end());
  }

  void pick(const std::vector<std::size_t>& bucket, const Segment& segment) {
    constexpr double kSlack = 1e-6;
    // Somewhere along the segment it must come within the offset; its ends lie this far to the side of its middle.
    const double aside_m =
        params_.max_offset_m +
        (0.5 * segment.length_m + params_.max_gap_m) * std::sin(std::min(params_.max_angle_rad, kPi / 2.0)) + kSlack;
    for (const std::size_t index : bucket) {
      Look& look = looks_[index];
      if (look.asked == asked_) {
        continue;
      }
      look.asked = asked_;
      const double rotation_rad = std::abs(segment.map_T_segment.theta_rad - look.theta_rad);
      const bool parallel = rotation_rad <= params_.max_angle_rad + kSlack ||
                            std::abs(rotation_rad - kTwoPi) <= params_.max_angle_rad + kSlack;
      const double off_m = look.across.dot(segment.map_T_segment.translation() - look.middle);
      if (parallel && std::abs(off_m) <= aside_m) {
        near_.push_back(index);
      }
    }
  }

  FusionParams params_;
  std::vector<Segment> walls_;
  std::vector<Look> looks_;  ///< of walls_
  std::unordered_map<std::int64_t, std::vector<std::size_t>> buckets_;
  std::uint64_t asked_ = 0;
  std::vector<std::int64_t> keys_;
  std::vector<std::size_t> near_;
};

}  // namespace

std::vector<Segment> fuse(std::vector<Segment> segments, const FusionParams& params) {
  std::sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) { return a.id < b.id; });
  Walls walls(params);
  for (const Segment& segment : segments) {
    if (const std::optional<std::size_t> wall = walls.wall_of(segment)) {
      walls.grow(*wall, segment);
    } else {
      walls.add(segment);
    }
  }
  return walls.take();
}

}  // namespace seeker::slam
