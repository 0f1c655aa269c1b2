// Pairs that no stereo can come of are refused with the eye, the cause and the remedy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/vision/stereo_check.hpp"
#include "server/vision/stereo_features.hpp"
#include "stereo_scenes.hpp"

namespace seeker::vision {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class StereoFaults : public ::testing::Test {
 protected:
  StereoFaults() : frame(testing::banded_pair(testing::small_camera(), {12.0, 30.5, 55.2}, rng)) {}

  /// Empty: no fault.
  [[nodiscard]] std::string fault() const {
    const auto found = make_stereo_extractor(testing::small_camera(), {})->extract(frame);
    if (found) {
      return "";
    }
    EXPECT_EQ(found.error().code, Errc::kInvalidArgument);
    return found.error().message;
  }

  static Image with_rows_moved(const Image& picture, double by_px) {
    cv::Mat moved;
    const cv::Mat grey = to_grey_mat(picture);
    cv::warpAffine(grey, moved, cv::Matx23d(1, 0, 0, 0, 1, by_px), grey.size());
    return to_image(moved);
  }

  static Image blurred(const Image& picture, double sigma_px, Rng& noise) {
    cv::Mat grey = to_grey_mat(picture);
    testing::degrade(grey, sigma_px, 2.0, noise);
    return to_image(grey);
  }

  Rng rng{31};
  StereoFrame frame;
};

TEST_F(StereoFaults, AGoodPairHasNone) { EXPECT_EQ(fault(), ""); }

TEST_F(StereoFaults, AnotherSizeIsNamedWithTheOneExpected) {
  frame.right = Image(320, 240, 1, 100);
  EXPECT_THAT(fault(),
              AllOf(HasSubstr("right eye"), HasSubstr("320x240"), HasSubstr("480x360"), HasSubstr("calibrat")));
}

TEST_F(StereoFaults, APictureWithoutPixelsIsRefused) {
  frame.left = Image();
  EXPECT_THAT(fault(), HasSubstr("left eye"));
}

TEST_F(StereoFaults, ABlackPictureIsReported) {
  cv::Mat black = testing::plain_ground(480, 360, 3);
  testing::degrade(black, 0.0, 2.0, rng);
  frame.left = to_image(black);
  EXPECT_THAT(fault(), AllOf(HasSubstr("left eye"), HasSubstr("black"), HasSubstr("lens cap")));
}

TEST_F(StereoFaults, ASaturatedPictureIsReported) {
  cv::Mat bright = to_grey_mat(frame.right) * 4.0;
  frame.right = to_image(bright);
  EXPECT_THAT(fault(), AllOf(HasSubstr("right eye"), HasSubstr("saturated"), HasSubstr("exposure")));
}

TEST_F(StereoFaults, OneBlurredEyeIsReported) {
  const Image sharp = frame.left;
  frame.left = blurred(sharp, 6.0, rng);
  EXPECT_THAT(fault(), AllOf(HasSubstr("left eye"), HasSubstr("blurred"), HasSubstr("focus")));
}

TEST_F(StereoFaults, BothEyesBlurredIsReported) {
  frame.left = blurred(frame.left, 8.0, rng);
  frame.right = blurred(frame.right, 8.0, rng);
  EXPECT_THAT(fault(), HasSubstr("blurred"));
}

TEST_F(StereoFaults, SwappedEyesAreReported) {
  std::swap(frame.left, frame.right);
  EXPECT_THAT(fault(), AllOf(HasSubstr("negative"), HasSubstr("swap")));
}

TEST_F(StereoFaults, RowsThatDoNotAgreeAreReported) {
  frame.right = with_rows_moved(frame.right, 4.0);
  EXPECT_THAT(fault(), AllOf(HasSubstr("row"), HasSubstr("calibrat"), HasSubstr("synchronise")));
}

TEST_F(StereoFaults, ErrorsOfRectificationWithinTheGateAreNone) {
  frame.right = with_rows_moved(frame.right, 0.3);
  EXPECT_EQ(fault(), "");
}

TEST_F(StereoFaults, ColourPicturesAreAsGoodAsGreyOnes) {
  const auto coloured = [](const Image& grey) {
    Image out(grey.width_px(), grey.height_px(), 3);
    for (std::size_t i = 0; i < grey.data().size(); ++i) {
      std::fill_n(out.data().begin() + static_cast<std::ptrdiff_t>(3 * i), 3, grey.data()[i]);
    }
    return out;
  };
  const auto extractor = make_stereo_extractor(testing::small_camera(), {});
  const auto grey = extractor->extract(frame);
  const auto colour = extractor->extract({frame.stamp, coloured(frame.left), coloured(frame.right)});
  ASSERT_TRUE(grey && colour);
  EXPECT_EQ(grey->features, colour->features);
}

}  // namespace
}  // namespace seeker::vision
