/// \file
/// Pictures of a solid on the floor of a tank, in turbid water (spec S6), on which the recogniser of solids is trained
/// and tested: attenuation, veiling light, blur, noise and an uneven lamp.
#pragma once

#include "common/core/image.hpp"
#include "common/core/pose2.hpp"
#include "common/core/rng.hpp"
#include "common/core/solid.hpp"

namespace seeker::sim {

/// A solid on the floor of a tank, as part of a world.
struct TankSolid {
  SolidKind shape = SolidKind::kSphere;
  Pose2 world_T_solid;      ///< x axis: an ellipsoid's long axis, across a side of a prism
  double size_m = 0.1;      ///< as in SolidView
  double elongation = 1.0;  ///< as in SolidView
  double albedo = 0.75;
};

/// A solid and the direction from which it is seen.
struct SolidView {
  SolidKind shape = SolidKind::kSphere;
  double size_m = 0.15;        ///< radius of sphere and ellipsoid (the short axis); side of a prism's base
  double elongation = 1.0;     ///< ellipsoid: long over short axis, lying; prism: height over side, standing
  double yaw_rad = 0.0;        ///< angle about the vertical
  double elevation_rad = 0.7;  ///< elevation of the camera above the floor, seen from the solid
  double distance_m = 1.1;     ///< distance of the camera from the solid's middle
  double off_u_px = 0.0;       ///< offset of the solid's middle from the picture's middle
  double off_v_px = 0.0;
  double albedo = 0.75;
};

/// The water, the tank and the lamp, which stands beside the camera.
struct TurbidWater {
  double attenuation_per_m = 0.6;
  double veil = 0.25;    ///< brightness of water of unlimited depth
  double blur_px = 1.2;  ///< standard deviation of the blur
  double noise = 4.0;    ///< grey values
  double floor_albedo = 0.2;
  double ambient = 0.3;  ///< share of the light that comes from all sides
  double lamp_right_m = 0.2;
  double lamp_up_m = 0.3;
  double lamp_offset_u = 0.0;  ///< offset of the beam's centre, in half pictures from the middle
  double lamp_offset_v = 0.0;
  double beam = 1.5;  ///< narrowness of the beam, 0: even light
  double gain = 1.1;
};

inline constexpr int kTankWidth_px = 640;
inline constexpr int kTankHeight_px = 480;
inline constexpr double kTankFocal_px = 700.0;

/// Grey picture of kTankWidth_px x kTankHeight_px.
[[nodiscard]] Image render_solid(const SolidView& view, const TurbidWater& water, Rng& rng);

/// Draws a view of this shape (elevation 20 to 60 degrees, any heading, ellipsoids at least 1.5 times as long as
/// thick), and water of any quality in which a camera still sees the solid.
[[nodiscard]] SolidView draw_view(SolidKind shape, Rng& rng);
[[nodiscard]] TurbidWater draw_water(Rng& rng);

}  // namespace seeker::sim
