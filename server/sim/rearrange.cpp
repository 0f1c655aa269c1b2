#include "server/sim/rearrange.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/sim/placement.hpp"
#include "server/sim/scene.hpp"

namespace seeker::sim {
namespace {

constexpr int kAttempts = 60;
constexpr double kSample_m = 0.1;     ///< between the places of a footprint that are examined
constexpr double kFree_m = 0.06;      ///< between a moved object and anything else
constexpr double kStartFree_m = 0.6;  ///< between a moved object and a start
constexpr double kLeast_m = 0.4;      ///< distance of a moved object
constexpr double kSlide_m = 2.5;      ///< longest distance along a wall
constexpr double kOnWall_m = 0.05;    ///< the middle of a hanging board is this near to its wall
constexpr double kFloorKept = 0.93;   ///< of the reachable floor
constexpr double kFloorResolution_m = 0.1;
constexpr double kRobotRadius_m = 0.30;
constexpr double kRobotHeight_m = 1.0;  ///< with a camera mast
constexpr double kHangs_m = 0.3;        ///< what begins higher stands on nothing

/// Indices of the parts of one piece; a cylinder is a piece of its own.
struct Piece {
  std::vector<std::size_t> boxes;
  std::vector<std::size_t> cylinders;
};

/// Its parts' bounds in the frame `world_T_piece`.
struct Footprint {
  Pose2 world_T_piece;
  Point2 low = Point2::Zero();
  Point2 high = Point2::Zero();
  HeightBand band;
};

std::vector<Piece> pieces_of(const World& world) {
  std::vector<Piece> pieces;
  std::map<std::string, std::size_t> named;
  for (std::size_t i = 0; i < world.boxes.size(); ++i) {
    const std::string& name = world.boxes[i].object;
    const auto known = name.empty() ? named.end() : named.find(name);
    if (known != named.end()) {
      pieces[known->second].boxes.push_back(i);
      continue;
    }
    if (!name.empty()) {
      named.emplace(name, pieces.size());
    }
    pieces.push_back({{i}, {}});
  }
  for (std::size_t i = 0; i < world.cylinders.size(); ++i) {
    pieces.push_back({{}, {i}});
  }
  return pieces;
}

void widen(Footprint& f, const Point2& p_world) {
  const Point2 p = inverse(f.world_T_piece) * p_world;
  f.low = f.low.cwiseMin(p);
  f.high = f.high.cwiseMax(p);
}

Footprint footprint_of(const World& world, const Piece& piece) {
  Footprint f;
  if (!piece.cylinders.empty()) {
    const Cylinder& c = world.cylinders[piece.cylinders.front()];
    f.world_T_piece = {c.centre.x(), c.centre.y(), 0.0};
    f.high = Point2::Constant(c.radius_m);
    f.low = -f.high;
    f.band = {c.z_min_m, c.z_max_m};
    return f;
  }
  f.world_T_piece = world.boxes[piece.boxes.front()].world_T_box;
  f.band = {kMaxWorldSide_m, 0.0};
  for (const std::size_t i : piece.boxes) {
    const Box& box = world.boxes[i];
    for (const double sx : {-0.5, 0.5}) {
      for (const double sy : {-0.5, 0.5}) {
        widen(f, box.world_T_box * Point2(sx * box.length_m, sy * box.width_m));
      }
    }
    f.band = {std::min(f.band.low_m, box.z_min_m), std::max(f.band.high_m, box.z_max_m)};
  }
  return f;
}

World without(const World& world, const Piece& piece) {
  World rest = world;
  const auto drop = [](auto& items, const std::vector<std::size_t>& indices) {
    for (auto i = indices.rbegin(); i != indices.rend(); ++i) {
      items.erase(items.begin() + static_cast<std::ptrdiff_t>(*i));
    }
  };
  drop(rest.boxes, piece.boxes);
  drop(rest.cylinders, piece.cylinders);
  return rest;
}

void move_parts(World& world, const Piece& piece, const Pose2& from, const Pose2& to) {
  const Pose2 step = to * inverse(from);
  for (const std::size_t i : piece.boxes) {
    world.boxes[i].world_T_box = step * world.boxes[i].world_T_box;
  }
  for (const std::size_t i : piece.cylinders) {
    world.cylinders[i].centre = step * world.cylinders[i].centre;
  }
}

/// Calls `good(p_world)` for places all over the footprint at `world_T_piece`; true when all are.
template <class Good>
bool all_over(const Footprint& f, const Pose2& world_T_piece, const Good& good) {
  const Point2 size = f.high - f.low;
  const int nx = static_cast<int>(std::ceil(size.x() / kSample_m));
  const int ny = static_cast<int>(std::ceil(size.y() / kSample_m));
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      const Point2 share(nx > 0 ? static_cast<double>(i) / nx : 0.5, ny > 0 ? static_cast<double>(j) / ny : 0.5);
      if (!good(Point2(world_T_piece * Point2(f.low + share.cwiseProduct(size))))) {
        return false;
      }
    }
  }
  return true;
}

