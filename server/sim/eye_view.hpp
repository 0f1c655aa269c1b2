/// \file
/// First stage of the stereo renderer: the surfaces in view of one eye as convex patches of its picture, and the patch
/// that each sample of a picture row shows.
#pragma once

#include <cstdint>
#include <vector>

#include "server/sim/omni_columns.hpp"
#include "server/sim/pattern.hpp"
#include "server/sim/robot_model.hpp"
#include "server/sim/scene.hpp"

namespace seeker::sim {

/// c + x * ray_x + y * ray_y for the ray (x to the left, y up, 1 ahead).
struct Linear {
  float c = 0.0F;
  float x = 0.0F;
  float y = 0.0F;
  [[nodiscard]] float at(float ray_x, float ray_y) const { return c + x * ray_x + y * ray_y; }
};

/// A flat convex piece of the scene. A ray meets it where all borders are not negative, at depth 1 / inverse_depth.
struct Patch {
  Linear inverse_depth;
  std::uint32_t first_border = 0;
  std::uint32_t borders = 0;
  int row_begin = 0;  ///< first and last sample row that the patch can cover
  int row_end = 0;
  // How it is painted. Surface coordinates of p: along = axis . (p - corner), and height or across.
  bool upright = true;
  Point2 corner = Point2::Zero();
  Point2 axis = Point2::UnitX();
  double plane_m = 1.0;  ///< distance of the eye from the patch's plane
  double light = 1.0;    ///< brightness factor, less on undersides
  double length_m = 1.0;
  double z_min_m = 0.0;
  double z_max_m = 1.0;
  const Paint* paint = nullptr;
  const PictureTexture* picture = nullptr;
  PatternScale pattern;
};

/// Samples of one picture row, `kPerPixel` to a pixel.
struct SampleRow {
  std::vector<float> ray_x;
  std::vector<float> ray_y;
  std::vector<float> inverse_depth;
  std::vector<std::int32_t> patch;  ///< kNothing: the ceiling
  static constexpr std::int32_t kNothing = -1;
};

class EyeView {
 public:
  static constexpr int kPerPixel = 2;  ///< samples per pixel along either axis

  /// Makes a view for a valid geometry.
  EyeView(const StereoGeometry& geometry, const EyeErrors& errors);

  /// Collects the surfaces in view of the eye. `scene` must outlive the next look().
  void build(const Scene& scene, const CameraPose& eye);
  /// Finds the patches that the samples of a sample row show.
  void look(int sample_row, SampleRow& row) const;

  [[nodiscard]] const std::vector<Patch>& patches() const { return patches_; }
  [[nodiscard]] const CameraPose& eye() const { return eye_; }
  /// Horizontal direction of a ray per metre of depth.
  [[nodiscard]] Point2 heading_of(double ray_x) const { return ahead_ + ray_x * left_; }

 private:
  void find_solids(const Scene& scene);
  void add_face(const Scene& scene, const Face& face);
  void add_cover(const Scene& scene, const Solid& solid);
  void add_floor(const Scene& scene);
  void add_people(const Scene& scene);
  bool place(Patch& patch, const std::vector<Point2>& corners, double z_low, double z_high);
  void fill(const Patch& patch, std::int32_t index, float y, SampleRow& row) const;
  [[nodiscard]] Linear border(const Linear& inverse_depth, const Point2& normal, const Point2& on_border) const;

  StereoGeometry geometry_;
  EyeErrors errors_;
  double pad_px_ = 0.0;      ///< upper limit of the displacement of a border by the errors of the eye
  double distortion_ = 0.0;  ///< coefficient of the residual distortion x (x^2 + y^2)
  CameraPose eye_;
  Point2 ahead_ = Point2::UnitX();
  Point2 left_ = Point2::UnitY();
  std::vector<Patch> patches_;
  std::vector<Linear> borders_;
  std::vector<char> seen_;  ///< for each solid: whether it is in view
  std::vector<Face> person_faces_;
};

}  // namespace seeker::sim
