#include "server/sim/omni_columns.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::sim {
namespace {

constexpr double kView_m = 40.0;       ///< farther objects are too small to matter
constexpr double kPixel_rad = 0.0062;  ///< what a pixel sees at the horizon
constexpr double kFullHeight_m = 2.0;  ///< nothing is seen over a wall from the floor to here or higher

}  // namespace

double OmniColumns::azimuth_rad(int c) { return -kPi + (c + 0.5) * kTwoPi / kAzimuths; }

int OmniColumns::column_of(double azimuth_rad) {
  const int c = static_cast<int>(std::floor((azimuth_rad + kPi) * kAzimuths / kTwoPi));
  return ((c % kAzimuths) + kAzimuths) % kAzimuths;
}

void OmniColumns::build(const Scene& scene, const Lighting& lighting, const CameraPose& camera) {
  items_.clear();
  starts_.clear();
  directions_.clear();
  for (int c = 0; c < kAzimuths; ++c) {
    const double angle = camera.heading_rad + azimuth_rad(c);
    const Point2 direction(std::cos(angle), std::sin(angle));
    const std::size_t first = items_.size();
    starts_.push_back(first);
    directions_.push_back(direction);
    collect(scene, camera, direction);
    add_items(scene, lighting, camera, direction);
    add_people(scene, lighting, camera, direction, first);
  }
  starts_.push_back(items_.size());
}

void OmniColumns::collect(const Scene& scene, const CameraPose& camera, const Point2& direction) {
  meetings_.clear();
  bool closed = false;
  scene.grid().walk(
      camera.position, direction, kView_m,
      [&](const Crossing& crossing) {
        const Face& face = scene.faces()[crossing.face];
        meetings_.push_back({crossing.distance_m, crossing.along_m, crossing.face});
        closed = closed || (face.z_min_m <= 0.0 && face.z_max_m >= kFullHeight_m);
      },
      [&closed] { return closed; });
  std::sort(meetings_.begin(), meetings_.end(), [](const Meeting& a, const Meeting& b) {
    return a.distance_m < b.distance_m || (a.distance_m == b.distance_m && a.face < b.face);
  });
}

void OmniColumns::add_items(const Scene& scene, const Lighting& lighting, const CameraPose& camera,
                            const Point2& direction) {
  for (std::size_t i = 0; i < meetings_.size(); ++i) {
    const Meeting& meeting = meetings_[i];
    const Face& face = scene.faces()[meeting.face];
    const Solid& solid = scene.solids()[static_cast<std::size_t>(face.solid)];
    const bool is_front = solid.face_count == 1 || face.normal.dot(direction) < 0.0;
    const auto same_solid = [&](const Meeting& other) { return scene.faces()[other.face].solid == face.solid; };
    if (!is_front && std::any_of(meetings_.begin(), meetings_.begin() + static_cast<std::ptrdiff_t>(i), same_solid)) {
      continue;  // the back of an object whose front is in the list
    }
    ColumnItem item{meeting.distance_m, meeting.distance_m, face.z_min_m, face.z_max_m, true,
                    &face.paint,        &solid.cover};
    if (is_front) {
      const auto back =
          std::find_if(meetings_.begin() + static_cast<std::ptrdiff_t>(i) + 1, meetings_.end(), same_solid);
      item.far_m = back != meetings_.end() ? back->distance_m : item.near_m;
    } else {
      item.front = false;
      item.near_m = 0.0;
    }
    item.light = light_at(lighting, camera.position + meeting.distance_m * direction);
    const double footprint_m = meeting.distance_m * kPixel_rad;
    if (face.picture != kNoPicture) {
      item.picture = &scene.pictures()[static_cast<std::size_t>(face.picture)];
      item.picture_s = meeting.along_m / face.segment.length_m;
      item.level = mip_level(footprint_m * item.picture->width_px() / face.segment.length_m, item.picture->levels());
    } else {
      item.u_texel = face.paint.u0_texel + meeting.along_m * face.paint.texels_per_m;
      item.level = mip_level(footprint_m * face.paint.texels_per_m, NoiseTexture::kLevels);
    }
    items_.push_back(item);
  }
}

void OmniColumns::add_people(const Scene& scene, const Lighting& lighting, const CameraPose& camera,
                             const Point2& direction, std::size_t first) {
  bool added = false;
  for (const Disc& disc : scene.moving()) {
    const Point2 to_centre = disc.centre - camera.position;
    const double along = to_centre.dot(direction);
    const double off2 = to_centre.squaredNorm() - along * along;
    const double half2 = disc.radius_m * disc.radius_m - off2;
    if (along <= 0.0 || half2 <= 0.0) {
      continue;
    }
    const double half = std::sqrt(half2);
    ColumnItem item{std::max(0.0, along - half), along + half, 0.0, disc.height_m, true, &disc.paint, &disc.paint};
    const Point2 p = camera.position + item.near_m * direction - disc.centre;
    item.u_texel = disc.paint.u0_texel + std::atan2(p.y(), p.x()) * disc.radius_m * disc.paint.texels_per_m;
    item.level = mip_level(item.near_m * kPixel_rad * disc.paint.texels_per_m, NoiseTexture::kLevels);
    item.light = light_at(lighting, disc.centre);
    items_.push_back(item);
    added = true;
  }
  if (added) {
    std::sort(items_.begin() + static_cast<std::ptrdiff_t>(first), items_.end(),
              [](const ColumnItem& a, const ColumnItem& b) { return a.near_m < b.near_m; });
  }
}

}  // namespace seeker::sim
