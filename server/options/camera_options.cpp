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

namespace seeker::drivers {

void describe(config::Fields& f, CaptureParams& params) {
  f.field("device", params.device);
  f.field("width_px", params.width_px);
  f.field("height_px", params.height_px);
  f.field("rate_hz", params.rate_hz);
  f.check("width_px", params.width_px >= 0 && params.height_px >= 0 && params.rate_hz >= 0.0,
          "width_px, height_px and rate_hz must be 0 (what the camera likes) or more");
}

void describe(config::Fields& f, ImageFolderParams& params) {
  std::string folder = params.folder.string();
  f.field("folder", folder);
  params.folder = folder;
  f.field("left_pattern", params.left_pattern);
  f.field("right_pattern", params.right_pattern);
  f.field("poses", params.poses);
}

void describe(config::Fields& f, PictureReaderParams& params) {
  f.seconds("max_age_s", params.max_age);
  f.seconds("first_picture_s", params.first_picture);
  f.seconds("reopen_after_s", params.reopen_after);
  auto kept = static_cast<std::uint64_t>(params.kept);
  f.field("kept", kept);
  constexpr std::uint64_t kMost = 100;
  f.check("kept", kept >= 1 && kept <= kMost, "must be from 1 to 100");
  params.kept = kept;
}

void describe(config::Fields& f, StereoCameraParams& params) {
  f.choice("source", params.source,
           config::Choices<StereoSource>{{"side-by-side", StereoSource::kSideBySide},
                                         {"two-devices", StereoSource::kTwoDevices},
                                         {"files", StereoSource::kFiles}});
  f.section("left", params.left);
  f.section("right", params.right);
  f.section("files", params.files);
  f.field("repeat_files", params.repeat_files);
  std::string calibration = params.calibration.string();
  f.field("calibration", calibration);
  params.calibration = calibration;
  f.section("geometry", params.geometry);
  f.seconds("max_skew_s", params.max_skew);
  f.section("reader", params.reader);
}

}  // namespace seeker::drivers
