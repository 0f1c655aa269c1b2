#include "server/drivers/camera/capture_source.hpp"

#include <cstring>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

namespace seeker::drivers {
namespace {

constexpr int kNetworkTimeout_ms = 4000;

bool starts_with(const std::string& text, const char* prefix) { return text.rfind(prefix, 0) == 0; }

/// Blue, green, red to our order; grey stays grey.
Result<Image> to_image(const cv::Mat& picture) {
  if (picture.depth() != CV_8U || (picture.channels() != 1 && picture.channels() != 3)) {
    return fail(Errc::kIo, "the camera gives pictures that are neither 8-bit grey nor colour; choose another format");
  }
  if (picture.cols > kMaxImageSide_px || picture.rows > kMaxImageSide_px) {
    return fail(Errc::kTooLarge, "the camera gives pictures of more than 8192 pixels on a side; choose a smaller size");
  }
  const auto channels = static_cast<std::size_t>(picture.channels());
  const std::size_t row_bytes = static_cast<std::size_t>(picture.cols) * channels;
  Image image(picture.cols, picture.rows, picture.channels());
  for (int v = 0; v < picture.rows; ++v) {
    std::uint8_t* out = image.data().data() + static_cast<std::size_t>(v) * row_bytes;
    std::memcpy(out, picture.ptr(v), row_bytes);
    for (std::size_t u = 0; channels == 3 && u < row_bytes; u += channels) {
      std::swap(out[u], out[u + 2]);
    }
  }
  return image;
}

class CaptureSource final : public PictureSource {
 public:
  explicit CaptureSource(CaptureParams params) : params_(std::move(params)) {}

  Status open() override {
    try {
      const std::vector<int> timeouts{cv::CAP_PROP_OPEN_TIMEOUT_MSEC, kNetworkTimeout_ms,
                                      cv::CAP_PROP_READ_TIMEOUT_MSEC, kNetworkTimeout_ms};
      if (is_device()) {
        capture_.open(params_.device, cv::CAP_V4L2);
        ask(cv::CAP_PROP_FRAME_WIDTH, params_.width_px);
        ask(cv::CAP_PROP_FRAME_HEIGHT, params_.height_px);
        ask(cv::CAP_PROP_FPS, params_.rate_hz);
      } else if (is_on_network()) {
        capture_.open(params_.device, cv::CAP_FFMPEG, timeouts);
      } else {
        capture_.open(params_.device, cv::CAP_ANY);
      }
    } catch (const cv::Exception&) {
      capture_.release();
    }
    if (!capture_.isOpened()) {
      return fail(Errc::kNotFound, "cannot open the camera '" + params_.device +
                                       "'; check its name, its cable or network, and that no other program has it");
    }
    return {};
  }

  Result<Image> read() override {
    cv::Mat picture;
    bool got = false;
    try {
      got = capture_.read(picture);
    } catch (const cv::Exception&) {
      got = false;
    }
    if (!got || picture.empty()) {
      return fail(Errc::kIo, "the camera '" + params_.device + "' gives no more pictures; check its cable or network");
    }
    return to_image(picture);
  }

  void close() override { capture_.release(); }
  [[nodiscard]] bool comes_back() const override { return is_device() || is_on_network(); }

 private:
  [[nodiscard]] bool is_device() const { return starts_with(params_.device, "/dev/"); }
  [[nodiscard]] bool is_on_network() const { return params_.device.find("://") != std::string::npos; }
  void ask(cv::VideoCaptureProperties property, double value) {
    if (capture_.isOpened() && value > 0.0) {
      capture_.set(property, value);  // whether it obeys shows in the pictures' size
    }
  }

  CaptureParams params_;
  cv::VideoCapture capture_;
};

}  // namespace

std::unique_ptr<PictureSource> make_capture_source(const CaptureParams& params) {
  return std::make_unique<CaptureSource>(params);
}

}  // namespace seeker::drivers
