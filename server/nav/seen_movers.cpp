#include "server/nav/seen_movers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace seeker::nav {
namespace {

/// Points of one body lie no farther from one beam to the next.
constexpr double kGap_m = 0.15;
constexpr double kMinRadius_m = 0.08;
constexpr double kMaxRadius_m = 0.4;
constexpr std::size_t kMinBeams = 4;
/// What is beside a body lies behind it by so much, else it may be a part of a wall.
constexpr double kBehind_m = 0.3;
/// The middle of the points that one sees of a disc lies so far before its centre: half of a circle's mean depth.
constexpr double kDepth = 0.7;
/// From one scan to the next a body moves by no more.
constexpr double kSameBody_m = 0.25;
constexpr double kFollowed_s = 0.6;
/// Nothing is said of one that was followed for a shorter time, or has been out of sight for a longer one.
constexpr double kLeast_s = 0.35;
constexpr double kLost_s = 0.3;
/// Slower ones may be pillars whose other side comes into sight; faster ones are two bodies taken for one.
constexpr double kSlowest_m_s = 0.25;
constexpr double kFastest_m_s = 2.0;
/// Half way through, an even drive was half way along.
constexpr double kUneven_m = 0.05;
constexpr double kSlack_m = 0.05;

/// A run of beams [first, last].
std::optional<FreeBody> body_of(const LaserScan& scan, std::size_t first, std::size_t last) {
  if (first == 0 || last + 1 >= scan.ranges_m.size() || last + 1 - first < kMinBeams) {
    return std::nullopt;
  }
  const auto point = [&](std::size_t beam) {
    const double angle_rad = scan.angle_rad(beam);
    return Point2(scan.ranges_m[beam] * Point2(std::cos(angle_rad), std::sin(angle_rad)));
  };
  const double radius_m = 0.5 * (point(last) - point(first)).norm();
  const bool before = scan.ranges_m[first - 1] > scan.ranges_m[first] + kBehind_m &&
                      scan.ranges_m[last + 1] > scan.ranges_m[last] + kBehind_m;
  if (!before || radius_m < kMinRadius_m || radius_m > kMaxRadius_m) {
    return std::nullopt;
  }
  Point2 sum = Point2::Zero();
  for (std::size_t beam = first; beam <= last; ++beam) {
    sum += point(beam);
  }
  const Point2 middle = sum / static_cast<double>(last + 1 - first);
  return FreeBody{scan.base_T_laser * Point2(middle + kDepth * radius_m * middle.normalized()), radius_m};
}

bool usable(const LaserScan& scan, std::size_t beam) {
  return std::isfinite(scan.ranges_m[beam]) && scan.ranges_m[beam] > 0.0F &&
         (scan.quality.empty() || scan.quality[beam] > 0);
}

}  // namespace

std::vector<FreeBody> free_bodies(const LaserScan& scan) {
  std::vector<FreeBody> bodies;
  std::size_t first = 0;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const bool goes_on = beam + 1 < scan.ranges_m.size() && usable(scan, beam) && usable(scan, beam + 1) &&
                         std::abs(scan.ranges_m[beam + 1] - scan.ranges_m[beam]) < kGap_m;
    if (!goes_on) {
      const auto body = usable(scan, beam) ? body_of(scan, first, beam) : std::nullopt;
      if (body) {
        bodies.push_back(*body);
      }
      first = beam + 1;
    }
  }
  return bodies;
}

void SeenMovers::look(const LaserScan& scan, const Pose2& odom_T_base, RobotTime now) {
  for (const FreeBody& body : free_bodies(scan)) {
    const Point2 p_odom = odom_T_base * body.centre;
    Track* nearest = nullptr;
    double nearest_m = kSameBody_m;
    for (Track& track : tracks_) {
      const double d_m = (track.seen.back().p_odom - p_odom).norm();
      if (track.seen.back().at < now && d_m < nearest_m) {
        nearest = &track;
        nearest_m = d_m;
      }
    }
    if (nearest == nullptr) {
      nearest = &tracks_.emplace_back();
    }
    nearest->seen.push_back({now, p_odom});
    nearest->radius_m = body.radius_m;
  }
  for (Track& track : tracks_) {
    while (to_seconds(now - track.seen.front().at) > kFollowed_s && track.seen.size() > 1) {
      track.seen.pop_front();
    }
  }
  std::erase_if(tracks_, [now](const Track& track) { return to_seconds(now - track.seen.back().at) > kLost_s; });
}

std::vector<Mover> SeenMovers::movers_base(const Pose2& odom_T_base, RobotTime now) const {
  std::vector<Mover> movers;
  for (const Track& track : tracks_) {
    const Seen& from = track.seen.front();
    const Seen& to = track.seen.back();
    const double time_s = to_seconds(to.at - from.at);
    if (time_s < kLeast_s || to_seconds(now - to.at) > kLost_s) {
      continue;
    }
    const Point2 velocity = (to.p_odom - from.p_odom) / time_s;
    const bool even = std::all_of(track.seen.begin(), track.seen.end(), [&](const Seen& seen) {
      return (from.p_odom + to_seconds(seen.at - from.at) * velocity - seen.p_odom).norm() < kUneven_m;
    });
    if (even && velocity.norm() >= kSlowest_m_s && velocity.norm() <= kFastest_m_s) {
      const Point2 p_odom = to.p_odom + to_seconds(now - to.at) * velocity;
      const Pose2 odom_T_mover{p_odom.x(), p_odom.y(), std::atan2(velocity.y(), velocity.x())};
      movers.push_back({inverse(odom_T_base) * odom_T_mover, {velocity.norm(), 0.0}, track.radius_m, kSlack_m});
    }
  }
  return movers;
}

}  // namespace seeker::nav
