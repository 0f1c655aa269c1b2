#include "server/drivers/camera/cameras.hpp"

#include <algorithm>
#include <utility>

namespace seeker::drivers {
namespace {

Image crop_columns(const Image& picture, int first, int width) {
  const auto channels = static_cast<std::size_t>(picture.channels());
  Image out(width, picture.height_px(), picture.channels());
  for (int v = 0; v < picture.height_px(); ++v) {
    const auto from = picture.data().begin() + (picture.at(first, v) - picture.data().data());
    std::copy_n(from, static_cast<std::size_t>(width) * channels,
                out.data().begin() + (out.at(0, v) - out.data().data()));
  }
  return out;
}

/// Both eyes in each picture.
class SideBySideCamera final : public StereoDriver {
 public:
  SideBySideCamera(std::unique_ptr<PictureSource> source, Rectifier rectifier, const NowFunction& now,
                   const PictureReaderParams& params)
      : rectifier_(std::move(rectifier)), reader_("the stereo camera", std::move(source), now, params) {}

  Status activate() override {
    reader_.start();
    return {};
  }
  void deactivate() override { reader_.stop(); }

  Result<StereoFrame> grab() override {
    const Result<std::deque<CameraFrame>> frames = reader_.pictures();
    if (!frames) {
      return tl::unexpected<Error>(frames.error());
    }
    const Image& both = frames->back().image;
    if (both.width_px() % 2 != 0) {
      return fail(Errc::kInvalidArgument, "the stereo camera's pictures are " + std::to_string(both.width_px()) +
                                              " pixels wide, which two eyes cannot share; check its format");
    }
    const int width = both.width_px() / 2;
    return rectifier_.rectify(frames->back().stamp, crop_columns(both, 0, width), crop_columns(both, width, width));
  }
  const StereoGeometry& geometry() const override { return rectifier_.geometry(); }

 private:
  Rectifier rectifier_;
  PictureReader reader_;
};

/// The two pictures taken closest in time; of equal ones the newest.
struct Pairing {
  std::size_t left = 0;
  std::size_t right = 0;
  Duration skew = Duration::max();
};
Pairing closest(const std::deque<CameraFrame>& left, const std::deque<CameraFrame>& right) {
  Pairing best;
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t j = 0; j < right.size(); ++j) {
      const Duration skew = std::chrono::abs(left[i].stamp - right[j].stamp);
      if (skew <= best.skew) {
        best = {i, j, skew};
      }
    }
  }
  return best;
}

/// One device an eye. They run freely, so that pictures of one moment have to be found.
class TwoDeviceCamera final : public StereoDriver {
 public:
  TwoDeviceCamera(std::unique_ptr<PictureSource> left, std::unique_ptr<PictureSource> right, Rectifier rectifier,
                  const NowFunction& now, const StereoCameraParams& params)
      : rectifier_(std::move(rectifier)),
        left_("the left camera", std::move(left), now, params.reader),
        right_("the right camera", std::move(right), now, params.reader),
        max_skew_(params.max_skew) {}

  Status activate() override {
    left_.start();
    right_.start();
    return {};
  }
  void deactivate() override {
    left_.stop();
    right_.stop();
  }

  Result<StereoFrame> grab() override {
    const Result<std::deque<CameraFrame>> left = left_.pictures();
    if (!left) {
      return tl::unexpected<Error>(left.error());
    }
    const Result<std::deque<CameraFrame>> right = right_.pictures();
    if (!right) {
      return tl::unexpected<Error>(right.error());
    }
    const Pairing pair = closest(*left, *right);
    if (pair.skew > max_skew_) {
      const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(pair.skew).count();
      return fail(Errc::kTimeout, "the pictures of the left and the right camera are " + std::to_string(ms) +
                                      " ms apart; use cameras with a common trigger, or the same rate and exposure");
    }
    const CameraFrame& l = (*left)[pair.left];
    const CameraFrame& r = (*right)[pair.right];
    return rectifier_.rectify(std::min(l.stamp, r.stamp), l.image, r.image);
  }
  const StereoGeometry& geometry() const override { return rectifier_.geometry(); }

 private:
  Rectifier rectifier_;
  PictureReader left_;
  PictureReader right_;
  Duration max_skew_;
};

