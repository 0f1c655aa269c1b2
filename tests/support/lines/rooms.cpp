#include "tests/support/lines/rooms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/angle.hpp"

namespace seeker::testing {
namespace {

constexpr double kRoomWidth_m = 10.0;
constexpr double kRoomDepth_m = 7.0;
constexpr int kBoxes = 5;
constexpr double kClearance_m = 0.3;  ///< of the laser from everything

double cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance_m(const Point2& p, const RoomWall& wall) {
  const Point2 along = wall.b - wall.a;
  const double t = std::clamp((p - wall.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - wall.a - t * along).norm();
}

struct Hit {
  double range_m = std::numeric_limits<double>::infinity();
  std::int32_t wall = -1;
};

Hit cast(const Room& room, double angle_rad) {
  const Point2 direction(std::cos(angle_rad), std::sin(angle_rad));
  Hit hit;
  for (std::size_t k = 0; k < room.size(); ++k) {
    const Point2 along = room[k].b - room[k].a;
    const double denominator = cross(direction, along);
    if (denominator == 0.0) {
      continue;
    }
    const double range = cross(room[k].a, along) / denominator;
    const double place = cross(room[k].a, direction) / denominator;
    if (range > 0.0 && place >= 0.0 && place <= 1.0 && range < hit.range_m) {
      hit = {range, static_cast<std::int32_t>(k)};
    }
  }
  return hit;
}

bool inside(const std::vector<Point2>& box, const Point2& p) {
  for (std::size_t k = 0; k < box.size(); ++k) {
    if (cross(box[(k + 1) % box.size()] - box[k], p - box[k]) < 0.0) {
      return false;
    }
  }
  return true;
}

}  // namespace

void add_polygon(Room& room, const std::vector<Point2>& corners) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    room.push_back({corners[k], corners[(k + 1) % corners.size()]});
  }
}

Room seen_from(const Room& room, const Pose2& laser_T_new) {
  const Pose2 new_T_laser = inverse(laser_T_new);
  Room moved;
  for (const RoomWall& wall : room) {
    moved.push_back({new_T_laser * wall.a, new_T_laser * wall.b});
  }
  return moved;
}

Room random_room(Rng& rng) {
  Room room;
  add_polygon(room, {{0.0, 0.0}, {kRoomWidth_m, 0.0}, {kRoomWidth_m, kRoomDepth_m}, {0.0, kRoomDepth_m}});
  std::vector<std::vector<Point2>> boxes;
  for (int k = 0; k < kBoxes; ++k) {
    const Pose2 room_T_box{rng.uniform(1.0, kRoomWidth_m - 1.0), rng.uniform(1.0, kRoomDepth_m - 1.0),
                           rng.uniform(-kPi, kPi)};
    const double a = rng.uniform(0.25, 0.75);
    const double b = rng.uniform(0.25, 0.75);
    boxes.push_back({room_T_box * Point2(-a, -b), room_T_box * Point2(a, -b), room_T_box * Point2(a, b),
                     room_T_box * Point2(-a, b)});
    add_polygon(room, boxes.back());
  }
  while (true) {
    const Point2 p(rng.uniform(0.5, kRoomWidth_m - 0.5), rng.uniform(0.5, kRoomDepth_m - 0.5));
    bool free = true;
    for (const auto& box : boxes) {
      free = free && !inside(box, p);
    }
    for (const RoomWall& wall : room) {
      free = free && distance_m(p, wall) > kClearance_m;
    }
    if (free) {
      return seen_from(room, {p.x(), p.y(), rng.uniform(-kPi, kPi)});
    }
  }
}

ScannerModel ScannerModel::half_circle(int beams, double sigma_m) {
  return {.beams = beams, .first_rad = -kPi / 2.0, .step_rad = kPi / (beams - 1), .sigma_m = sigma_m};
}

ScannerModel ScannerModel::full_circle(int beams, double sigma_m) {
  return {.beams = beams, .first_rad = -kPi, .step_rad = kTwoPi / beams, .sigma_m = sigma_m};
}

TrueScan scan_room(const Room& room, const ScannerModel& model, Rng& rng) {
  TrueScan result;
  LaserScan& scan = result.scan;
  scan.angle_min_rad = model.first_rad;
  scan.angle_step_rad = model.step_rad;
  scan.range_min_m = 0.02;
  scan.range_max_m = model.range_max_m;
  for (int k = 0; k < model.beams; ++k) {
    const double angle_rad = scan.angle_rad(static_cast<std::size_t>(k)) + rng.normal(model.bearing_sigma_rad);
    const Hit hit = cast(room, angle_rad);
    const bool seen = hit.wall >= 0 && hit.range_m < model.range_max_m;
    const double sigma_m = std::hypot(model.sigma_m, seen ? model.slope * hit.range_m : 0.0);
    const double noise_m = rng.normal(sigma_m);
    scan.ranges_m.push_back(seen ? static_cast<float>(hit.range_m + noise_m) : kNoReturn);
    result.wall_of_beam.push_back(seen ? hit.wall : -1);
    result.true_range_m.push_back(hit.range_m);
  }
  return result;
}

}  // namespace seeker::testing
