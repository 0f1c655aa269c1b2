/// \file
/// Pictures of the omnidirectional camera (spec S3.1, S3.6): ray casting per azimuth, mirror profile, light and noise.
/// The renderer shares no code with the recogniser's geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/rng.hpp"
#include "server/sim/image_chain.hpp"
#include "server/sim/omni_columns.hpp"
#include "server/sim/robot_model.hpp"

namespace seeker::sim {

/// Elevation of the ray that the mirror reflects to a radius: the inverse of OmniModel's profile.
[[nodiscard]] double mirror_elevation_rad(const OmniModel& model, double radius_px);

class OmniRenderer {
 public:
  /// Makes a renderer for a valid model.
  explicit OmniRenderer(const RobotModel& model);

  /// Renders one picture; `exposure` scales all brightness.
  [[nodiscard]] Image render(const Scene& scene, const Lighting& lighting, const Pose2& world_T_base, double exposure,
                             Rng& rng);

 private:
  /// Precomputed values of one pixel inside the mirror.
  struct Pixel {
    std::uint32_t index;
    std::uint16_t column;
    std::uint8_t floor_level;  ///< mip level of the floor there
    float slope;               ///< tangent of the elevation
    float gain;                ///< vignetting
  };
  [[nodiscard]] double brightness(const Pixel& pixel, const Scene& scene, const Lighting& lighting,
                                  const CameraPose& camera) const;
  [[nodiscard]] bool sees_robot(double slope) const;

  RobotModel model_;
  std::vector<Pixel> pixels_;
  std::vector<float> picture_;  ///< before the sensor: the same size as the image
  OmniColumns columns_;
  ImageChain chain_;
  double floor_texels_per_m_ = 0.0;
};

}  // namespace seeker::sim
