#include "server/options/camera_options.hpp"

#include <gtest/gtest.h>

#include "common/config/yaml.hpp"

namespace seeker::drivers {
namespace {

TEST(CameraOptions, AreReadFromYaml) {
  const auto document = config::Document::parse(
      "source: two-devices\n"
      "left: {device: /dev/video2, width_px: 1024, height_px: 768}\n"
      "right: {device: 'rtsp://camera/right'}\n"
      "calibration: stereo.yaml\n"
      "max_skew_s: 0.02\n"
      "reader: {max_age_s: 0.3}\n",
      "camera.yaml", {});
  ASSERT_TRUE(document) << document.error().message;
  StereoCameraParams params;
  const Status read = document->read(params);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(params.source, StereoSource::kTwoDevices);
  EXPECT_EQ(params.left.device, "/dev/video2");
  EXPECT_EQ(params.left.width_px, 1024);
  EXPECT_EQ(params.right.device, "rtsp://camera/right");
  EXPECT_EQ(params.calibration, "stereo.yaml");
  EXPECT_EQ(params.max_skew, std::chrono::milliseconds(20));
  EXPECT_EQ(params.reader.max_age, std::chrono::milliseconds(300));
}

TEST(CameraOptions, RefuseWhatNoCameraIs) {
  for (const char* text : {"source: four-devices\n", "left: {width_px: -1}\n", "reader: {kept: 0}\n", "device: x\n"}) {
    const auto document = config::Document::parse(text, "camera.yaml", {});
    ASSERT_TRUE(document);
    StereoCameraParams params;
    EXPECT_FALSE(document->read(params)) << text;
  }
}

}  // namespace
}  // namespace seeker::drivers
