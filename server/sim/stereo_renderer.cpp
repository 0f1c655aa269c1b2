#include "server/sim/stereo_renderer.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::sim {
namespace {

constexpr double kWhite = 255.0;
constexpr std::size_t kPerPixel = EyeView::kPerPixel;

SensorModel sensor_of(const StereoModel& m, const EyeErrors& errors) {
  return {m.geometry.width_px, m.geometry.height_px, m.noise_sigma, m.shot_noise, m.blur_sigma_px, errors.gamma};
}

}  // namespace

StereoRenderer::Eye::Eye(const StereoModel& model, const EyeErrors& eye_errors, const Pose2& mounting)
    : errors(eye_errors), base_T_eye(mounting), view(model.geometry, eye_errors), chain(sensor_of(model, eye_errors)) {}

StereoRenderer::StereoRenderer(const StereoModel& model)
    : model_(model),
      eyes_{Eye(model, model.left, model.base_T_left_eye),
            Eye(model, model.right, model.base_T_left_eye * Pose2{0.0, -model.geometry.baseline_m, 0.0})} {
  light_.resize(static_cast<std::size_t>(model.geometry.width_px) * static_cast<std::size_t>(model.geometry.height_px));
}

StereoFrame StereoRenderer::render(const Scene& scene, const Lighting& lighting, const Pose2& world_T_base,
                                   double exposure, Rng& rng) {
  StereoFrame frame;
  frame.left = picture(eyes_[0], scene, lighting, world_T_base, exposure, rng);
  frame.right = picture(eyes_[1], scene, lighting, world_T_base, exposure, rng);
  return frame;
}

double StereoRenderer::paint_at(const Patch& patch, const Point2& p, double z_m, double footprint_m) {
  const Point2 from_corner = p - patch.corner;
  const double along_m = patch.axis.dot(from_corner);
  if (patch.picture != nullptr) {
    const double texels = footprint_m * patch.picture->width_px() / patch.length_m;
    const double t = (patch.z_max_m - z_m) / (patch.z_max_m - patch.z_min_m);
    return patch.paint->albedo * static_cast<double>(patch.picture->at(along_m / patch.length_m, t,
                                                                       mip_level(texels, patch.picture->levels())));
  }
  if (patch.paint->contrast <= 0.0) {
    return patch.paint->albedo;
  }
  const double across_m = patch.upright ? z_m : patch.axis.x() * from_corner.y() - patch.axis.y() * from_corner.x();
  const double noise = static_cast<double>(
      pattern_.at(patch.pattern, patch.paint->along0_m + along_m, across_m, patch.pattern.level_of(footprint_m)));
  return patch.paint->albedo * (1.0 + patch.paint->contrast * noise);
}

double StereoRenderer::shade(const EyeView& view, const Lighting& lighting, std::int32_t index, double ray_x,
                             double ray_y) {
  if (index == SampleRow::kNothing) {
    return lighting.gain * lighting.ceiling_albedo;
  }
  const Patch& patch = view.patches()[static_cast<std::size_t>(index)];
  const double inverse_depth =
      static_cast<double>(patch.inverse_depth.at(static_cast<float>(ray_x), static_cast<float>(ray_y)));
  const double depth_m = 1.0 / inverse_depth;
  const Point2 p = view.eye().position + depth_m * view.heading_of(ray_x);
  // A pixel covers depth^3 / (distance of the plane * f^2) of a plane.
  const double footprint_m = depth_m * std::sqrt(depth_m / patch.plane_m) / model_.geometry.focal_px;
  return light_at(lighting, p) * patch.light * paint_at(patch, p, view.eye().height_m + depth_m * ray_y, footprint_m);
}

double StereoRenderer::pixel(const EyeView& view, const Lighting& lighting, std::size_t u) {
  const std::size_t first = u * kPerPixel;
  const std::int32_t seen = rows_[0].patch[first];
  bool same = true;
  double ray_x = 0.0;
  double ray_y = 0.0;
  for (const SampleRow& row : rows_) {
    for (std::size_t i = first; i < first + kPerPixel; ++i) {
      same = same && row.patch[i] == seen;
      ray_x += static_cast<double>(row.ray_x[i]);
      ray_y += static_cast<double>(row.ray_y[i]);
    }
  }
  constexpr double kShare = 1.0 / (kPerPixel * kPerPixel);
  if (same) {  // the pattern's levels are smooth at the size of a pixel: one look is enough
    return shade(view, lighting, seen, kShare * ray_x, kShare * ray_y);
  }
  double sum = 0.0;
  for (const SampleRow& row : rows_) {
    for (std::size_t i = first; i < first + kPerPixel; ++i) {
      sum += shade(view, lighting, row.patch[i], static_cast<double>(row.ray_x[i]), static_cast<double>(row.ray_y[i]));
    }
  }
  return kShare * sum;
}

Image StereoRenderer::picture(Eye& eye, const Scene& scene, const Lighting& lighting, const Pose2& world_T_base,
                              double exposure, Rng& rng) {
  const Pose2 world_T_eye = world_T_base * eye.base_T_eye;
  eye.view.build(scene, {world_T_eye.translation(), world_T_eye.theta_rad, model_.height_m});
  const double jitter = std::max(0.0, 1.0 + rng.normal(model_.exposure_jitter));
  const double white = kWhite * exposure * eye.errors.gain * jitter;
  const StereoGeometry& g = model_.geometry;
  const double corner2 =
      0.25 * (static_cast<double>(g.width_px) * g.width_px + static_cast<double>(g.height_px) * g.height_px);
  std::size_t at = 0;
  for (int v = 0; v < g.height_px; ++v) {
    for (std::size_t s = 0; s < kPerPixel; ++s) {
      eye.view.look(v * EyeView::kPerPixel + static_cast<int>(s), rows_[s]);
    }
    const double dv2 = (v - g.centre_v_px) * (v - g.centre_v_px);
    for (int u = 0; u < g.width_px; ++u) {
      const double du = u - g.centre_u_px;
      const double vignette = 1.0 - eye.errors.vignetting * (du * du + dv2) / corner2;
      light_[at++] = static_cast<float>(white * vignette * pixel(eye.view, lighting, static_cast<std::size_t>(u)));
    }
  }
  return eye.chain.expose(light_, rng);
}

}  // namespace seeker::sim
