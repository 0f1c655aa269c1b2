/// \file
/// Pictures of the stereo camera (spec S2.2): pinhole eyes and textured surfaces (vision.md 4.5). The renderer shares
/// no code with the estimator's geometry.
#pragma once

#include <array>
#include <vector>

#include "common/core/rng.hpp"
#include "common/core/stereo.hpp"
#include "server/sim/eye_view.hpp"
#include "server/sim/image_chain.hpp"
#include "server/sim/pattern.hpp"

namespace seeker::sim {

class StereoRenderer {
 public:
  /// Makes a renderer for a valid model.
  explicit StereoRenderer(const StereoModel& model);

  /// Renders both eyes; `exposure` scales all brightness. The caller sets the stamp.
  [[nodiscard]] StereoFrame render(const Scene& scene, const Lighting& lighting, const Pose2& world_T_base,
                                   double exposure, Rng& rng);

 private:
  /// One eye and the parts of its picture.
  struct Eye {
    Eye(const StereoModel& model, const EyeErrors& errors, const Pose2& base_T_eye);
    EyeErrors errors;
    Pose2 base_T_eye;
    EyeView view;
    ImageChain chain;
  };
  [[nodiscard]] Image picture(Eye& eye, const Scene& scene, const Lighting& lighting, const Pose2& world_T_base,
                              double exposure, Rng& rng);
  /// Brightness of the surface that a ray meets, 1: white.
  [[nodiscard]] double shade(const EyeView& view, const Lighting& lighting, std::int32_t patch, double ray_x,
                             double ray_y);
  [[nodiscard]] double paint_at(const Patch& patch, const Point2& p, double z_m, double footprint_m);
  [[nodiscard]] double pixel(const EyeView& view, const Lighting& lighting, std::size_t u);

  StereoModel model_;
  std::array<Eye, 2> eyes_;  ///< left, right
  Pattern pattern_;
  std::array<SampleRow, EyeView::kPerPixel> rows_;
  std::vector<float> light_;  ///< light of the picture, before the sensor
};

}  // namespace seeker::sim
