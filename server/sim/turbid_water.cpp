#include "server/sim/turbid_water.hpp"

#include <cmath>

#include "common/core/angle.hpp"
#include "server/sim/tank_renderer.hpp"

namespace seeker::sim {

Image render_solid(const SolidView& view, const TurbidWater& water, Rng& rng) {
  const TankSolid solid{view.shape, Pose2{}, view.size_m, view.elongation, view.albedo};
  TankEye eye;
  const double level_m = view.distance_m * std::cos(view.elevation_rad);
  eye.position = {level_m * std::cos(view.yaw_rad), level_m * std::sin(view.yaw_rad),
                  half_height_m(solid) + view.distance_m * std::sin(view.elevation_rad)};
  eye.heading_rad = wrap_angle(view.yaw_rad + kPi);
  eye.tilt_rad = view.elevation_rad;
  eye.off_u_px = view.off_u_px;
  eye.off_v_px = view.off_v_px;
  return render_tank({solid}, eye, {}, water, rng);
}

SolidView draw_view(SolidKind shape, Rng& rng) {
  SolidView view;
  view.shape = shape;
  const bool prism = is_prism(shape);
  view.size_m = prism ? rng.uniform(0.14, 0.24) : rng.uniform(0.07, 0.13);
  view.elongation = prism ? rng.uniform(0.8, 1.6) : (shape == SolidKind::kEllipsoid ? rng.uniform(1.5, 2.2) : 1.0);
  view.yaw_rad = rng.uniform(-kPi, kPi);
  view.elevation_rad = rng.uniform(deg_to_rad(20.0), deg_to_rad(60.0));
  view.distance_m = rng.uniform(0.9, 1.3);
  view.off_u_px = rng.uniform(-90.0, 90.0);
  view.off_v_px = rng.uniform(-60.0, 60.0);
  view.albedo = rng.uniform(0.55, 0.9);
  return view;
}

TurbidWater draw_water(Rng& rng) {
  TurbidWater water;
  water.attenuation_per_m = rng.uniform(0.3, 1.0);
  water.veil = rng.uniform(0.12, 0.4);
  water.blur_px = rng.uniform(0.8, 2.2);
  water.noise = rng.uniform(2.0, 6.0);
  water.floor_albedo = rng.uniform(0.08, 0.22);
  water.ambient = rng.uniform(0.2, 0.45);
  water.lamp_right_m = rng.uniform(-0.3, 0.3);
  water.lamp_up_m = rng.uniform(0.1, 0.4);
  water.lamp_offset_u = rng.uniform(-0.5, 0.5);
  water.lamp_offset_v = rng.uniform(-0.5, 0.5);
  water.beam = rng.uniform(0.5, 2.5);
  water.gain = rng.uniform(0.9, 1.4);
  return water;
}

}  // namespace seeker::sim
