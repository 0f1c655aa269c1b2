#include "server/slam/local_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"

namespace seeker::slam {
namespace {

/// How far two views differ: metres, with a radian of heading counting as much as this.
constexpr double kRotationAsMetres = 0.7;

double rotation_between(const Pose2& a, const Pose2& b) { return std::abs(wrap_angle(a.theta_rad - b.theta_rad)); }

}  // namespace

bool moved(const Pose2& from, const Pose2& to, double distance_limit_m, double rotation_limit_rad) {
  return distance_m(from, to) > distance_limit_m || rotation_between(from, to) > rotation_limit_rad;
}

void LocalCloud::clear() {
  keyframes_.clear();
  reference_.reset();
}

bool LocalCloud::needs_keyframe(const Pose2& map_T_base, double known) const {
  const bool shows_new = known < params_.known_share;
  const double distance_m = shows_new ? params_.new_view_distance_m : params_.keyframe_distance_m;
  const double rotation_rad = shows_new ? params_.new_view_rotation_rad : params_.keyframe_rotation_rad;
  return std::none_of(keyframes_.begin(), keyframes_.end(), [&](const Keyframe& keyframe) {
    return !moved(keyframe.map_T_base, map_T_base, distance_m, rotation_rad);
  });
}

void LocalCloud::add(const Pose2& map_T_base, const std::vector<OrientedPoint>& points_base) {
  Keyframe keyframe{map_T_base, thin_out(points_base, params_.keyframe_points)};
  for (OrientedPoint& point : keyframe.points_map) {
    point = transform(map_T_base, point);
  }
  if (keyframes_.size() >= params_.max_keyframes) {
    keyframes_.erase(keyframes_.begin());
  }
  keyframes_.push_back(std::move(keyframe));
  choose(map_T_base);
}

const ReferenceCloud& LocalCloud::around(const Pose2& map_T_base) {
  SEEKER_ASSERT(!keyframes_.empty());
  if (!reference_ || moved(reference_pose_, map_T_base, params_.rebuild_m, params_.rebuild_rad)) {
    choose(map_T_base);
  }
  return *reference_;
}

std::vector<std::pair<double, const LocalCloud::Keyframe*>> LocalCloud::nearest_first(const Pose2& map_T_base) const {
  std::vector<std::pair<double, const Keyframe*>> near;
  for (const Keyframe& keyframe : keyframes_) {
    const double d = distance_m(keyframe.map_T_base, map_T_base);
    if (d <= params_.local_range_m) {
      near.emplace_back(d + kRotationAsMetres * rotation_between(keyframe.map_T_base, map_T_base), &keyframe);
    }
  }
  std::sort(near.begin(), near.end());
  return near;
}

void LocalCloud::choose(const Pose2& map_T_base) {
  std::vector<OrientedPoint> points;
  const auto near = nearest_first(map_T_base);
  for (std::size_t k = 0; k < std::min(near.size(), params_.local_keyframes); ++k) {
    points.insert(points.end(), near[k].second->points_map.begin(), near[k].second->points_map.end());
  }
  reference_ = std::make_unique<ReferenceCloud>(std::move(points));
  reference_pose_ = map_T_base;
}

void LocalCloud::move_to(const Pose2& new_T_old, const Pose2& new_T_base, std::size_t limit) {
  for (Keyframe& keyframe : keyframes_) {
    keyframe.map_T_base = new_T_old * keyframe.map_T_base;
    for (OrientedPoint& point : keyframe.points_map) {
      point = transform(new_T_old, point);
    }
  }
  std::vector<Keyframe> kept;
  for (const auto& [difference, keyframe] : nearest_first(new_T_base)) {
    if (kept.size() == limit) {
      break;
    }
    kept.push_back(*keyframe);
  }
  keyframes_ = std::move(kept);
  if (!keyframes_.empty()) {
    choose(new_T_base);
  }
}

}  // namespace seeker::slam
