#include "server/nav/seen_movers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/core/angle.hpp"

namespace seeker::nav {
namespace {

/// Points of one body lie no farther from one beam to the next.
constexpr double kGap_m = 0.15;
/// A beam between them may be lost.
constexpr std::size_t kNextBeams = 2;
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
/// One that has driven is taken for one that may drive on for so long, and looked for where it was for so long.
constexpr double kRests_s = 10.0;
constexpr double kLookedFor_s = 1.0;
/// Slower ones may be pillars whose other side comes into sight; faster ones are two bodies taken for one.
constexpr double kSlowest_m_s = 0.25;
constexpr double kFastest_m_s = 2.0;
/// At half of the time an even drive has covered half of the distance, to within this.
constexpr double kUneven_m = 0.05;
constexpr double kSlack_m = 0.1;
/// A beam that ends so far behind a point passed it; half of what the slowest body moves by while it is followed.
constexpr double kThrough_m = 0.06;
/// So many of the points seen of a body lie where nothing was before or is now, if it drives across the view; all do if
/// it drives along it.
constexpr double kThroughShare = 0.2;
constexpr std::size_t kThroughPoints = 3;

bool usable(const LaserScan& scan, std::size_t beam) {
  return std::isfinite(scan.ranges_m[beam]) && scan.ranges_m[beam] > 0.0F &&
         (scan.quality.empty() || scan.quality[beam] > 0);
}

/// The next beam that ends at the same body.
std::optional<std::size_t> next_on_body(const LaserScan& scan, std::size_t beam) {
  for (std::size_t next = beam + 1; next <= beam + kNextBeams && next < scan.ranges_m.size(); ++next) {
    if (usable(scan, next) && std::abs(scan.ranges_m[next] - scan.ranges_m[beam]) < kGap_m) {
      return next;
    }
  }
  return std::nullopt;
}

/// The body of beams that end at one object, in their order.
std::optional<FreeBody> body_of(const LaserScan& scan, const std::vector<std::size_t>& beams) {
  const std::size_t first = beams.front();
  const std::size_t last = beams.back();
  if (first == 0 || last + 1 >= scan.ranges_m.size() || beams.size() < kMinBeams) {
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
  FreeBody body{Point2::Zero(), radius_m, {}};
  for (const std::size_t beam : beams) {
    sum += point(beam);
    body.surface.push_back(scan.base_T_laser * point(beam));
  }
  const Point2 middle = sum / static_cast<double>(beams.size());
  body.centre = scan.base_T_laser * Point2(middle + kDepth * radius_m * middle.normalized());
  return body;
}

FreeBody moved(FreeBody body, const Pose2& new_T_old) {
  body.centre = new_T_old * body.centre;
  for (Point2& p : body.surface) {
    p = new_T_old * p;
  }
  return body;
}

}  // namespace

std::vector<FreeBody> free_bodies(const LaserScan& scan) {
  std::vector<FreeBody> bodies;
  for (std::size_t first = 0; first < scan.ranges_m.size();) {
    std::vector<std::size_t> beams{first};
    while (const std::optional<std::size_t> next = next_on_body(scan, beams.back())) {
      beams.push_back(*next);
    }
    const auto body = usable(scan, first) ? body_of(scan, beams) : std::nullopt;
    if (body) {
      bodies.push_back(*body);
    }
    first = beams.back() + 1;
  }
  return bodies;
}

bool ScanAt::sees_through(const Point2& p_odom) const {
  const Point2 p_laser = inverse(odom_T_base * scan.base_T_laser) * p_odom;
  const double middle = 0.5 * (static_cast<double>(scan.ranges_m.size()) - 1.0);
  const double middle_rad = scan.angle_min_rad + middle * scan.angle_step_rad;
  const double beam = middle + wrap_angle(std::atan2(p_laser.y(), p_laser.x()) - middle_rad) / scan.angle_step_rad;
  if (beam < 0.0 || beam >= 2.0 * middle) {
    return false;
  }
  const auto before = static_cast<std::size_t>(beam);
  const auto passes = [&](std::size_t i) {
    return scan.ranges_m[i] > p_laser.norm() + kThrough_m && (scan.quality.empty() || scan.quality[i] > 0);
  };
  return passes(before) && passes(before + 1);
}

void SeenMovers::follow(FreeBody body_odom, RobotTime now) {
  Track* nearest = nullptr;
  double nearest_m = kSameBody_m;
  for (Track& track : tracks_) {
    const double d_m = (track.seen.back().body_odom.centre - body_odom.centre).norm();
    if (track.seen.back().at < now && d_m < nearest_m) {
      nearest = &track;
      nearest_m = d_m;
    }
  }
  if (nearest == nullptr) {
    nearest = &tracks_.emplace_back();
  }
  nearest->radius_m = std::max(nearest->radius_m, body_odom.radius_m);
  nearest->seen.push_back({now, std::move(body_odom)});
}

void SeenMovers::look(const LaserScan& scan, const Pose2& odom_T_base, RobotTime now) {
  scans_.insert_or_assign(now, ScanAt{odom_T_base, scan});
  scans_.erase(scans_.begin(), scans_.lower_bound(now - seconds(kFollowed_s)));
  for (FreeBody& body : free_bodies(scan)) {
    follow(moved(std::move(body), odom_T_base), now);
  }
  for (Track& track : tracks_) {
    while (to_seconds(now - track.seen.front().at) > kFollowed_s && track.seen.size() > 1) {
      track.seen.pop_front();
    }
    if (track.seen.back().at == now && track.seems_to_drive() && leaves_or_takes_free_space(track)) {
      track.drove_at = now;
    }
  }
  std::erase_if(tracks_, [now](const Track& track) {
    return to_seconds(now - track.seen.back().at) > (track.drove_at ? kLookedFor_s : kLost_s);
  });
}

bool SeenMovers::leaves_or_takes_free_space(const Track& track) const {
  const auto seen_through = [this](const FreeBody& body_odom, RobotTime at) {
    const auto scan = scans_.find(at);
    return scan == scans_.end() ? 0
                                : std::count_if(body_odom.surface.begin(), body_odom.surface.end(),
                                                [&](const Point2& p) { return scan->second.sees_through(p); });
  };
  const Seen& then = track.seen.front();
  const Seen& now = track.seen.back();
  const auto free =
      static_cast<std::size_t>(seen_through(then.body_odom, now.at) + seen_through(now.body_odom, then.at));
  const std::size_t all = then.body_odom.surface.size() + now.body_odom.surface.size();
  return free >= kThroughPoints && static_cast<double>(free) >= kThroughShare * static_cast<double>(all);
}

Point2 SeenMovers::Track::velocity_odom() const {
  const double time_s = to_seconds(seen.back().at - seen.front().at);
  return time_s < kLeast_s ? Point2(Point2::Zero())
                           : Point2((seen.back().body_odom.centre - seen.front().body_odom.centre) / time_s);
}

bool SeenMovers::Track::seems_to_drive() const {
  const Point2 velocity = velocity_odom();
  const Seen& from = seen.front();
  const bool even = std::all_of(seen.begin(), seen.end(), [&](const Seen& at) {
    const Point2 expected = from.body_odom.centre + to_seconds(at.at - from.at) * velocity;
    return (expected - at.body_odom.centre).norm() < kUneven_m;
  });
  return even && velocity.norm() >= kSlowest_m_s && velocity.norm() <= kFastest_m_s;
}

std::vector<Mover> SeenMovers::movers_base(const Pose2& odom_T_base, RobotTime now) const {
  std::vector<Mover> movers;
  for (const Track& track : tracks_) {
    const double age_s = to_seconds(now - track.seen.back().at);
    if (!track.drove_at || to_seconds(now - *track.drove_at) > kRests_s || age_s > kLost_s) {
      continue;
    }
    const Point2 velocity = track.velocity_odom();
    const Point2 p_odom = track.seen.back().body_odom.centre + age_s * velocity;
    const Pose2 odom_T_mover{p_odom.x(), p_odom.y(), std::atan2(velocity.y(), velocity.x())};
    movers.push_back({inverse(odom_T_base) * odom_T_mover, {velocity.norm(), 0.0}, track.radius_m, kSlack_m});
  }
  return movers;
}

}  // namespace seeker::nav
