#include <cstdio>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "mirror_renderer.hpp"
#include "scenes.hpp"
#include "server/vision/multi_recogniser.hpp"

namespace seeker::vision {
namespace {

using testing::model_of;
using testing::sign;
using testing::Tally;

std::vector<TargetModel> signs() {
  std::vector<TargetModel> models;
  for (int symbol = 0; symbol < testing::kSymbols; ++symbol) {
    models.push_back(model_of("sign" + std::to_string(symbol), sign(symbol)));
  }
  return models;
}

Tally paste_experiment(bool cluttered, std::uint64_t seed) {
  Rng rng(seed);
  const auto recogniser = make_recogniser(signs());
  EXPECT_TRUE(recogniser.has_value());
  Tally tally;
  for (int symbol = 0; symbol < testing::kSymbols; ++symbol) {
    for (const double scale : {0.5, 0.7, 1.0, 1.4, 2.0}) {
      cv::Mat scene = cluttered ? testing::cluttered_ground(640, 480, 15, rng)
                                : testing::plain_ground(640, 480, static_cast<int>(rng.uniform(90.0, 240.0)));
      const int side = cvRound(96 * scale);
      const cv::Rect box(20 + static_cast<int>(rng.below(400)), 20 + static_cast<int>(rng.below(240)), side, side);
      testing::paste(scene, sign(symbol), box);
      testing::degrade(scene, 0.6, 2.5, rng);
      const auto report = (*recogniser)->recognise(to_image(scene));
      EXPECT_TRUE(report.has_value());
      testing::count(*report, symbol, box, tally);
    }
  }
  std::printf("signs, %s ground, seed %llu: recall %.2f of %d, %d false positives\n", cluttered ? "cluttered" : "plain",
              static_cast<unsigned long long>(seed), tally.recall(), tally.shown, tally.false_positives);
  return tally;
}

TEST(TemplateRecogniser, FindsSignsFromHalfToDoubleSize) {
  for (const bool cluttered : {false, true}) {
    const Tally tally = paste_experiment(cluttered, 31);
    EXPECT_GE(tally.recall(), 0.9);
    EXPECT_LE(tally.false_positives, 2);
  }
}

TEST(TemplateRecogniser, FindsTheNegativeOfNoSign) {
  Rng rng(32);
  cv::Mat scene = testing::plain_ground(640, 480, 90);
  testing::paste(scene, cv::Mat(255 - sign(2)), cv::Rect(200, 150, 96, 96));
  testing::degrade(scene, 0.6, 2.5, rng);
  const auto recogniser = make_recogniser({model_of("sign", sign(2))});
  ASSERT_TRUE(recogniser.has_value());
  EXPECT_TRUE((*recogniser)->recognise(to_image(scene))->sightings.empty());
}

TEST(TemplateRecogniser, FindsALightTargetOnDarkGround) {
  Rng rng(33);
  const cv::Mat negative = 255 - sign(2);
  cv::Mat scene = testing::plain_ground(640, 480, 60);
  const cv::Rect box(220, 120, 80, 80);
  testing::paste(scene, negative, box);
  testing::degrade(scene, 0.6, 2.5, rng);
  const auto recogniser = make_recogniser({model_of("negative", negative)});
  ASSERT_TRUE(recogniser.has_value());
  const auto report = (*recogniser)->recognise(to_image(scene));
  ASSERT_EQ(report->sightings.size(), 1U);
  EXPECT_TRUE(testing::hits(report->sightings[0], 0, box));
  EXPECT_NEAR(report->sightings[0].box.left_px, box.x, 3);
  EXPECT_NEAR(report->sightings[0].box.width_px, box.width, 6);
}

TEST(TemplateRecogniser, StagesAddUp) {
  Rng rng(34);
  cv::Mat scene = testing::cluttered_ground(640, 480, 30, rng);
  testing::paste(scene, sign(0), cv::Rect(200, 150, 96, 96));
  testing::degrade(scene, 0.6, 2.5, rng);
  const auto recogniser = make_recogniser(signs());
  const auto report = (*recogniser)->recognise(to_image(scene));
  ASSERT_TRUE(report.has_value());
  const StageCounts& s = report->stages;
  EXPECT_EQ(s.candidates, s.rejected_ncc + s.rejected_verify + s.rejected_overlap + s.accepted);
  EXPECT_GT(s.regions, s.rejected_area + s.rejected_duplicate);
  EXPECT_EQ(*report, *(*recogniser)->recognise(to_image(scene)));  // deterministic
}

TEST(FeatureRecogniser, FindsARotatedObliquePicture) {
  Rng rng(35);
  cv::Mat picture(180, 240, CV_8UC1);
  cv::randu(picture, 0, 255);
  cv::GaussianBlur(picture, picture, cv::Size(0, 0), 3.0);
  cv::normalize(picture, picture, 0, 255, cv::NORM_MINMAX);
  const std::vector<cv::Point2f> from = {{0, 0}, {239, 0}, {239, 179}, {0, 179}};
  const std::vector<cv::Point2f> to = {{210, 120}, {420, 170}, {390, 340}, {170, 300}};
  cv::Mat scene = testing::cluttered_ground(640, 480, 20, rng);
  cv::warpPerspective(picture, scene, cv::getPerspectiveTransform(from, to), scene.size(), cv::INTER_LINEAR,
                      cv::BORDER_TRANSPARENT);
  testing::degrade(scene, 0.5, 2.0, rng);
  const auto recogniser = make_recogniser({model_of("poster", picture, TargetKind::kFeature)});
  ASSERT_TRUE(recogniser.has_value());
  const auto report = (*recogniser)->recognise(to_image(scene));
  ASSERT_TRUE(report.has_value());
  ASSERT_EQ(report->sightings.size(), 1U);
  EXPECT_NEAR(report->sightings[0].u_px, 297.5, 5.0);
  EXPECT_NEAR(report->sightings[0].v_px, 232.5, 5.0);
}

TEST(MakeRecogniser, RefusesPicturesThatAreNoTargets) {
  const auto code = [](const TargetModel& model, const RecogniserParams& params = {}) {
    const auto made = make_recogniser({model}, params);
    return made ? std::string("made") : std::string(to_string(made.error().code));
  };
  RecogniserParams omni;
  omni.view.omni = OmniCameraParams();
  EXPECT_EQ(code(model_of("good", sign(0))), "made");
  EXPECT_EQ(code({"empty", Image(), 0.3, 0.3, TargetKind::kTemplate}), to_string(Errc::kInvalidArgument));
  EXPECT_EQ(code({"black", Image(50, 50, 1), 0.3, 0.3, TargetKind::kTemplate}), to_string(Errc::kInvalidArgument));
  EXPECT_EQ(code(model_of("large", sign(0, 500, 500)), omni), to_string(Errc::kTooLarge));
  EXPECT_EQ(code(model_of("plain", sign(0), TargetKind::kFeature)), to_string(Errc::kInvalidArgument));
  EXPECT_EQ(code({"no size", to_image(sign(0)), 0.0, 0.3, TargetKind::kTemplate}), to_string(Errc::kInvalidArgument));
  EXPECT_FALSE(make_recogniser({}).has_value());
  EXPECT_NE(make_recogniser({{"black", Image(50, 50, 1), 0.3, 0.3, TargetKind::kTemplate}})
                .error()
                .message.find("one colour"),
            std::string::npos);
}

TEST(MakeRecogniser, RefusesAPictureSmallerThanTheTarget) {
  const auto recogniser = make_recogniser({model_of("sign", sign(0))});
  const auto report = (*recogniser)->recognise(Image(40, 40, 1, 128));
  ASSERT_FALSE(report.has_value());
  EXPECT_EQ(report.error().code, Errc::kTooLarge);
}

TEST(MakeRecogniser, RefusesAPictureOfAnotherSizeThanTheCameras) {
  RecogniserParams omni;
  omni.view.omni = OmniCameraParams();
  const auto recogniser = make_recogniser(signs(), omni);
  ASSERT_TRUE(recogniser.has_value());
  EXPECT_EQ((*recogniser)->recognise(Image(320, 240, 1, 9)).error().code, Errc::kInvalidArgument);
  EXPECT_EQ((*recogniser)->recognise(Image()).error().code, Errc::kInvalidArgument);
}

TEST(Recognisers, SeeNothingInBlackSaturatedOrNoisyPictures) {
  RecogniserParams omni;
  omni.view.omni = OmniCameraParams();
  std::vector<TargetModel> models = signs();
  cv::Mat textured(96, 96, CV_8UC1);
  cv::randu(textured, 0, 255);
  models.push_back(model_of("textured", textured, TargetKind::kFeature));
  Rng rng(36);
  for (const RecogniserParams& params : {RecogniserParams(), omni}) {
    const auto recogniser = make_recogniser(models, params);
    ASSERT_TRUE(recogniser.has_value());
    Image noise(640, 480, 1);
    for (auto& pixel : noise.data()) {
      pixel = static_cast<std::uint8_t>(rng.below(256));
    }
    for (const Image& picture : {Image(640, 480, 1, 0), Image(640, 480, 1, 255), Image(640, 480, 3, 255), noise}) {
      const auto report = (*recogniser)->recognise(picture);
      ASSERT_TRUE(report.has_value());
      EXPECT_TRUE(report->sightings.empty());
    }
  }
}

RC_GTEST_PROP(Recognisers, SurviveAnyPicture, (std::uint64_t seed)) {
  static const auto kRecogniser = make_recogniser({model_of("small", sign(1, 8, 6)), model_of("other", sign(3, 5, 9))});
  Rng rng(seed);
  const int width = 1 + static_cast<int>(rng.below(90));
  const int height = 1 + static_cast<int>(rng.below(90));
  Image picture(width, height, rng.below(2) == 0 ? 1 : 3);
  const std::uint64_t levels = 1 + rng.below(256);
  for (auto& pixel : picture.data()) {
    pixel = static_cast<std::uint8_t>(rng.below(levels) * 255 / levels);
  }
  const auto report = (*kRecogniser)->recognise(picture);
  RC_ASSERT(report.has_value() == (width >= 8 && height >= 9));
  if (report) {
    RC_ASSERT((*kRecogniser)->explain(picture).has_value());
    for (const Sighting& s : report->sightings) {
      RC_ASSERT(std::isfinite(s.u_px) && std::isfinite(s.v_px) && s.score <= 1.0);
    }
  }
}

TEST(Recognisers, ExplainEveryStageInOrder) {
  cv::Mat scene = testing::plain_ground(640, 480, 180);
  testing::paste(scene, sign(0), cv::Rect(200, 150, 96, 96));
  const auto recogniser = make_recogniser(signs());
  const auto stages = (*recogniser)->explain(to_image(scene));
  ASSERT_TRUE(stages.has_value());
  ASSERT_GE(stages->size(), 7U);
  EXPECT_EQ(stages->front().name, "grey");
  EXPECT_EQ((*stages)[4].name, "binarised_otsu");
  EXPECT_EQ(stages->back().name, "sightings");
  for (const StageImage& stage : *stages) {
    EXPECT_EQ(stage.image.width_px(), 640);
  }
}

}  // namespace
}  // namespace seeker::vision
