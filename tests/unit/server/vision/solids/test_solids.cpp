#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "common/core/angle.hpp"
#include "server/options/solids_options.hpp"
#include "server/sim/tank_renderer.hpp"
#include "server/sim/turbid_water.hpp"
#include "server/vision/photo_view.hpp"
#include "server/vision/solids/target_recogniser.hpp"
#include "tests/support/data.hpp"

namespace seeker::vision {
namespace {

cv::Mat drawn(const std::vector<cv::Point>& corners) {
  cv::Mat picture(480, 640, CV_8U, cv::Scalar(0));
  cv::fillConvexPoly(picture, corners, cv::Scalar(255));
  return picture;
}

TEST(HuInvariants, AreThoseOfOpenCv) {
  const cv::Mat picture = drawn({{100, 100}, {300, 130}, {220, 300}});
  double expected[7];
  cv::HuMoments(cv::moments(picture), expected);
  const auto got = hu_invariants(picture);
  for (std::size_t i = 0; i < kHuInvariants; ++i) {
    EXPECT_NEAR(got[i], expected[i], 1e-9 + 1e-6 * std::abs(expected[i])) << i;
  }
}

TEST(HuInvariants, DoNotChangeWithPlaceSizeAndRotation) {
  const cv::Mat small = drawn({{200, 200}, {300, 200}, {300, 250}, {200, 250}});
  cv::Mat turned;
  const cv::Mat rotation = cv::getRotationMatrix2D({250.0F, 225.0F}, 37.0, 2.2);
  cv::warpAffine(small, turned, rotation, small.size());
  const auto a = hu_invariants(small);
  const auto b = hu_invariants(turned);
  EXPECT_NEAR(b[0] / a[0], 1.0, 0.03);
  EXPECT_NEAR(b[1] / a[1], 1.0, 0.06);
}

TEST(HuInvariants, OfADiscAreKnown) {
  cv::Mat disc(480, 640, CV_8U, cv::Scalar(0));
  cv::circle(disc, {320, 240}, 150, cv::Scalar(255), cv::FILLED);
  const auto phi = hu_invariants(disc);
  EXPECT_NEAR(phi[0] * 255.0, 1.0 / (2.0 * kPi), 1e-3);  // eta_pq of grey 255 are 1/255 of those of ones
  EXPECT_NEAR(phi[1], 0.0, 1e-9);
}

/// Two rings of points, which no straight line parts.
std::vector<TrainingSample> rings(int count, Rng& rng) {
  std::vector<TrainingSample> samples;
  for (int i = 0; i < count; ++i) {
    const double angle = rng.uniform(-kPi, kPi);
    const double radius = (i % 2 == 0 ? 1.0 : 2.5) + rng.normal(0.15);
    samples.push_back({{radius * std::cos(angle) + 40.0, 300.0 * radius * std::sin(angle)}, i % 2});
  }
  return samples;
}

TEST(SmallNetwork, LearnsWhatALineCannotPart) {
  Rng rng(4);
  TrainingParams params;
  params.hidden = 8;
  params.epochs = 600;
  const auto trained = train_network(rings(300, rng), 2, params, rng);
  ASSERT_TRUE(trained) << trained.error().message;
  EXPECT_TRUE(validate(trained->network));
  int right = 0;
  for (const TrainingSample& sample : rings(200, rng)) {
    const std::vector<double> p = run_network(trained->network, sample.input);
    EXPECT_NEAR(p[0] + p[1], 1.0, 1e-9);
    right += (p[1] > p[0]) == (sample.label == 1) ? 1 : 0;
  }
  EXPECT_GE(right, 194);
}

TEST(SmallNetwork, TrainsTheSameFromTheSameSeed) {
  TrainingParams params;
  params.epochs = 30;
  const auto train = [&params](std::uint64_t seed) {
    Rng rng(seed);
    return train_network(rings(40, rng), 2, params, rng)->network;
  };
  EXPECT_EQ(train(1), train(1));
  EXPECT_NE(train(1), train(2));
}

TEST(SmallNetwork, RefusesWhatDoesNotFit) {
  Rng rng(1);
  EXPECT_EQ(train_network({}, 2, {}, rng).error().code, Errc::kInvalidArgument);
  EXPECT_FALSE(train_network({{{1.0}, 0}, {{1.0, 2.0}, 1}}, 2, {.members = 2}, rng));
  EXPECT_FALSE(train_network({{{1.0}, 0}, {{2.0}, 5}}, 2, {.members = 2}, rng));
  EXPECT_FALSE(train_network({{{1.0}, 0}, {{2.0}, 1}}, 2, {.members = 3}, rng)) << "a member without samples";
  SmallNetwork network = train_network(rings(10, rng), 2, {.epochs = 5}, rng)->network;
  network.first.pop_back();
  EXPECT_FALSE(validate(network));
}

sim::SolidView seen_from(SolidKind shape, double elevation_deg) {
  sim::SolidView view;
  view.shape = shape;
  view.size_m = shape == SolidKind::kSphere ? 0.1 : 0.18;
  view.elongation = 1.2;
  view.yaw_rad = 0.4;
  view.elevation_rad = deg_to_rad(elevation_deg);
  return view;
}

TEST(SegmentSolid, FindsTheDiscOfASphereInTurbidWater) {
  for (const double attenuation : {0.3, 1.0}) {
    sim::TurbidWater water;
    water.attenuation_per_m = attenuation;
    water.lamp_offset_u = 0.4;
    Rng rng(3);
    const Image picture = sim::render_solid(seen_from(SolidKind::kSphere, 40.0), water, rng);
    const auto sight = look_at_solid(picture, {});
    ASSERT_TRUE(sight);
    const double diameter_px = 2.0 * 700.0 * 0.1 / std::sqrt(1.1 * 1.1 - 0.1 * 0.1);
    EXPECT_NEAR(sight->box.left_px + sight->box.width_px / 2.0, 320.0, 4.0);
    EXPECT_NEAR(sight->box.top_px + sight->box.height_px / 2.0, 240.0, 4.0);
    EXPECT_NEAR(sight->box.width_px, diameter_px, 8.0);
    EXPECT_NEAR(sight->box.height_px, diameter_px, 8.0);
  }
}

TEST(SegmentSolid, SeesNothingInEmptyWater) {
  Rng rng(3);
  Image picture(640, 480, 1);
  for (std::uint8_t& value : picture.data()) {
    value = static_cast<std::uint8_t>(90.0 + rng.normal(4.0));
  }
  EXPECT_FALSE(look_at_solid(picture, {}));
  EXPECT_FALSE(look_at_solid(Image(640, 480, 1, 0), {}));
  EXPECT_FALSE(look_at_solid(Image(), {}));
}

TEST(TurbidWater, TakesContrastWithTheDistance) {
  const auto contrast = [](double attenuation) {
    sim::TurbidWater water;
    water.attenuation_per_m = attenuation;
    water.noise = 0.0;
    Rng rng(1);
    const Image picture = sim::render_solid(seen_from(SolidKind::kQuadrangularPrism, 40.0), water, rng);
    return *picture.at(320, 250) - *picture.at(60, 250);
  };
  EXPECT_GT(contrast(0.2), contrast(0.8) + 10);
  EXPECT_GT(contrast(0.8), 5);
}

/// A model from few pictures: enough for the four solids seen plainly.
SolidModel quick_model() {
  std::vector<TrainingSample> samples;
  for (const SolidKind shape : kSolidKinds) {
    for (std::uint64_t i = 0; i < 7; ++i) {
      Rng rng(1000U * static_cast<std::uint64_t>(shape) + i);
      const sim::SolidView view = sim::draw_view(shape, rng);
      if (const auto sight = look_at_solid(sim::render_solid(view, {}, rng), {})) {
        samples.push_back({{sight->features.begin(), sight->features.end()}, static_cast<int>(shape)});
      }
    }
  }
  Rng rng(1);
  SolidModel model;
  model.network = train_network(samples, static_cast<int>(kSolidKinds.size()), {.epochs = 400}, rng)->network;
  return model;
}

TEST(SolidRecogniser, FindsWhatIsWantedAndKeepsSilentAboutTheRest) {
  const SolidModel model = quick_model();
  Rng rng(77);
  sim::SolidView view = seen_from(SolidKind::kSphere, 40.0);
  view.off_u_px = 100.0;
  const Image picture = sim::render_solid(view, {}, rng);
  const auto spheres = SolidRecogniser::make({SolidKind::kEllipsoid, SolidKind::kSphere}, model, {});
  ASSERT_TRUE(spheres) << spheres.error().message;
  const auto report = (*spheres)->recognise(picture);
  ASSERT_TRUE(report);
  ASSERT_EQ(report->sightings.size(), 1U);
  const Sighting& sighting = report->sightings[0];
  EXPECT_EQ(sighting.target, 1);
  EXPECT_GT(sighting.score, 0.5);
  EXPECT_NEAR(sighting.u_px, 420.0, 6.0);
  EXPECT_LT(sighting.bearing_base_rad, 0.0);  // right of the middle
  const auto prisms = SolidRecogniser::make({SolidKind::kTriangularPrism}, model, {});
  EXPECT_TRUE((*prisms)->recognise(picture)->sightings.empty());
  EXPECT_FALSE((*prisms)->recognise(Image()));
  EXPECT_EQ((*prisms)->explain(picture)->size(), 3U);
  EXPECT_FALSE(SolidRecogniser::make({}, model, {}));
  EXPECT_FALSE(SolidRecogniser::make({SolidKind::kSphere}, SolidModel{}, {}));
}

/// What the camera of config/robots/tank.yaml is configured with.
RecogniserParams tank_view() {
  RecogniserParams params;
  params.view.photo_fov_rad = deg_to_rad(49.13);
  params.view.photo_tilt_rad = deg_to_rad(40.0);
  params.view.photo_height_m = 0.8;
  return params;
}

/// A sphere of 0.1 m radius at (range, bearing) from the camera, as that camera sees it.
Image sphere_in_tank(double range_m, double bearing_rad) {
  sim::TankEye eye;
  eye.position = {0.0, 0.0, 0.8};
  eye.tilt_rad = deg_to_rad(40.0);
  const Pose2 place{range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad), 0.0};
  Rng rng(5);
  return sim::render_tank({{SolidKind::kSphere, place, 0.1, 1.0, 0.75}}, eye, {}, {}, rng);
}

TEST(SolidRecogniser, LocatesTheSolidByTheCamerasHeightAndTilt) {
  const SolidModel model = quick_model();
  const WantedSolids all{kSolidKinds.begin(), kSolidKinds.end()};
  const auto recogniser = SolidRecogniser::make(all, model, tank_view().view);
  ASSERT_TRUE(recogniser);
  for (const double range_m : {0.7, 0.95, 1.2}) {
    for (const double bearing_deg : {-12.0, 0.0, 12.0}) {
      const auto report = (*recogniser)->recognise(sphere_in_tank(range_m, deg_to_rad(bearing_deg)));
      ASSERT_TRUE(report);
      ASSERT_EQ(report->sightings.size(), 1U) << range_m << " " << bearing_deg;
      const Sighting& sighting = report->sightings[0];
      EXPECT_NEAR(rad_to_deg(sighting.bearing_base_rad), bearing_deg, 1.0) << range_m;
      ASSERT_TRUE(sighting.floor_range_m);
      EXPECT_NEAR(*sighting.floor_range_m, range_m, 0.08) << bearing_deg;
    }
  }
}

TEST(PhotoView, OfALevelCameraNeverSeesTheFloorAtTheHorizon) {
  ViewParams params = tank_view().view;
  params.photo_tilt_rad = 0.0;
  const PhotoView level(params, 640, 480);
  EXPECT_FALSE(level.floor_range_m(319.5, 239.5));
  ASSERT_TRUE(level.floor_range_m(319.5, 439.5));
  EXPECT_NEAR(*level.floor_range_m(319.5, 439.5), 0.8 * level.focal_px() / 200.0, 1e-9);
  params.photo_height_m = 0.0;
  EXPECT_FALSE(PhotoView(params, 640, 480).floor_range_m(319.5, 439.5)) << "its height is not known";
}

TEST(TargetRecogniser, FindsPicturesAndSolidsOfOneListAndCountsInIt) {
  TargetModel board;
  board.name = "board";
  board.picture = Image(32, 32, 1);
  for (int v = 0; v < 32; ++v) {
    for (int u = 0; u < 32; ++u) {
      *board.picture.at(u, v) = static_cast<std::uint8_t>((u / 4 + v / 4) % 2 == 0 ? 20 : 230);
    }
  }
  TargetModel sphere;
  sphere.kind = TargetKind::kSolid;
  const SolidModel model = quick_model();
  const auto both = make_target_recogniser({board, sphere}, tank_view(), &model);
  ASSERT_TRUE(both) << both.error().message;
  const auto report = (*both)->recognise(sphere_in_tank(0.95, 0.0));
  ASSERT_TRUE(report);
  ASSERT_EQ(report->sightings.size(), 1U);
  EXPECT_EQ(report->sightings[0].target, 1);
  EXPECT_FALSE(make_target_recogniser({}, tank_view(), &model));
}

TEST(TargetRecogniser, RefusesSolidsWithTheRemedyWhereTheRobotCannotRecogniseThem) {
  TargetModel sphere;
  sphere.kind = TargetKind::kSolid;
  const auto no_model = make_target_recogniser({sphere}, tank_view(), nullptr);
  ASSERT_FALSE(no_model);
  EXPECT_EQ(no_model.error().code, Errc::kRefused);
  EXPECT_NE(no_model.error().message.find("train-solids"), std::string::npos) << no_model.error().message;
  RecogniserParams mirror;
  mirror.view.omni.emplace();
  const SolidModel model = quick_model();
  const auto omni = make_target_recogniser({sphere}, mirror, &model);
  ASSERT_FALSE(omni);
  EXPECT_EQ(omni.error().code, Errc::kRefused);
  EXPECT_NE(omni.error().message.find("omnidirectional"), std::string::npos);
}

TEST(SolidModelFile, EveryShippedOneIsSound) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testing::source_file("config/solids"))) {
    const auto model = options::load_solid_model(entry.path());
    EXPECT_TRUE(model) << model.error().message;
    ++count;
  }
  EXPECT_GE(count, 1);
}

TEST(SolidModelFile, ComesBackAndRefusesOthers) {
  Rng rng(1);
  std::vector<TrainingSample> samples;
  for (int i = 0; i < 12; ++i) {
    std::vector<double> input;
    for (std::size_t k = 0; k < kSolidFeatures; ++k) {
      input.push_back(rng.normal(1.0));
    }
    samples.push_back({input, i % 4});
  }
  SolidModel model;
  model.network = train_network(samples, 4, {.epochs = 3}, rng)->network;
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "solids-test.yaml";
  const std::string text = options::print_solid_model(model);
  std::ofstream(file) << text;
  const auto again = options::load_solid_model(file);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, model);
  std::string newer = text;
  newer.replace(newer.find("version: 1"), 10, "version: 2");
  std::ofstream(file) << newer;
  EXPECT_EQ(options::load_solid_model(file).error().code, Errc::kUnsupportedVersion);
  std::ofstream(file) << "version: 1\n";
  EXPECT_EQ(options::load_solid_model(file).error().code, Errc::kInvalidArgument);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace seeker::vision