/// Recorded pairs, one a call.
class FolderCamera final : public StereoDriver {
 public:
  FolderCamera(std::vector<ImagePair> pairs, bool repeat, Rectifier rectifier, NowFunction now)
      : pairs_(std::move(pairs)), repeat_(repeat), rectifier_(std::move(rectifier)), now_(std::move(now)) {}

  Status activate() override {
    active_ = true;
    next_ = 0;
    return {};
  }
  void deactivate() override { active_ = false; }

  Result<StereoFrame> grab() override {
    if (!active_) {
      return fail(Errc::kNotReady, "the camera of recorded pictures is not active; activate it first");
    }
    if (next_ == pairs_.size() && repeat_) {
      next_ = 0;
    }
    if (next_ == pairs_.size()) {
      return fail(Errc::kCancelled, "all " + std::to_string(pairs_.size()) + " recorded pairs have been played");
    }
    const ImagePair& pair = pairs_[next_++];
    const Result<PairPictures> pictures = read_pair(pair);
    if (!pictures) {
      return tl::unexpected<Error>(pictures.error());
    }
    Result<StereoFrame> frame = rectifier_.rectify(now_(), pictures->left, pictures->right);
    if (!frame) {
      return fail_with_context("pair '" + pair.name + "'", frame.error());
    }
    return frame;
  }
  const StereoGeometry& geometry() const override { return rectifier_.geometry(); }

 private:
  std::vector<ImagePair> pairs_;
  bool repeat_;
  Rectifier rectifier_;
  NowFunction now_;
  bool active_ = false;
  std::size_t next_ = 0;
};

Result<Rectifier> make_rectifier(const StereoCameraParams& params) {
  if (params.calibration.empty()) {
    return Rectifier::none(params.geometry);
  }
  const Result<StereoCalibration> calibration = read_stereo_calibration(params.calibration);
  if (!calibration) {
    return tl::unexpected<Error>(calibration.error());
  }
  return Rectifier::create(*calibration);
}

}  // namespace

CaptureCamera::CaptureCamera(std::unique_ptr<PictureSource> source, NowFunction now, const PictureReaderParams& params)
    : reader_("the camera", std::move(source), std::move(now), params) {}

Status CaptureCamera::activate() {
  reader_.start();
  return {};
}

void CaptureCamera::deactivate() { reader_.stop(); }

Result<CameraFrame> CaptureCamera::grab() {
  Result<std::deque<CameraFrame>> frames = reader_.pictures();
  if (!frames) {
    return tl::unexpected<Error>(frames.error());
  }
  return std::move(frames->back());
}

Result<std::unique_ptr<StereoDriver>> make_stereo_camera(const StereoCameraParams& params, NowFunction now) {
  Result<Rectifier> rectifier = make_rectifier(params);
  if (!rectifier) {
    return tl::unexpected<Error>(rectifier.error());
  }
  if (params.max_skew <= Duration::zero() || params.reader.max_age <= Duration::zero()) {
    return fail(Errc::kInvalidArgument, "a stereo camera needs times above 0 for max_skew and max_age");
  }
  if (params.source == StereoSource::kFiles) {
    Result<std::vector<ImagePair>> pairs = list_image_pairs(params.files);
    if (!pairs) {
      return tl::unexpected<Error>(pairs.error());
    }
    return std::make_unique<FolderCamera>(std::move(*pairs), params.repeat_files, std::move(*rectifier),
                                          std::move(now));
  }
  std::vector<std::unique_ptr<PictureSource>> sources;
  sources.push_back(make_capture_source(params.left));
  if (params.source == StereoSource::kTwoDevices) {
    sources.push_back(make_capture_source(params.right));
  }
  return make_stereo_camera(std::move(sources), params, std::move(*rectifier), now);
}

std::unique_ptr<StereoDriver> make_stereo_camera(std::vector<std::unique_ptr<PictureSource>> sources,
                                                 const StereoCameraParams& params, Rectifier rectifier,
                                                 const NowFunction& now) {
  SEEKER_ASSERT(sources.size() == 1 || sources.size() == 2);
  if (sources.size() == 1) {
    return std::make_unique<SideBySideCamera>(std::move(sources[0]), std::move(rectifier), now, params.reader);
  }
  return std::make_unique<TwoDeviceCamera>(std::move(sources[0]), std::move(sources[1]), std::move(rectifier), now,
                                           params);
}

}  // namespace seeker::drivers
