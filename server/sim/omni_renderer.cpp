#include "server/sim/omni_renderer.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::sim {
namespace {

constexpr double kWhite = 255.0;
constexpr double kRobotGrey = 0.16;  ///< the robot's own deck
constexpr double kHoodGrey = 0.06;   ///< the camera's reflection
constexpr double kPixelAtHorizon_rad = 0.0062;

double textured(const Paint& paint, double u_texel, double v_texel, int level) {
  if (paint.contrast <= 0.0) {
    return paint.albedo;
  }
  return paint.albedo * (1.0 + paint.contrast * NoiseTexture::instance().at(u_texel, v_texel, level));
}

double textured_at(const Paint& paint, const Point2& p, int level) {
  return textured(paint, paint.u0_texel + p.x() * paint.texels_per_m, paint.v0_texel + p.y() * paint.texels_per_m,
                  level);
}

SensorModel sensor_of(const OmniModel& o) {
  return {o.width_px, o.height_px, o.noise_sigma, o.shot_noise, o.blur_sigma_px};
}

/// Brightness of the front of an item at height z.
double front(const ColumnItem& item, double z_m) {
  if (item.picture != nullptr) {
    const double t = (item.z_max_m - z_m) / (item.z_max_m - item.z_min_m);
    return item.light * item.paint->albedo * item.picture->at(item.picture_s, t, item.level);
  }
  const double v = item.paint->v0_texel + z_m * item.paint->texels_per_m;
  return item.light * textured(*item.paint, item.u_texel, v, item.level);
}

}  // namespace

double mirror_elevation_rad(const OmniModel& model, double radius_px) {
  // r (shape - sin e) = gain cos e  <=>  gain cos e + r sin e = r shape
  const double length = std::hypot(radius_px, model.gain_px);
  return std::atan2(radius_px, model.gain_px) - std::acos(std::min(1.0, radius_px * model.shape / length));
}

OmniRenderer::OmniRenderer(const RobotModel& model) : model_(model), chain_(sensor_of(model.omni)) {
  const OmniModel& o = model.omni;
  for (int v = 0; v < o.height_px; ++v) {
    for (int u = 0; u < o.width_px; ++u) {
      const double left = o.centre_u_px - u;
      const double up = o.centre_v_px - v;
      const double radius = std::hypot(left, up);
      if (radius > o.rim_px) {
        continue;
      }
      Pixel pixel{};
      pixel.index = static_cast<std::uint32_t>(v * o.width_px + u);
      pixel.column = static_cast<std::uint16_t>(OmniColumns::column_of(std::atan2(left, up)));
      const double elevation = mirror_elevation_rad(o, radius);
      // Straight down has no slope; the hood covers it.
      pixel.slope = radius <= o.hood_px ? -1e9F : static_cast<float>(std::tan(elevation));
      const double off_axis = radius / o.rim_px;
      pixel.gain = static_cast<float>(1.0 - o.vignetting * off_axis * off_axis);
      pixels_.push_back(pixel);
    }
  }
  picture_.resize(static_cast<std::size_t>(o.width_px) * static_cast<std::size_t>(o.height_px));
}

bool OmniRenderer::sees_robot(double slope) const {
  return slope < 0.0 && model_.omni.height_m + slope * model_.radius_m < model_.deck_height_m;
}

double OmniRenderer::brightness(const Pixel& pixel, const Scene& scene, const Lighting& lighting,
                                const CameraPose& camera) const {
  const double slope = pixel.slope;
  const double floor_m = slope < 0.0 ? -camera.height_m / slope : 1e9;
  const Point2& direction = columns_.direction(pixel.column);
  for (const ColumnItem* item = columns_.begin(pixel.column); item != columns_.end(pixel.column); ++item) {
    if (item->near_m > floor_m) {
      break;
    }
    const double z_near = camera.height_m + slope * item->near_m;
    if (item->front && z_near >= item->z_min_m && z_near <= item->z_max_m) {
      return front(*item, z_near);
    }
    const double z_far = camera.height_m + slope * item->far_m;
    const bool over = z_near > item->z_max_m && z_far < item->z_max_m;
    const bool under = z_near < item->z_min_m && z_far > item->z_min_m;
    if (over || under) {
      const double z = over ? item->z_max_m : item->z_min_m;
      const double distance_m = (z - camera.height_m) / slope;
      constexpr double kShadow = 0.55;  // light comes from above
      const double cover = textured_at(*item->cover, camera.position + distance_m * direction, item->level);
      return item->light * cover * (over ? 1.0 : kShadow);
    }
  }
  if (slope >= 0.0 || floor_m > kMaxWorldSide_m) {
    return lighting.gain * lighting.ceiling_albedo;
  }
  const Point2 p = camera.position + floor_m * direction;
  return light_at(lighting, p) * textured_at(scene.floor(), p, pixel.floor_level);
}

Image OmniRenderer::render(const Scene& scene, const Lighting& lighting, const Pose2& world_T_base, double exposure,
                           Rng& rng) {
  const Pose2 world_T_camera = world_T_base * model_.omni.base_T_camera;
  const CameraPose camera{world_T_camera.translation(), world_T_camera.theta_rad, model_.omni.height_m};
  if (floor_texels_per_m_ != scene.floor().texels_per_m) {
    floor_texels_per_m_ = scene.floor().texels_per_m;
    for (Pixel& pixel : pixels_) {
      const double footprint_m = camera.height_m / std::max(0.02, std::abs(static_cast<double>(pixel.slope)));
      pixel.floor_level = static_cast<std::uint8_t>(
          mip_level(footprint_m * kPixelAtHorizon_rad * floor_texels_per_m_, NoiseTexture::kLevels));
    }
  }
  columns_.build(scene, lighting, camera);
  for (const Pixel& pixel : pixels_) {
    double value = 0.0;
    if (pixel.slope < -1e8F) {
      value = kHoodGrey;
    } else if (sees_robot(pixel.slope)) {
      value = kRobotGrey;
    } else {
      value = brightness(pixel, scene, lighting, camera);
    }
    picture_[pixel.index] = static_cast<float>(kWhite * exposure * value) * pixel.gain;
  }
  return chain_.expose(picture_, rng);
}

}  // namespace seeker::sim
