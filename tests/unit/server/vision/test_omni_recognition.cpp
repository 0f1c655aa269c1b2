#include <array>
#include <cstdio>

#include <gtest/gtest.h>

#include "mirror_renderer.hpp"
#include "scenes.hpp"
#include "server/vision/multi_recogniser.hpp"

namespace seeker::vision {
namespace {

using testing::FlatObject;
using testing::Mirror;

RecogniserParams omni_params() {
  RecogniserParams params;
  params.view.omni = OmniCameraParams();
  return params;
}

std::unique_ptr<Recogniser> signs_recogniser() {
  std::vector<TargetModel> models;
  for (int symbol = 0; symbol < testing::kSymbols; ++symbol) {
    models.push_back(testing::model_of("sign" + std::to_string(symbol), testing::sign(symbol)));
  }
  auto made = make_recogniser(models, omni_params());
  EXPECT_TRUE(made.has_value());
  return std::move(*made);
}

struct Score {
  int shown = 0;
  int found = 0;
  int false_positives = 0;
  double worst_bearing_deg = 0.0;
  double worst_range_error = 0.0;
};

void look(const Recogniser& recogniser, const std::vector<FlatObject>& objects, int symbol, Rng& rng, Score& score) {
  const cv::Mat scene = testing::render(Mirror(), objects, 2.5, rng);
  const auto report = recogniser.recognise(to_image(scene));
  ASSERT_TRUE(report.has_value());
  ++score.shown;
  for (const Sighting& s : report->sightings) {
    const double error_deg = std::abs(rad_to_deg(wrap_angle(s.bearing_base_rad - objects[0].bearing_rad)));
    const bool right = s.target == symbol && error_deg < 3.0;
    score.found += right ? 1 : 0;
    score.false_positives += right ? 0 : 1;
    if (right) {
      score.worst_bearing_deg = std::max(score.worst_bearing_deg, error_deg);
      score.worst_range_error = std::max(score.worst_range_error, std::abs(*s.range_m / objects[0].range_m - 1.0));
    }
  }
}

TEST(OmniRecognition, BearingIsRightAllAroundTheRobot) {
  const auto recogniser = signs_recogniser();
  Rng rng(21);
  Score score;
  for (int i = 0; i < 12; ++i) {
    const int symbol = i % testing::kSymbols;
    // Bearings at the seam of the panorama, and between.
    look(*recogniser, {{testing::sign(symbol), wrap_angle(kPi + i * kTwoPi / 12.0), 1.6}}, symbol, rng, score);
  }
  std::printf("omni, 1.6 m: found %d of %d, %d false, bearing off by at most %.2f deg\n", score.found, score.shown,
              score.false_positives, score.worst_bearing_deg);
  EXPECT_EQ(score.found, score.shown);
  EXPECT_EQ(score.false_positives, 0);
  EXPECT_LE(score.worst_bearing_deg, 1.0);
}

TEST(OmniRecognition, OnlyTheBestCandidateOfATargetIsReportedWhereThatIsWanted) {
  RecogniserParams params = omni_params();
  const std::vector<TargetModel> models{testing::model_of("sign0", testing::sign(0)),
                                        testing::model_of("sign1", testing::sign(1))};
  Rng rng(27);
  const Image scene = to_image(testing::render(
      Mirror(), {{testing::sign(0), 0.5, 1.4}, {testing::sign(0), -1.5, 1.4}, {testing::sign(1), 2.5, 1.4}}, 2.5, rng));
  const auto all = make_recogniser(models, params).value()->recognise(scene);
  params.templates.only_best = true;
  const auto best = make_recogniser(models, params).value()->recognise(scene);
  ASSERT_TRUE(all && best);
  ASSERT_EQ(all->sightings.size(), 3U);
  ASSERT_EQ(best->sightings.size(), 2U) << "one of each target";
  EXPECT_NE(best->sightings[0].target, best->sightings[1].target);
  for (const Sighting& sighting : best->sightings) {
    for (const Sighting& other : all->sightings) {
      EXPECT_TRUE(other.target != sighting.target || other.score <= sighting.score);
    }
  }
  EXPECT_EQ(best->stages.rejected_overlap, all->stages.rejected_overlap + 1);
}

TEST(OmniRecognition, RecallFallsWithRangeOnly) {
  const auto recogniser = signs_recogniser();
  Rng rng(22);
  for (const double range_m : {0.6, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5}) {
    Score score;
    for (int i = 0; i < 4; ++i) {
      const int symbol = i % testing::kSymbols;
      look(*recogniser, {{testing::sign(symbol), rng.uniform(-kPi, kPi), range_m}}, symbol, rng, score);
    }
    std::printf("omni, sign of 0.30 m at %.1f m: found %d of %d, %d false, bearing %.2f deg, range hint %.0f %%\n",
                range_m, score.found, score.shown, score.false_positives, score.worst_bearing_deg,
                100.0 * score.worst_range_error);
    if (range_m <= 2.5) {
      EXPECT_EQ(score.found, 4) << range_m;
      EXPECT_LE(score.worst_range_error, 0.15) << range_m;
    }
    EXPECT_LE(score.false_positives, 1) << range_m;
  }
}

TEST(OmniRecognition, ARotatedSignIsFound) {
  const auto recogniser = signs_recogniser();
  Rng rng(23);
  for (const double turn_deg : {0.0, 20.0, 35.0, 50.0}) {
    Score score;
    for (int i = 0; i < 4; ++i) {
      const int symbol = i % testing::kSymbols;
      FlatObject object{testing::sign(symbol), rng.uniform(-kPi, kPi), 1.5};
      object.rotation_rad = deg_to_rad(turn_deg);
      look(*recogniser, {object}, symbol, rng, score);
    }
    std::printf("omni, turned by %.0f deg: found %d of %d, %d false\n", turn_deg, score.found, score.shown,
                score.false_positives);
    if (turn_deg <= 35.0) {
      EXPECT_GE(score.found, 3) << turn_deg;
    }
  }
}

TEST(OmniRecognition, ASignBeforeDarkFurnitureIsFound) {
  const auto recogniser = signs_recogniser();
  for (const double grey : {60.0, 45.0, 32.0}) {
    Rng rng(24);
    Score score;
    for (int i = 0; i < 4; ++i) {
      const int symbol = i % testing::kSymbols;
      const double bearing = rng.uniform(-kPi, kPi);
      const cv::Mat wood(8, 8, CV_8UC1, cv::Scalar(grey));
      look(*recogniser, {{testing::sign(symbol), bearing, 1.6}, {wood, bearing + 0.2, 2.0, 1.4, 1.2, 0.0}}, symbol, rng,
           score);
    }
    std::printf("omni, before furniture of grey %.0f: found %d of %d, %d false\n", grey, score.found, score.shown,
                score.false_positives);
    EXPECT_GE(score.found, 3) << grey;
  }
}

TEST(OmniRecognition, ARoomWithoutSignsHasNone) {
  const auto recogniser = signs_recogniser();
  Rng rng(25);
  int reported = 0;
  for (int i = 0; i < 8; ++i) {
    std::vector<FlatObject> objects;
    for (int k = 0; k < 10; ++k) {
      const cv::Mat plain(8, 8, CV_8UC1, cv::Scalar(rng.uniform(15.0, 240.0)));
      objects.push_back({plain, rng.uniform(-kPi, kPi), rng.uniform(0.8, 4.0), rng.uniform(0.1, 1.2),
                         rng.uniform(0.1, 1.4), rng.uniform(0.0, 0.7)});
    }
    const auto report = recogniser->recognise(to_image(testing::render(Mirror(), objects, 2.5, rng)));
    ASSERT_TRUE(report.has_value());
    reported += static_cast<int>(report->sightings.size());
  }
  std::printf("omni, rooms with furniture only: %d false positives in 8 pictures with 4 targets\n", reported);
  EXPECT_LE(reported, 1);
}

}  // namespace
}  // namespace seeker::vision
