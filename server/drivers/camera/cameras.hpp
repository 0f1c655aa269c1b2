/// \file
/// Real cameras and recorded pictures behind the driver interfaces.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/core/stereo.hpp"
#include "server/drivers/camera/capture_source.hpp"
#include "server/drivers/camera/image_folder.hpp"
#include "server/drivers/camera/picture_reader.hpp"
#include "server/drivers/camera/stereo_calibration.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::drivers {

/// One camera: a device, a URL or a video file.
class CaptureCamera final : public CameraDriver {
 public:
  CaptureCamera(std::unique_ptr<PictureSource> source, NowFunction now, const PictureReaderParams& params);
  /// Starts opening the device; grab() fails with kNotReady until the device has given a picture.
  [[nodiscard]] Status activate() override;
  void deactivate() override;
  [[nodiscard]] Result<CameraFrame> grab() override;
  [[nodiscard]] const PictureReader& reader() const { return reader_; }

 private:
  PictureReader reader_;
};

enum class StereoSource : std::uint8_t {
  kSideBySide,  ///< one device whose pictures hold both eyes, the left one on the left
  kTwoDevices,  ///< one device for each eye
  kFiles,       ///< a folder of picture pairs, played one after another
};

struct StereoCameraParams {
  StereoSource source = StereoSource::kSideBySide;
  CaptureParams left;  ///< left camera, or the only device where both eyes come from one
  CaptureParams right;
  ImageFolderParams files;
  bool repeat_files = false;  ///< start again after the last pair
  /// File of the calibration; empty: the pictures are rectified and have `geometry`.
  std::filesystem::path calibration;
  StereoGeometry geometry;
  Duration max_skew = std::chrono::milliseconds(15);  ///< largest time between two devices' pictures of one moment
  PictureReaderParams reader;
};

/// Makes a stereo camera. Errors: those of read_stereo_calibration() and list_image_pairs(); kInvalidArgument. Devices
/// are opened by activate().
[[nodiscard]] Result<std::unique_ptr<StereoDriver>> make_stereo_camera(const StereoCameraParams& params,
                                                                       NowFunction now);
/// The same for existing sources: one for both eyes, or one for each eye.
[[nodiscard]] std::unique_ptr<StereoDriver> make_stereo_camera(std::vector<std::unique_ptr<PictureSource>> sources,
                                                               const StereoCameraParams& params, Rectifier rectifier,
                                                               const NowFunction& now);

}  // namespace seeker::drivers
