/// \file
/// Pictures of a solid on the floor of a tank, in turbid water (spec S6): what the recogniser of solids is trained and
/// tested on. Attenuation, veiling light, blur, noise and an uneven lamp.
#pragma once

#include "common/core/image.hpp"
#include "common/core/pose2.hpp"
#include "common/core/rng.hpp"
#include "common/core/solid.hpp"

namespace seeker::sim {

/// A solid on the floor of a tank, as a world has it.
struct TankSolid {
  SolidKind shape = SolidKind::kSphere;
  Pose2 world_T_solid;      ///< x axis: an ellipsoid's long axis, across a side of a prism
  double size_m = 0.1;      ///< as in SolidView
  double elongation = 1.0;  ///< as in SolidView
  double albedo = 0.75;
};

/// A solid as it lies, and from where it is seen.
struct SolidView {
  SolidKind shape = SolidKind::kSphere;
  double size_m = 0.15;        ///< radius of sphere and ellipsoid (the short axis); side of a prism's base
  double elongation = 1.0;     ///< ellipsoid: long over short axis, lying; prism: height over side, standing
  double yaw_rad = 0.0;        ///< about the vertical
  double elevation_rad = 0.7;  ///< of the camera above the floor, seen from the solid
  double distance_m = 1.1;     ///< of the camera from the solid's middle
  double off_u_px = 0.0;       ///< of the solid's middle from the picture's middle
  double off_v_px = 0.0;
  double albedo = 0.75;
};

/// The water, the tank and the lamp, which stands beside the camera.
struct TurbidWater {
  double attenuation_per_m = 0.6;
  double veil = 0.25;    ///< brightness of endless water
  double blur_px = 1.2;  ///< sigma
  double noise = 4.0;    ///< grey values
  double floor_albedo = 0.2;
  double ambient = 0.3;  ///< share of the light that comes from all sides
  double lamp_right_m = 0.2;
  double lamp_up_m = 0.3;
  double lamp_turn_u = 0.0;  ///< where its beam points to, in half pictures off the middle
  double lamp_turn_v = 0.0;
  double beam = 1.5;  ///< narrowness of the beam, 0: even light
  double gain = 1.1;
};

inline constexpr int kTankWidth_px = 640;
inline constexpr int kTankHeight_px = 480;
inline constexpr double kTankFocal_px = 700.0;

/// Grey picture of kTankWidth_px x kTankHeight_px.
[[nodiscard]] Image render_solid(const SolidView& view, const TurbidWater& water, Rng& rng);

/// Draws a view of this shape (elevation 20 to 60 degrees, any heading, ellipsoids at least 1.5 times as long as thick)
/// and water of any quality that a camera still sees something in.
[[nodiscard]] SolidView draw_view(SolidKind shape, Rng& rng);
[[nodiscard]] TurbidWater draw_water(Rng& rng);

}  // namespace seeker::sim
