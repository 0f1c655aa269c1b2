#include "server/sim/scene.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/polygon.hpp"
#include "server/sim/mix.hpp"
#include "server/sim/tank_renderer.hpp"

namespace seeker::sim {
namespace {

constexpr int kCylinderSides = 24;
constexpr double kDarkestPlace = 0.35;  ///< limits of the gradient of the lamps
constexpr double kBrightestPlace = 1.65;

/// Brightness of a vertical face by where it looks to.
double side_light(const Lighting& lighting, const Point2& normal) {
  const Point2 light(std::cos(lighting.direction_rad), std::sin(lighting.direction_rad));
  return 1.0 - lighting.directional * 0.5 * (1.0 - normal.dot(light));
}

std::vector<Point2> rectangle(const Pose2& world_T_box, double length_m, double width_m) {
  const double x = length_m / 2.0;
  const double y = width_m / 2.0;
  return {world_T_box * Point2(x, -y), world_T_box * Point2(x, y), world_T_box * Point2(-x, y),
          world_T_box * Point2(-x, -y)};
}

/// Distance to the near border of a disc along a ray, if it is met.
std::optional<double> meet_disc(const Disc& disc, const Point2& origin, const Point2& direction) {
  const Point2 to_centre = disc.centre - origin;
  const double along = to_centre.dot(direction);
  const double off2 = to_centre.squaredNorm() - along * along;
  const double r2 = disc.radius_m * disc.radius_m;
  if (along <= 0.0 || off2 >= r2) {
    return std::nullopt;
  }
  return std::max(0.0, along - std::sqrt(r2 - off2));
}

}  // namespace

double light_at(const Lighting& lighting, const Point2& p_world) {
  return lighting.gain * std::clamp(1.0 + lighting.gradient_per_m.dot(p_world), kDarkestPlace, kBrightestPlace);
}

std::vector<Point2> cylinder_corners(const Point2& centre, double radius_m) {
  std::vector<Point2> corners;
  corners.reserve(kCylinderSides);
  for (int i = 0; i < kCylinderSides; ++i) {
    const double angle = kTwoPi * i / kCylinderSides;
    corners.emplace_back(centre + radius_m * Point2(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

Paint make_paint(const Surface& surface, std::uint64_t serial, std::uint64_t pattern_seed) {
  const std::uint64_t world = pattern_seed == 0 ? 0 : mix(pattern_seed);
  const std::uint64_t bits = mix(mix(surface.pattern) ^ serial ^ world);
  constexpr double kSide = NoiseTexture::kSide_texels;
  // Coordinates are used along +-500 m: start far enough from zero.
  const double texels_per_m = NoiseTexture::kCoarsest_texels / surface.feature_size_m;
  const double base = std::ceil(2.0 * kMaxWorldSide_m * texels_per_m / kSide) * kSide;
  return {surface.albedo,
          surface.contrast,
          texels_per_m,
          base + static_cast<double>(bits % NoiseTexture::kSide_texels),
          base + static_cast<double>((bits >> 20U) % NoiseTexture::kSide_texels),
          mix(bits),
          surface.feature_size_m};
}

Scene::Scene(const World& world)
    : lighting_(world.lighting),
      pattern_seed_(world.pattern_seed),
      floor_(make_paint(world.floor, 0, world.pattern_seed)) {
  for (const Wall& wall : world.walls) {
    add_wall(wall);
  }
  for (const Box& box : world.boxes) {
    add_prism(rectangle(box.world_T_box, box.length_m, box.width_m), box.z_min_m, box.z_max_m, box.surface);
  }
  for (const Cylinder& cylinder : world.cylinders) {
    add_prism(cylinder_corners(cylinder.centre, cylinder.radius_m), cylinder.z_min_m, cylinder.z_max_m,
              cylinder.surface);
  }
  for (const Target& target : world.targets) {
    add_target(target);
  }
  for (const TankSolid& solid : world.solids) {
    add_solid(solid);
  }
  std::vector<Segment> segments;
  segments.reserve(faces_.size());
  for (const Face& face : faces_) {
    segments.push_back(face.segment);
    ceiling_m_ = std::max(ceiling_m_, face.z_max_m);
  }
  grid_ = FaceGrid(world.min_corner, world.max_corner, std::move(segments));
}

void Scene::add_prism(const std::vector<Point2>& corners, double z_min, double z_max, const Surface& surface) {
  const int solid = static_cast<int>(solids_.size());
  solids_.push_back(
      {z_min, z_max, faces_.size(), corners.size(), make_paint(surface, mix(faces_.size()), pattern_seed_)});
  double distance_m = 0.0;
  const Paint first = make_paint(surface, faces_.size(), pattern_seed_);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Segment segment = Segment::between(corners[i], corners[(i + 1) % corners.size()]);
    Face face{segment, Point2(segment.direction.y(), -segment.direction.x()), z_min, z_max, solid, kNoPicture, first};
    face.paint.albedo *= side_light(lighting_, face.normal);
    face.paint.u0_texel += distance_m * first.texels_per_m;  // the texture goes on around the corner
    face.paint.along0_m = distance_m;
    distance_m += segment.length_m;
    faces_.push_back(face);
  }
}

void Scene::add_wall(const Wall& wall) {
  const Segment segment = Segment::between(wall.a, wall.b);
  if (wall.thickness_m > 0.0) {
    const Point2 centre = 0.5 * (wall.a + wall.b);
    const Pose2 pose{centre.x(), centre.y(), std::atan2(segment.direction.y(), segment.direction.x())};
    add_prism(rectangle(pose, segment.length_m, wall.thickness_m), wall.z_min_m, wall.z_max_m, wall.surface);
    return;
  }
  const int solid = static_cast<int>(solids_.size());
  const Paint paint = make_paint(wall.surface, faces_.size(), pattern_seed_);
  solids_.push_back({wall.z_min_m, wall.z_max_m, faces_.size(), 1, paint});
  Face face{
      segment, Point2(-segment.direction.y(), segment.direction.x()), wall.z_min_m, wall.z_max_m, solid, kNoPicture,
      paint};
  face.paint.albedo *= side_light(lighting_, face.normal);
  faces_.push_back(face);
}

void Scene::add_target(const Target& target) {
  const int picture = static_cast<int>(pictures_.size());
  pictures_.emplace_back(target.picture);
  constexpr double kCoverAlbedo = 0.12;
  const Surface cover{kCoverAlbedo, 0.0, 1.0, 0};
  const std::size_t first = faces_.size();
  // A poster is a thin board: its back shows nothing.
  constexpr double kPoster_m = 0.01;
  const double depth = target.depth_m > 0.0 ? target.depth_m : kPoster_m;
  add_prism(rectangle(target.world_T_target, depth, target.width_m), target.z_min_m, target.z_min_m + target.height_m,
            cover);
  const std::size_t painted = target.depth_m > 0.0 ? faces_.size() - first : 1;
  for (std::size_t i = 0; i < painted; ++i) {
    faces_[first + i].picture = picture;
    faces_[first + i].paint.albedo = side_light(lighting_, faces_[first + i].normal);
  }
}

/// For all but the camera of a tank it is as wide at every height as at its widest.
void Scene::add_solid(const TankSolid& solid) {
  const Surface plain{solid.albedo, 0.0, 1.0, 0};
  add_prism(outline(solid), 0.0, 2.0 * half_height_m(solid), plain);
}

std::optional<RayHit> Scene::nearest(const Point2& origin, const Point2& direction, double range_max_m,
                                     double z_m) const {
  Crossing best{range_max_m, 0.0, 0};
  bool found = false;
  grid_.walk(
      origin, direction, range_max_m,
      [&](const Crossing& crossing) {
        const Face& face = faces_[crossing.face];
        if (crossing.distance_m <= best.distance_m && z_m >= face.z_min_m && z_m <= face.z_max_m) {
          best = crossing;
          found = true;
        }
      },
      [&found] { return found; });
  std::optional<RayHit> hit;
  if (found) {
    const Face& face = faces_[best.face];
    hit = RayHit{best.distance_m, std::abs(face.normal.dot(direction)),
                 std::min(best.along_m, face.segment.length_m - best.along_m)};
  }
  for (const Disc& disc : moving_) {
    const std::optional<double> distance = meet_disc(disc, origin, direction);
    if (distance && z_m <= disc.height_m && *distance <= (hit ? hit->distance_m : range_max_m)) {
      const Point2 normal = (origin + *distance * direction - disc.centre).normalized();
      hit = RayHit{*distance, std::abs(normal.dot(direction))};
    }
  }
  return hit;
}

bool Scene::inside(const Solid& solid, const Point2& p) const {
  if (solid.face_count < 3) {
    return false;
  }
  for (std::size_t i = 0; i < solid.face_count; ++i) {
    const Face& face = faces_[solid.first_face + i];
    if (face.normal.dot(p - face.segment.a) > 0.0) {
      return false;
    }
  }
  return true;
}

double Scene::clearance_m(const Point2& p, double limit_m, const HeightBand& band) const {
  double nearest_m = limit_m;
  grid_.around(p, limit_m, [&](std::uint32_t index) {
    const Face& face = faces_[index];
    if (band.meets(face.z_min_m, face.z_max_m)) {
      nearest_m = std::min(nearest_m, distance_to_segment_m(face.segment.a, face.segment.b(), p));
    }
  });
  for (const Disc& disc : moving_) {
    if (band.meets(0.0, disc.height_m)) {
      nearest_m = std::min(nearest_m, std::max(0.0, (p - disc.centre).norm() - disc.radius_m));
    }
  }
  for (const Solid& solid : solids_) {
    if (band.meets(solid.z_min_m, solid.z_max_m) && inside(solid, p)) {
      return 0.0;
    }
  }
  return nearest_m;
}

}  // namespace seeker::sim
