/// \file
/// First stage of the omnidirectional renderer: for every azimuth, the objects that a vertical fan of rays meets, by
/// distance.
#pragma once

#include <cstdint>
#include <vector>

#include "server/sim/scene.hpp"

namespace seeker::sim {

/// An object in the fan of one azimuth: its front at `near_m`, its back at `far_m` (equal for a single face).
struct ColumnItem {
  double near_m = 0.0;
  double far_m = 0.0;
  double z_min_m = 0.0;
  double z_max_m = 0.0;
  bool front = true;  ///< false: the camera is above or below the object and sees no front
  const Paint* paint = nullptr;
  const Paint* cover = nullptr;  ///< paint of its top and bottom
  double u_texel = 0.0;          ///< texture column of the front
  int level = 0;                 ///< mip level of the front
  double light = 1.0;            ///< brightness factor of the place
  const PictureTexture* picture = nullptr;
  double picture_s = 0.0;  ///< 0 left .. 1 right
};

/// Pose of a camera.
struct CameraPose {
  Point2 position = Point2::Zero();
  double heading_rad = 0.0;
  double height_m = 0.0;
};

/// All azimuths of one picture; the storage is reused from picture to picture.
class OmniColumns {
 public:
  /// Number of azimuths: 0.7 px at the rim of the mirror.
  static constexpr int kAzimuths = 2048;

  /// Azimuth of column c in the camera's frame.
  [[nodiscard]] static double azimuth_rad(int c);
  [[nodiscard]] static int column_of(double azimuth_rad);

  void build(const Scene& scene, const Lighting& lighting, const CameraPose& camera);

  [[nodiscard]] const ColumnItem* begin(int c) const { return items_.data() + starts_[static_cast<std::size_t>(c)]; }
  [[nodiscard]] const ColumnItem* end(int c) const { return items_.data() + starts_[static_cast<std::size_t>(c) + 1]; }
  [[nodiscard]] const Point2& direction(int c) const { return directions_[static_cast<std::size_t>(c)]; }

 private:
  struct Meeting {
    double distance_m;
    double along_m;
    std::uint32_t face;
  };
  void collect(const Scene& scene, const CameraPose& camera, const Point2& direction);
  void add_items(const Scene& scene, const Lighting& lighting, const CameraPose& camera, const Point2& direction);
  void add_people(const Scene& scene, const Lighting& lighting, const CameraPose& camera, const Point2& direction,
                  std::size_t first);

  std::vector<ColumnItem> items_;
  std::vector<std::size_t> starts_;
  std::vector<Point2> directions_;
  std::vector<Meeting> meetings_;
};

}  // namespace seeker::sim
