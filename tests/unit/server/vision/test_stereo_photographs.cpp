// Recordings of others (see tests/support/data.hpp): stereo pairs of real cameras.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "common/image/jpeg.hpp"
#include "server/vision/stereo_features.hpp"
#include "tests/support/data.hpp"

namespace seeker::vision {
namespace {

constexpr double kMaxDisparity_px = 260.0;  // the plant stands near

StereoGeometry geometry_of(const Image& picture) {
  StereoGeometry geometry;
  geometry.width_px = picture.width_px();
  geometry.height_px = picture.height_px();
  geometry.centre_u_px = 0.5 * geometry.width_px;
  geometry.centre_v_px = 0.5 * geometry.height_px;
  return geometry;
}

class Aloe : public ::testing::Test {
 protected:
  void SetUp() override {
    SEEKER_REQUIRE_DATA(folder, "vision/aloe");
    auto left = image::read_picture(folder / "aloeL.jpg");
    auto right = image::read_picture(folder / "aloeR.jpg");
    auto truth = image::read_picture(folder / "aloeGT.png");
    ASSERT_TRUE(left && right && truth);
    frame.left = std::move(*left);
    frame.right = std::move(*right);
    disparities = to_grey(*truth);
  }

  /// Features where the disparity is known, and how many lie within a pixel of it. The truth has steps of one pixel.
  struct Score {
    int known = 0;
    int within_1_px = 0;
  };
  [[nodiscard]] Score score(StereoFeatureParams params) const {
    params.match.max_disparity_px = kMaxDisparity_px;
    const auto found = make_stereo_extractor(geometry_of(frame.left), params)->extract(frame);
    EXPECT_TRUE(found.has_value()) << (found ? "" : found.error().message);
    Score out;
    for (const StereoFeature& f : found ? found->features : std::vector<StereoFeature>{}) {
      const int truth =
          *disparities.at(static_cast<int>(std::lround(f.left.u_px)), static_cast<int>(std::lround(f.left.v_px)));
      out.known += truth > 0 ? 1 : 0;
      out.within_1_px += truth > 0 && std::abs(f.disparity_px - truth) <= 1.0 ? 1 : 0;
    }
    std::printf("aloe: %d of %d features within 1 px of the truth (%.1f %%)\n", out.within_1_px, out.known,
                100.0 * out.within_1_px / std::max(1, out.known));
    return out;
  }

  StereoFrame frame;
  Image disparities;
};

TEST_F(Aloe, At1000KeyPointsNineteenOfTwentyMatchesAreTrue) {
  StereoFeatureParams params;
  params.detector.wanted = 1000;
  const Score s = score(params);
  EXPECT_GE(s.known, 400);
  EXPECT_GE(s.within_1_px, s.known * 95 / 100);
}

TEST_F(Aloe, ThePapersGatesDoAlmostAsWell) {
  StereoFeatureParams params = paper_stereo_params();
  params.detector.wanted = 1000;
  const Score s = score(params);
  EXPECT_GE(s.known, 300);
  EXPECT_GE(s.within_1_px, s.known * 93 / 100);
}

TEST_F(Aloe, SwappedEyesAreTold) {
  std::swap(frame.left, frame.right);
  const auto found = make_stereo_extractor(geometry_of(frame.left), {})->extract(frame);
  ASSERT_FALSE(found.has_value());
  EXPECT_NE(found.error().message.find("swap"), std::string::npos) << found.error().message;
}

}  // namespace
}  // namespace seeker::vision
