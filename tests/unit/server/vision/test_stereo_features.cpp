#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "server/vision/stereo_features.hpp"
#include "stereo_scenes.hpp"

namespace seeker::vision {
namespace {

using testing::banded_pair;
using testing::small_camera;

const std::vector<double> kBands = {10.3, 21.75, 40.0, 63.5, 90.1};

Result<StereoFeatures> extract(const StereoFrame& frame, const StereoFeatureParams& params = {}) {
  return make_stereo_extractor(small_camera(), params)->extract(frame);
}

/// Differences of the found disparities to the true ones.
std::vector<double> errors(const StereoFeatures& found) {
  std::vector<double> out;
  for (const StereoFeature& f : found.features) {
    const double v = f.left.v_px;
    const double band = v / small_camera().height_px * static_cast<double>(kBands.size());
    const double from_edge = std::abs(band - std::round(band));
    if (from_edge > 0.12) {  // windows across the edge of a band see two disparities
      out.push_back(f.disparity_px - testing::band_disparity(small_camera(), kBands, v));
    }
  }
  return out;
}

double share_within(const std::vector<double>& errors_px, double limit_px) {
  const auto good =
      std::count_if(errors_px.begin(), errors_px.end(), [&](double e) { return std::abs(e) <= limit_px; });
  return static_cast<double>(good) / static_cast<double>(errors_px.size());
}

double rms_of_good(std::vector<double> errors_px) {
  std::erase_if(errors_px, [](double e) { return std::abs(e) > 1.0; });
  double squares = 0.0;
  for (const double e : errors_px) {
    squares += e * e;
  }
  return std::sqrt(squares / static_cast<double>(errors_px.size()));
}

TEST(StereoFeatures, DisparitiesAreTrueToAnEighthOfAPixel) {
  Rng rng(21);
  const auto found = extract(banded_pair(small_camera(), kBands, rng));
  ASSERT_TRUE(found.has_value()) << found.error().message;
  const std::vector<double> e = errors(*found);
  std::printf("default: %zu features of %d and %d key points, %zu alike, %.3f within 1 px, RMS %.3f px\n",
              found->features.size(), found->left_keypoints, found->right_keypoints, found->before_constraints.size(),
              share_within(e, 1.0), rms_of_good(e));
  EXPECT_GE(found->features.size(), 150U);
  EXPECT_GE(share_within(e, 1.0), 0.98);
  EXPECT_LE(rms_of_good(e), 0.125);
}

TEST(StereoFeatures, CorrelationRefinesTheKeyPointsDisparity) {
  StereoFeatureParams rough;
  rough.match.refine_disparity = false;
  Rng rng(22);
  const StereoFrame frame = banded_pair(small_camera(), kBands, rng);
  const auto plain = extract(frame, rough);
  const auto refined = extract(frame);
  ASSERT_TRUE(plain && refined);
  EXPECT_LT(rms_of_good(errors(*refined)), 0.7 * rms_of_good(errors(*plain)));
}

TEST(StereoFeatures, HalfResolutionGivesPositionsInFullPixels) {
  StereoFeatureParams params;
  params.detector.half_resolution = true;
  params.detector.wanted = 200;
  Rng rng(23);
  const auto found = extract(banded_pair(small_camera(), kBands, rng), params);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  const std::vector<double> e = errors(*found);
  EXPECT_GE(found->features.size(), 40U);
  EXPECT_GE(share_within(e, 1.0), 0.97);
  EXPECT_LE(rms_of_good(e), 0.12);
}

TEST(StereoFeatures, ThePapersGatesMatchToo) {
  Rng rng(24);
  StereoFeatureParams params = paper_stereo_params();
  params.match.max_disparity_px = 200.0;  // most bands are nearer than the paper's limit
  const auto found = extract(banded_pair(small_camera(), kBands, rng), params);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_GE(found->features.size(), 100U);
  EXPECT_GE(share_within(errors(*found), 1.0), 0.95);
}

TEST(StereoFeatures, ThePapersDisparityLimitDropsWhatIsNear) {
  Rng rng(25);
  const auto found = extract(banded_pair(small_camera(), kBands, rng), paper_stereo_params());
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_GE(found->features.size(), 10U);
  for (const StereoFeature& f : found->features) {
    EXPECT_GT(f.disparity_px, 0.0);
    EXPECT_LT(f.disparity_px, 20.0);
  }
}

TEST(StereoFeatures, KeepsOnePointAPlaceAndNoMoreThanWanted) {
  Rng rng(26);
  const StereoFrame frame = banded_pair(small_camera(), kBands, rng);
  StereoFeatureParams params;
  params.detector.wanted = 150;
  const auto list = make_stereo_extractor(small_camera(), params)->detect(frame.left);
  ASSERT_TRUE(list.has_value());
  EXPECT_LE(list->size(), 150U);
  EXPECT_GE(list->size(), 130U);  // a few places have several orientations
  EXPECT_EQ(list->descriptors.size(), list->size());
  for (std::size_t i = 0; i < list->size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Keypoint& a = list->keypoints[i];
      const Keypoint& b = list->keypoints[k];
      EXPECT_FALSE(std::abs(a.u_px - b.u_px) < 0.5F && std::abs(a.v_px - b.v_px) < 0.5F);
    }
  }
}

TEST(StereoFeatures, KeyPointsSitInTheMiddleOfBlobs) {
  cv::Mat picture(200, 240, CV_8UC1, cv::Scalar(90));
  const cv::Point2d centre(120.3, 99.6);
  constexpr double kSigma_px = 4.0;
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const double r2 = (u - centre.x) * (u - centre.x) + (v - centre.y) * (v - centre.y);
      picture.at<std::uint8_t>(v, u) =
          cv::saturate_cast<std::uint8_t>(90 + 140 * std::exp(-r2 / (2 * kSigma_px * kSigma_px)));
    }
  }
  const auto list = make_stereo_extractor(small_camera(), {})->detect(to_image(picture));
  ASSERT_TRUE(list.has_value());
  ASSERT_FALSE(list->keypoints.empty());
  EXPECT_NEAR(list->keypoints[0].u_px, centre.x, 0.05);
  EXPECT_NEAR(list->keypoints[0].v_px, centre.y, 0.05);
  EXPECT_NEAR(list->keypoints[0].scale_px, kSigma_px, 0.25 * kSigma_px);
}

