// Recordings of others (see tests/support/data.hpp): stereo pairs of real cameras.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <gtest/gtest.h>

#include "common/image/jpeg.hpp"
#include "scenes.hpp"
#include "server/vision/feature_match.hpp"
#include "server/vision/picture.hpp"
#include "server/vision/stereo_check.hpp"
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

struct ForeignPairs {
  int pairs = 0;
  int within_gate = 0;
};

ForeignPairs foreign_pairs(const FeatureList& left, const FeatureList& right, const StereoMatchParams& match) {
  constexpr float kRowsApart = 40.0F;
  const std::uint32_t gate = byte_distance(match.max_distance, match.metric);
  ForeignPairs out;
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t k = 0; k < right.size(); ++k) {
      const Keypoint& l = left.keypoints[i];
      const Keypoint& r = right.keypoints[k];
      const double scales = std::max(l.scale_px, r.scale_px) / std::min(l.scale_px, r.scale_px);
      const double rotation =
          wrap_angle(static_cast<double>(l.orientation_rad) - static_cast<double>(r.orientation_rad));
      if (std::abs(l.v_px - r.v_px) > kRowsApart && scales <= match.scale_gate &&
          std::abs(rotation) < match.max_rotation_rad) {
        ++out.pairs;
        out.within_gate += descriptor_distance(left.descriptors[i], right.descriptors[k], match.metric) <= gate ? 1 : 0;
      }
    }
  }
  return out;
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
    int keypoints = 0;
    int known = 0;
    int within_1_px = 0;
  };
  [[nodiscard]] Score score(StereoFeatureParams params) const {
    params.match.max_disparity_px = kMaxDisparity_px;
    const auto found = make_stereo_extractor(geometry_of(frame.left), params)->extract(frame);
    EXPECT_TRUE(found.has_value()) << (found ? "" : found.error().message);
    Score out;
    out.keypoints = found ? found->left_keypoints : 0;
    for (const StereoFeature& f : found ? found->features : std::vector<StereoFeature>{}) {
      const int truth =
          *disparities.at(static_cast<int>(std::lround(f.left.u_px)), static_cast<int>(std::lround(f.left.v_px)));
      out.known += truth > 0 ? 1 : 0;
      out.within_1_px += truth > 0 && std::abs(f.disparity_px - truth) <= 1.0 ? 1 : 0;
    }
    std::printf("aloe: of %d key points %d of %d features within 1 px of the truth (%.1f %%)\n", out.keypoints,
                out.within_1_px, out.known, 100.0 * out.within_1_px / std::max(1, out.known));
    return out;
  }

  StereoFrame frame;
  Image disparities;
};

// A plant's strongest key points have several orientations each: of 1400 that are wanted fewer than 1000 places are
// left.
TEST_F(Aloe, OfLessThan1000PlacesNineteenOfTwentyMatchesAreTrue) {
  StereoFeatureParams params;
  params.detector.wanted = 1400;
  const Score s = score(params);
  EXPECT_LT(s.keypoints, 1000);
  EXPECT_GE(s.known, 400);
  EXPECT_GE(s.within_1_px, s.known * 95 / 100);
}

TEST_F(Aloe, ThePapersGatesDoAlmostAsWell) {
  StereoFeatureParams params = paper_stereo_params();
  params.match.max_disparity_px = 200.0;  // the plant is nearer than the paper's limit
  params.detector.wanted = 1400;
  const Score s = score(params);
  EXPECT_GE(s.known, 300);
  EXPECT_GE(s.within_1_px, s.known * 93 / 100);
}

TEST_F(Aloe, SwappedEyesAreReported) {
  std::swap(frame.left, frame.right);
  const auto found = make_stereo_extractor(geometry_of(frame.left), {})->extract(frame);
  ASSERT_FALSE(found.has_value());
  EXPECT_NE(found.error().message.find("swap"), std::string::npos) << found.error().message;
}

struct Judged {
  int pictures = 0;
  int blurred = 0;
};

/// All photographs, blurred by a Gaussian first, each for both eyes.
Judged judge_photographs(const std::filesystem::path& folder, double sigma_px) {
  Judged judged;
  Rng rng(77);
  for (const char* where : {"aloe", "corridor", "euroc", "stereo_1024x768"}) {
    for (const auto& file : std::filesystem::directory_iterator(folder / where)) {
      const auto extension = file.path().extension();
      if ((extension != ".jpg" && extension != ".png") || file.path().filename() == "aloeGT.png") {
        continue;
      }
      const auto picture = image::read_picture(file.path());
      EXPECT_TRUE(picture) << file.path();
      cv::Mat grey = to_grey_mat(*picture).clone();
      if (sigma_px > 0.0) {
        testing::degrade(grey, sigma_px, 2.0, rng);
      }
      const PictureQuality quality = measure_quality(to_image(grey));
      const bool blurred = fault_of(quality, quality) == PictureFault::kBlurred;
      EXPECT_FALSE(blurred && sigma_px == 0.0) << file.path() << " is sharp";
      ++judged.pictures;
      judged.blurred += blurred ? 1 : 0;
    }
  }
  std::printf("photographs blurred by %.0f px: %d of %d refused\n", sigma_px, judged.blurred, judged.pictures);
  return judged;
}

TEST(PictureQuality, PhotographsAreOnlyRefusedWhenTheyAreBlurred) {
  SEEKER_REQUIRE_DATA(folder, "vision");
  const Judged sharp = judge_photographs(folder, 0.0);
  EXPECT_EQ(sharp.pictures, 102);
  EXPECT_EQ(sharp.blurred, 0);
  const Judged blurred = judge_photographs(folder, 8.0);
  EXPECT_GE(blurred.blurred, blurred.pictures * 95 / 100);
}

/// Share of pairs that cannot be one place (40 rows apart, though of like scale and orientation) within each gate.
TEST(StereoGates, LetAsManyForeignPairsThroughAsThePapers) {
  SEEKER_REQUIRE_DATA(folder, "vision");
  double pairs = 0.0;
  double within_paper = 0.0;
  double within_default = 0.0;
  for (const auto& [left, right] :
       {std::pair("aloe/aloeL.jpg", "aloe/aloeR.jpg"),
        std::pair("euroc/cam0_1403715273262142976.png", "euroc/cam1_1403715273262142976.png"),
        std::pair("stereo_1024x768/0_left.jpg", "stereo_1024x768/0_right.jpg"),
        std::pair("stereo_1024x768/2_left.jpg", "stereo_1024x768/2_right.jpg")}) {
    const auto l = image::read_picture(folder / left);
    const auto r = image::read_picture(folder / right);
    ASSERT_TRUE(l && r);
    const auto count = [&](const StereoFeatureParams& params) {
      const auto extractor = make_stereo_extractor(geometry_of(*l), params);
      return foreign_pairs(*extractor->detect(*l), *extractor->detect(*r), params.match);
    };
    StereoFeatureParams paper = paper_stereo_params();
    paper.match.scale_gate_kind = ScaleGate::kRatio;  // the same pairs for both
    const ForeignPairs a = count(paper);
    const ForeignPairs b = count({});
    ASSERT_EQ(a.pairs, b.pairs);
    pairs += a.pairs;
    within_paper += a.within_gate;
    within_default += b.within_gate;
  }
  std::printf("foreign pairs within the gate: paper %.2f %%, default %.2f %% of %.0f\n", 100.0 * within_paper / pairs,
              100.0 * within_default / pairs, pairs);
  EXPECT_GE(pairs, 10000);
  EXPECT_NEAR(within_default / within_paper, 1.0, 0.3);
}

}  // namespace
}  // namespace seeker::vision
