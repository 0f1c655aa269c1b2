/// \file
/// Pictures of a video device, a network camera or a video file, through OpenCV.
#pragma once

#include <memory>
#include <string>

#include "server/drivers/camera/picture_reader.hpp"

namespace seeker::drivers {

struct CaptureParams {
  std::string device = "/dev/video0";  ///< V4L2 device, URL (rtsp, http), video file, or pictures as `name_%03d.png`
  int width_px = 0;                    ///< requested from a V4L2 device; 0: the device's default
  int height_px = 0;
  double rate_hz = 0.0;  ///< requested from a V4L2 device; 0: the device's default
};

[[nodiscard]] std::unique_ptr<PictureSource> make_capture_source(const CaptureParams& params);

}  // namespace seeker::drivers