bool stands_free(const World& rest, const Scene& scene, const Footprint& f, const Pose2& pose) {
  const HeightBand everything{0.0, std::max(f.band.high_m, kRobotHeight_m)};
  return all_over(f, pose, [&](const Point2& p) {
    const bool inside = (p - rest.min_corner).minCoeff() > kFree_m && (rest.max_corner - p).minCoeff() > kFree_m;
    const bool off_starts = std::all_of(rest.starts.begin(), rest.starts.end(), [&p](const Pose2& start) {
      return (start.translation() - p).norm() > kStartFree_m;
    });
    return inside && off_starts && scene.clearance_m(p, kFree_m, everything) >= kFree_m;
  });
}

/// On its wall all along, with nothing in front of it. `front`: which side of the board looks into the room.
bool hangs_free(const World& rest, const Scene& scene, const Footprint& f, const Pose2& pose, double front) {
  const Point2 out = Pose2{0.0, 0.0, pose.theta_rad} * Point2(0.0, front * kFree_m);
  return all_over(f, pose, [&](const Point2& p) {
    const bool inside = (p - rest.min_corner).minCoeff() > 0.0 && (rest.max_corner - p).minCoeff() > 0.0;
    return inside && scene.clearance_m(p, 2.0 * kOnWall_m, f.band) < kOnWall_m &&
           scene.clearance_m(p + out, kFree_m, f.band) > kFree_m * 0.75;
  });
}

/// Tries to find another place for one piece.
bool move_piece(World& world, const Piece& piece, std::size_t floor_before, Rng& rng) {
  const Footprint f = footprint_of(world, piece);
  const World rest = without(world, piece);
  const Scene scene(rest);
  const bool hangs = f.band.low_m > kHangs_m;
  const Pose2& old = f.world_T_piece;
  const Point2 ahead = Pose2{0.0, 0.0, old.theta_rad} * Point2(0.0, kFree_m);
  const double front = scene.clearance_m(old.translation() + ahead, 1.0, f.band) >
                               scene.clearance_m(old.translation() - ahead, 1.0, f.band)
                           ? 1.0
                           : -1.0;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Pose2 pose;
    if (hangs) {
      const double distance_m = rng.uniform(kLeast_m, kSlide_m) * (rng.uniform() < 0.5 ? -1.0 : 1.0);
      pose = old * Pose2{distance_m, 0.0, 0.0};
    } else {
      pose = {rng.uniform(rest.min_corner.x(), rest.max_corner.x()),
              rng.uniform(rest.min_corner.y(), rest.max_corner.y()), rng.uniform(-kPi, kPi)};
    }
    const bool far = (pose.translation() - old.translation()).norm() >= kLeast_m;
    if (!far || !(hangs ? hangs_free(rest, scene, f, pose, front) : stands_free(rest, scene, f, pose))) {
      continue;
    }
    World moved = world;
    move_parts(moved, piece, old, pose);
    const Grid<float> floor = reachable_floor(moved, kRobotRadius_m, kFloorResolution_m, kRobotHeight_m);
    const auto cells = std::count_if(floor.cells().begin(), floor.cells().end(), [](float c) { return c >= 0.0F; });
    if (hangs || static_cast<double>(cells) >= kFloorKept * static_cast<double>(floor_before)) {
      world = std::move(moved);
      return true;
    }
  }
  return false;
}

}  // namespace

Result<std::size_t> move_objects(World& world, double share, Rng& rng) {
  if (const Status valid = validate(world); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  if (!(share > 0.0 && share <= 1.0)) {
    return fail(Errc::kInvalidArgument, "the share of objects to move must be above 0 and at most 1");
  }
  const std::vector<Piece> pieces = pieces_of(world);
  const auto wanted = static_cast<std::size_t>(std::ceil(share * static_cast<double>(pieces.size())));
  const Grid<float> floor = reachable_floor(world, kRobotRadius_m, kFloorResolution_m, kRobotHeight_m);
  const auto before = static_cast<std::size_t>(
      std::count_if(floor.cells().begin(), floor.cells().end(), [](float c) { return c >= 0.0F; }));
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::size_t moved = 0;
  for (std::size_t n = 0; n < order.size() && moved < wanted; ++n) {
    std::swap(order[n], order[n + rng.below(order.size() - n)]);
    moved += move_piece(world, pieces[order[n]], before, rng) ? 1U : 0U;
  }
  if (moved == 0) {
    return fail(Errc::kUnreachable, "world '" + world.name + "' has no object that another place can be found for");
  }
  return moved;
}

void stretch(World& world, const Point2& factors) {
  SEEKER_ASSERT(factors.minCoeff() > 0.0);
  const auto moved = [&](const Pose2& pose) {
    return Pose2{factors.x() * pose.x_m, factors.y() * pose.y_m, pose.theta_rad};
  };
  for (const Piece& piece : pieces_of(world)) {
    const Pose2 from = footprint_of(world, piece).world_T_piece;
    move_parts(world, piece, from, moved(from));
  }
  world.min_corner = world.min_corner.cwiseProduct(factors);
  world.max_corner = world.max_corner.cwiseProduct(factors);
  for (Wall& wall : world.walls) {
    wall.a = wall.a.cwiseProduct(factors);
    wall.b = wall.b.cwiseProduct(factors);
  }
  for (Target& target : world.targets) {
    target.world_T_target = moved(target.world_T_target);
  }
  for (PersonPath& person : world.people) {
    for (Point2& place : person.waypoints) {
      place = place.cwiseProduct(factors);
    }
  }
  for (Pose2& start : world.starts) {
    start = moved(start);
  }
}

}  // namespace seeker::sim