TEST(StereoFeatures, OrientationGrowsCounterClockwiseAsSeen) {
  Rng rng(27);
  const cv::Mat texture = testing::rich_texture(300, 300, rng);
  cv::Mat turned;
  cv::rotate(texture, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  const auto extractor = make_stereo_extractor(small_camera(), {});
  const auto before = extractor->detect(to_image(texture));
  const auto after = extractor->detect(to_image(turned));
  ASSERT_TRUE(before && after);
  int agreeing = 0;
  int pairs = 0;
  for (const Keypoint& a : before->keypoints) {
    for (const Keypoint& b : after->keypoints) {
      // (u, v) comes to lie at (v, 299 - u).
      if (std::hypot(b.u_px - a.v_px, b.v_px - (299.0F - a.u_px)) < 0.3F && std::abs(b.scale_px - a.scale_px) < 0.1F) {
        ++pairs;
        agreeing += std::abs(wrap_angle(b.orientation_rad - a.orientation_rad - kPi / 2.0)) < 0.1 ? 1 : 0;
      }
    }
  }
  EXPECT_GE(pairs, 100);
  EXPECT_GE(agreeing, pairs * 3 / 4);  // the others have several main directions
}

TEST(StereoFeatures, ABareWallGivesNoFeaturesAndNoFault) {
  Rng rng(28);
  StereoFrame frame;
  for (Image* eye : {&frame.left, &frame.right}) {
    cv::Mat wall = testing::plain_ground(small_camera().width_px, small_camera().height_px, 140);
    testing::degrade(wall, 0.0, 2.0, rng);
    *eye = to_image(wall);
  }
  const auto found = extract(frame);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_LE(found->features.size(), 5U);
}

TEST(StereoFeatures, PicturesTooSmallForAKeyPointHaveNone) {
  StereoFeatureParams half;
  half.detector.half_resolution = true;
  for (const StereoFeatureParams& params : {StereoFeatureParams{}, half}) {
    const auto extractor = make_stereo_extractor(small_camera(), params);
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(300, 1), std::pair(15, 40), std::pair(31, 31)}) {
      const auto found = extractor->detect(Image(width, height, 1, 80));
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(found->size(), 0U);
    }
    EXPECT_FALSE(extractor->detect(Image()).has_value());
  }
}

TEST(StereoFeatures, ParametersOutOfRangeAreNamed) {
  const auto message = [](auto change) {
    StereoFeatureParams params;
    change(params);
    const Status status = validate(params);
    return status ? std::string() : status.error().message;
  };
  EXPECT_EQ(message([](StereoFeatureParams&) {}), "");
  EXPECT_TRUE(validate(paper_stereo_params()).has_value());
  EXPECT_NE(message([](auto& p) { p.detector.wanted = 0; }).find("detector.wanted"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.match.max_ratio = std::nan(""); }).find("match.max_ratio"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.match.min_disparity_px = 300.0; }).find("min_disparity_px"), std::string::npos);
}

}  // namespace
}  // namespace seeker::vision
