#include "server/options/camera_options.hpp"

namespace seeker {

void describe(config::Fields& f, StereoGeometry& geometry) {
  f.field("width_px", geometry.width_px);
  f.field("height_px", geometry.height_px);
  f.field("focal_px", geometry.focal_px);
  f.field("centre_u_px", geometry.centre_u_px);
  f.field("centre_v_px", geometry.centre_v_px);
  f.field("baseline_m", geometry.baseline_m);
}

}  // namespace seeker
