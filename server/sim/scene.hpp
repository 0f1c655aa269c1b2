/// \file
/// The world for ray casting: vertical faces, the convex solids that they bound, and a grid that finds them quickly.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "server/sim/face_grid.hpp"
#include "server/sim/texture.hpp"
#include "server/sim/world.hpp"

namespace seeker::sim {

inline constexpr int kNoPicture = -1;

/// Paint of a face or of a solid's top, ready for the renderer.
struct Paint {
  double albedo = 0.7;  ///< reflectance, side light included
  double contrast = 0.0;
  double texels_per_m = 100.0;
  double u0_texel = 0.0;  ///< first column of its cut of the noise picture; large enough that no coordinate is negative
  double v0_texel = 0.0;
  std::uint64_t pattern = 0;  ///< number of the stereo camera's pattern (see Pattern), different for each surface
  double feature_m = 0.12;    ///< size of the pattern's coarsest blotch
  double along0_m = 0.0;      ///< where along the pattern the face begins
};

/// A vertical rectangle over the segment `segment` between two heights.
struct Face {
  Segment segment;
  Point2 normal = Point2::UnitX();  ///< outwards (a single wall: to the left of a -> b)
  double z_min_m = 0.0;
  double z_max_m = 0.0;
  int solid = 0;
  int picture = kNoPicture;  ///< painted instead of the texture, left edge at segment.a
  Paint paint;
};

/// A convex prism, or a single face without an inside.
struct Solid {
  double z_min_m = 0.0;
  double z_max_m = 0.0;
  std::size_t first_face = 0;
  std::size_t face_count = 0;
  Paint cover;  ///< paint of its top and bottom
};

/// An upright, round, moving object at one moment: a walking person or another robot.
struct Disc {
  Point2 centre = Point2::Zero();
  double radius_m = 0.0;
  double height_m = 0.0;
  Paint paint;
};

/// The nearest object on a ray.
struct RayHit {
  double distance_m = 0.0;
  double cos_incidence = 1.0;  ///< cosine of the angle between ray and normal; 0: grazing
  double to_edge_m = 1e9;      ///< distance from the hit to the nearer vertical edge of its face
};

/// Interval of heights.
struct HeightBand {
  double low_m = 0.0;
  double high_m = 0.0;
  [[nodiscard]] bool meets(double z_min, double z_max) const { return z_min <= high_m && z_max >= low_m; }
};

class Scene {
 public:
  /// Makes the scene of a valid world.
  explicit Scene(const World& world);

  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }
  [[nodiscard]] const std::vector<PictureTexture>& pictures() const { return pictures_; }
  [[nodiscard]] const FaceGrid& grid() const { return grid_; }
  [[nodiscard]] const Paint& floor() const { return floor_; }
  [[nodiscard]] double ceiling_m() const { return ceiling_m_; }  ///< height that no object exceeds
  [[nodiscard]] const std::vector<Disc>& moving() const { return moving_; }
  void set_moving(std::vector<Disc> moving) { moving_ = std::move(moving); }

  /// The nearest face or moving object at height z on the ray, within range_max_m. `direction` has length 1.
  [[nodiscard]] std::optional<RayHit> nearest(const Point2& origin, const Point2& direction, double range_max_m,
                                              double z_m) const;

  /// Distance from p to the nearest object in the band of heights, at most `limit_m`; 0 inside a solid.
  [[nodiscard]] double clearance_m(const Point2& p, double limit_m, const HeightBand& band) const;

 private:
  void add_prism(const std::vector<Point2>& corners, double z_min, double z_max, const Surface& surface);
  void add_wall(const Wall& wall);
  void add_target(const Target& target);
  void add_solid(const TankSolid& solid);
  [[nodiscard]] bool inside(const Solid& solid, const Point2& p) const;

  Lighting lighting_;
  std::uint64_t pattern_seed_ = 0;
  double ceiling_m_ = 0.0;
  std::vector<Face> faces_;
  std::vector<Solid> solids_;
  std::vector<PictureTexture> pictures_;
  std::vector<Disc> moving_;
  Paint floor_;
  FaceGrid grid_;
};

/// Texture numbers of a surface; `serial` gives each face its own cut, `pattern_seed` is World::pattern_seed.
[[nodiscard]] Paint make_paint(const Surface& surface, std::uint64_t serial, std::uint64_t pattern_seed = 0);

/// Corners of a standing cylinder as a prism, counter-clockwise.
[[nodiscard]] std::vector<Point2> cylinder_corners(const Point2& centre, double radius_m);

/// Relative brightness at a place.
[[nodiscard]] double light_at(const Lighting& lighting, const Point2& p_world);

}  // namespace seeker::sim
