#include "server/lab/scoring/true_walls.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "server/sim/placement.hpp"

namespace seeker::lab {
namespace {

/// How much nearer than the wall itself a ray may end.
constexpr double kSightSlack_m = 0.01;

/// Places of a raster that the robot can stand at.
std::vector<Point2> standing_places(const sim::World& world, double radius_m, const std::optional<Polygon>& bound_world,
                                    double step_m) {
  constexpr double kFloor_m = 0.05;
  const Grid<float> floor = sim::reachable_floor(world, radius_m, kFloor_m);
  const int stride = std::max(1, static_cast<int>(std::lround(step_m / kFloor_m)));
  std::vector<Point2> places;
  for (int j = stride / 2; j < floor.height(); j += stride) {
    for (int i = stride / 2; i < floor.width(); i += stride) {
      const Point2 p = floor.frame().centre_of({i, j});
      if (floor[{i, j}] >= 0.0F && (!bound_world || contains(*bound_world, p))) {
        places.push_back(p);
      }
    }
  }
  places.push_back(world.starts.front().translation());
  return places;
}

class Sight {
 public:
  Sight(const sim::Scene& scene, std::vector<Point2> places, const sim::LidarModel& lidar)
      : scene_(scene), places_(std::move(places)), lidar_(lidar), least_cosine_(std::cos(lidar.grazing_rad)) {}

  /// All of them from one place: a line is found in one scan.
  [[nodiscard]] bool sees(std::span<const WallPiece> pieces) {
    if (sees_from(places_[last_], pieces)) {
      return true;  // neighbouring pieces are mostly seen from the same place
    }
    for (std::size_t n = 0; n < places_.size(); ++n) {
      if (sees_from(places_[n], pieces)) {
        last_ = n;
        return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] bool sees_from(const Point2& place, std::span<const WallPiece> pieces) const {
    return std::all_of(pieces.begin(), pieces.end(), [&](const WallPiece& piece) { return sees_piece(place, piece); });
  }
  [[nodiscard]] bool sees_piece(const Point2& place, const WallPiece& piece) const {
    const Point2 ray = piece.p_world - place;
    const double distance_m = ray.norm();
    if (distance_m > lidar_.range_max_m || distance_m < lidar_.range_min_m ||
        -ray.dot(piece.normal) < least_cosine_ * distance_m) {
      return false;
    }
    const auto hit = scene_.nearest(place, ray / distance_m, distance_m, lidar_.height_m);
    return !hit || hit->distance_m >= distance_m - kSightSlack_m;
  }

  const sim::Scene& scene_;
  std::vector<Point2> places_;
  sim::LidarModel lidar_;
  double least_cosine_;
  std::size_t last_ = 0;
};

/// Adds the pieces of a face that belong to a stretch which is long enough and seen at once from the side of `normal`.
void add_seen(const sim::Segment& face, const Point2& normal, Sight& sight, const TrueWallParams& params,
              std::vector<WallPiece>& seen) {
  const int count = std::max(1, static_cast<int>(std::lround(face.length_m / params.piece_m)));
  const double length_m = face.length_m / count;
  std::vector<WallPiece> pieces;
  pieces.reserve(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    pieces.push_back({face.a + (n + 0.5) * length_m * face.direction, normal, length_m});
  }
  constexpr double kRounding = 1e-6;
  const auto stretch = static_cast<std::size_t>(std::ceil(params.shortest_m / length_m - kRounding));
  std::vector<bool> counts(pieces.size(), false);
  for (std::size_t first = 0; first + stretch <= pieces.size(); ++first) {
    if (sight.sees(std::span(pieces).subspan(first, stretch))) {
      std::fill_n(counts.begin() + static_cast<std::ptrdiff_t>(first), stretch, true);
    }
  }
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    if (counts[n]) {
      seen.push_back(pieces[n]);
    }
  }
}

}  // namespace

double TrueWalls::reachable_m() const {
  double sum_m = 0.0;
  for (const WallPiece& piece : reachable) {
    sum_m += piece.length_m;
  }
  return sum_m;
}

TrueWalls true_walls(const sim::World& world, const sim::RobotModel& robot, const std::optional<Polygon>& bound_world,
                     const TrueWallParams& params) {
  const sim::Scene scene(world);
  Sight sight(scene, standing_places(world, robot.radius_m, bound_world, params.view_step_m), robot.lidar);
  TrueWalls walls;
  for (const sim::Face& face : scene.faces()) {
    if (face.z_min_m > robot.lidar.height_m || face.z_max_m < robot.lidar.height_m) {
      continue;
    }
    const auto solid = static_cast<std::size_t>(face.solid);
    const bool wall = solid < world.walls.size();  // the scene's first solids are the world's walls
    (wall ? walls.walls : walls.furniture).push_back(face.segment);
    if (!wall || face.segment.length_m < params.shortest_m) {
      continue;
    }
    add_seen(face.segment, face.normal, sight, params, walls.reachable);
    if (scene.solids()[solid].face_count == 1) {
      add_seen(face.segment, -face.normal, sight, params, walls.reachable);
    }
  }
  return walls;
}

}  // namespace seeker::lab
