#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/server/localize/landmark_room.hpp"

namespace seeker::localize {
namespace {

using ::testing::HasSubstr;
using testing::LandmarkRoom;
using testing::ViewNoise;

vision::Descriptor random_descriptor(Rng& rng) { return testing::descriptor_of(testing::random_look(rng), 0.0, rng); }

/// A landmark at a place, as certain as 2 cm.
Landmark landmark_at(const Point3& p, const vision::Descriptor& descriptor) {
  SeenPoint point;
  point.map = {p, 0.02 * 0.02 * Matrix3::Identity()};
  point.to_eye = Point3::UnitX();
  point.scale_m = 0.01;
  return make_landmark(point, descriptor);
}

SeenPoint point_at(const Point3& p, double sigma_m = 0.02) {
  SeenPoint point;
  point.map = {p, sigma_m * sigma_m * Matrix3::Identity()};
  point.to_eye = Point3::UnitX();
  return point;
}

/// A feature that an eye at the origin sees so far ahead and to the left.
vision::StereoFeature feature_of(const Point3& p_eye, const vision::Descriptor& descriptor) {
  const Pixel pixel = *project({}, p_eye);
  vision::StereoFeature feature;
  feature.left = {static_cast<float>(pixel.u_px), static_cast<float>(pixel.v_px), 3.0F, 0.0F};
  feature.disparity_px = pixel.disparity_px;
  feature.descriptor = descriptor;
  return feature;
}

TEST(Landmark, ObservationsOfEqualCertaintyMeetHalfWay) {
  Rng rng(1);
  const auto descriptor = random_descriptor(rng);
  for (const bool running_mean : {false, true}) {
    Landmark landmark = landmark_at({1.0, 0.0, 0.0}, descriptor);
    fuse(landmark, point_at({1.1, 0.0, 0.0}), descriptor, {running_mean});
    EXPECT_NEAR(landmark.p_map.x(), 1.05, 1e-6);
    EXPECT_EQ(landmark.seen, 2);
    EXPECT_NEAR(landmark.covariance()(0, 0), 0.02 * 0.02 / 2.0, 1e-6);
  }
}

TEST(Landmark, CertainObservationsWeighMore) {
  Rng rng(1);
  const auto descriptor = random_descriptor(rng);
  Landmark landmark = landmark_at({1.0, 0.0, 0.0}, descriptor);
  fuse(landmark, point_at({1.1, 0.0, 0.0}, 0.2), descriptor, {});
  EXPECT_NEAR(landmark.p_map.x(), 1.0 + 0.1 / 101.0, 1e-4);
}

TEST(Landmark, KeepsADescriptorForEachSideAndNoMoreThanFour) {
  Rng rng(1);
  Landmark landmark = landmark_at({0, 0, 0}, random_descriptor(rng));
  for (int i = 0; i < 24; ++i) {
    SeenPoint point = point_at({0, 0, 0});
    const double side = deg_to_rad(15.0 * i);
    point.to_eye = {std::cos(side), std::sin(side), 0.0};
    fuse(landmark, point, random_descriptor(rng), {});
  }
  EXPECT_EQ(landmark.views.size(), kMaxViews);
  EXPECT_EQ(landmark.seen, 25);
  EXPECT_LT(landmark.concentration, 0.2) << "it was seen from all around";
}

TEST(Database, IdsAreNeverGivenOutTwice) {
  Rng rng(1);
  LandmarkDatabase database;
  const auto first = database.insert(landmark_at({0, 0, 0}, random_descriptor(rng)));
  const auto second = database.insert(landmark_at({1, 0, 0}, random_descriptor(rng)));
  EXPECT_EQ(database.erase_if([&](const Landmark& landmark) { return landmark.id == second; }), 1U);
  const auto third = database.insert(landmark_at({2, 0, 0}, random_descriptor(rng)));
  EXPECT_NE(third, second);
  EXPECT_NE(third, first);
  EXPECT_EQ(database.find(second), nullptr);
  ASSERT_NE(database.find(third), nullptr);
  EXPECT_EQ(database.find(third)->p_map.x(), 2.0);
}

RC_GTEST_PROP(Database, FindsNeighboursAsLookingAtEachWould, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const auto somewhere = [&] { return Point3(rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-1, 1)); };
  LandmarkDatabase database;
  for (int i = 0; i < 60; ++i) {
    database.insert(landmark_at(somewhere(), {}));
  }
  for (std::size_t i = 0; i < 20; ++i) {
    database.change(i, [&](Landmark& landmark) { landmark.p_map += 0.3 * somewhere(); });
  }
  database.erase_if([](const Landmark& landmark) { return landmark.id % 7 == 0; });
  const Point3 centre = somewhere();
  const double radius_m = rng.uniform(0.0, 2.0);
  std::vector<LandmarkId> found;
  database.for_near(centre, radius_m, [&](std::size_t index) { found.push_back(database.at(index).id); });
  std::sort(found.begin(), found.end());
  std::vector<LandmarkId> expected;
  for (const Landmark& landmark : database.landmarks()) {
    if ((landmark.p_map - centre).norm() <= radius_m) {
      expected.push_back(landmark.id);
    }
  }
  std::sort(expected.begin(), expected.end());
  RC_ASSERT(found == expected);
}

TEST(Database, RestoredIsTheSame) {
  const LandmarkDatabase database = survey(LandmarkRoom(1, 300), {}, {}, 2);
  ASSERT_GT(database.size(), 50U);
  const auto restored =
      LandmarkDatabase::restore(database.calibration(), database.next_id(), database.sightings(), database.landmarks());
  ASSERT_TRUE(restored) << restored.error().message;
  EXPECT_TRUE(*restored == database);
}

TEST(Database, RefusesWhatIsNoLandmark) {
  Rng rng(1);
  Landmark good = landmark_at({0, 0, 0}, random_descriptor(rng));
  good.id = 1;
  const auto refused = [](const Landmark& landmark) {
    const auto database = LandmarkDatabase::restore(0, 10, 0, {landmark});
    return !database && database.error().code == Errc::kCorrupt;
  };
  EXPECT_FALSE(refused(good));
  const auto spoilt = [&](auto spoil) {
    Landmark landmark = good;
    spoil(landmark);
    return refused(landmark);
  };
  EXPECT_TRUE(spoilt([](Landmark& l) { l.id = 0; }));
  EXPECT_TRUE(spoilt([](Landmark& l) { l.id = 10; }));
  EXPECT_TRUE(spoilt([](Landmark& l) { l.p_map.x() = std::nan(""); }));
  EXPECT_TRUE(spoilt([](Landmark& l) { l.p_map.y() = 1e9; }));
  EXPECT_TRUE(spoilt([](Landmark& l) { l.information = -Matrix3::Identity(); }));
  EXPECT_TRUE(spoilt([](Landmark& l) { l.views.clear(); }));
  EXPECT_TRUE(spoilt([](Landmark& l) { l.views.resize(kMaxViews + 1, l.views.front()); }));
  EXPECT_TRUE(spoilt([](Landmark& l) { l.views.front().to_eye = Point3::Zero(); }));
  EXPECT_TRUE(spoilt([](Landmark& l) { l.concentration = 2.0; }));
  EXPECT_TRUE(spoilt([](Landmark& l) { l.log_odds = std::nan(""); }));
  EXPECT_TRUE(spoilt([](Landmark& l) { l.seen = 0; }));
  const auto twice = LandmarkDatabase::restore(0, 10, 0, {good, good});
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().message, HasSubstr("same id"));
}

TEST(Association, IsMutualOnly) {
  Rng rng(4);
  const auto look = testing::random_look(rng);
  LandmarkDatabase database;
  database.insert(landmark_at({3.0, 0.0, 0.0}, testing::descriptor_of(look, 0.0, rng)));
  Sighting sighting;
  sighting.features = {feature_of({3.0, 0.01, 0.0}, testing::descriptor_of(look, 0.3, rng)),
                       feature_of({3.0, 0.0, 0.0}, testing::descriptor_of(look, 0.1, rng))};
  for (const bool anywhere : {false, true}) {
    AssociationParams params;
    params.anywhere = anywhere;
    const auto points = see({}, sighting, {}, {});
    const auto pairs = associate(database, sighting.features, points, params);
    ASSERT_EQ(pairs.size(), 1U) << "one landmark, one feature";
    EXPECT_EQ(pairs[0].point, 1U) << "the more alike one";
  }
}

TEST(Association, OutsideThePlaceIsOnlyWithThePaper) {
  Rng rng(4);
  const auto descriptor = random_descriptor(rng);
  LandmarkDatabase database;
  database.insert(landmark_at({3.0, 2.0, 0.0}, descriptor));
  Sighting sighting;
  sighting.features = {feature_of({3.0, 0.0, 0.0}, descriptor)};
  const auto points = see({}, sighting, {}, {});
  AssociationParams params;
  EXPECT_TRUE(associate(database, sighting.features, points, params).empty());
  params.anywhere = true;
  EXPECT_EQ(associate(database, sighting.features, points, params).size(), 1U);
}

TEST(Association, RefusesWhatLooksDifferent) {
  Rng rng(4);
  LandmarkDatabase database;
  database.insert(landmark_at({3.0, 0.0, 0.0}, random_descriptor(rng)));
  Sighting sighting;
  sighting.features = {feature_of({3.0, 0.0, 0.0}, random_descriptor(rng))};
  EXPECT_TRUE(associate(database, sighting.features, see({}, sighting, {}, {}), {}).empty());
}

TEST(Sparsity, FollowsEquationsEightAndNine) {
  Rng rng(4);
  const auto look = testing::random_look(rng);
  const auto same = testing::descriptor_of(look, 0.0, rng);
  const auto other = random_descriptor(rng);
  LandmarkDatabase database;
  database.insert(landmark_at({0, 0, 0}, same));
  const auto allowed = [&](double distance, const vision::Descriptor& descriptor) {
    return may_insert(database, point_at({distance, 0, 0}), descriptor, {}, vision::Metric::kL2);
  };
  EXPECT_FALSE(allowed(0.03, other)) << "nothing within the inner radius";
  EXPECT_TRUE(allowed(0.15, other)) << "another feature within the outer one";
  EXPECT_FALSE(allowed(0.15, same));
  EXPECT_TRUE(allowed(0.30, same)) << "anything outside";
  SparsityParams off;
  off.on = false;
  EXPECT_TRUE(may_insert(database, point_at({0, 0, 0}), same, off, vision::Metric::kL2));
}

TEST(Sparsity, KeepsWhatWasSeenMostOften) {
  Rng rng(4);
  LandmarkDatabase database;
  const auto insert = [&](double x_m, int seen) {
    Landmark landmark = landmark_at({x_m, 0.0, 0.0}, random_descriptor(rng));
    landmark.seen = seen;
    return database.insert(std::move(landmark));
  };
  const LandmarkId first = insert(0.0, 3);
  const LandmarkId best = insert(0.04, 5);
  const LandmarkId beyond = insert(0.08, 3);  // near the best, not near the first
  const LandmarkId apart = insert(0.5, 3);
  LandmarkDatabase untouched = database;
  SparsityParams params;
  EXPECT_EQ(thin_out(database, params, vision::Metric::kL2), 2U);
  EXPECT_NE(database.find(best), nullptr);
  EXPECT_NE(database.find(apart), nullptr);
  EXPECT_EQ(database.find(first), nullptr);
  EXPECT_EQ(database.find(beyond), nullptr);
  params.on = false;
  EXPECT_EQ(thin_out(untouched, params, vision::Metric::kL2), 0U);
}

TEST(Survey, CountsOfEverySightingAddUp) {
  const LandmarkRoom room(3, 400);
  Rng rng(6);
  SurveyBuilder builder({}, {});
  int inserted = 0;
  for (const Sighting& sighting : survey_sightings(room, {}, {}, rng)) {
    const auto counts = builder.add(sighting);
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->features, static_cast<int>(sighting.features.size()));
    EXPECT_EQ(counts->in_range, counts->matched + counts->sparsified + counts->inserted);
    EXPECT_EQ(builder.fates().size(), sighting.features.size());
    inserted += counts->inserted;
  }
  EXPECT_EQ(builder.database().size(), static_cast<std::size_t>(inserted));
  EXPECT_EQ(builder.database().sightings(), 60U);
}

TEST(Survey, SparseAndSalientAreSmallerThanAll) {
  const LandmarkRoom room(3, 400);
  for (const DatabaseParams& base : {DatabaseParams{}, paper_database_params()}) {
    DatabaseParams wide = base;
    wide.sparsity.inner_radius_m = 0.10;  // the room's points are few
    wide.sparsity.outer_radius_m = 0.50;
    DatabaseParams all = wide;
    all.sparsity.on = false;
    all.salient_seen = 1;
    DatabaseParams sparse = wide;
    sparse.salient_seen = 1;
    ViewNoise noise;
    noise.descriptor = 0.2;  // the paper's gate is narrow
    const auto count = [&](const DatabaseParams& params) { return survey(room, {}, params, 7, noise).size(); };
    EXPECT_GT(count(all), count(sparse));
    EXPECT_GT(count(sparse), count(wide));
    EXPECT_GT(count(wide), 50U);
  }
}

TEST(Survey, LandmarksLieWhereTheirPointsAre) {
  LandmarkRoom room(3, 400);
  const LandmarkDatabase database = survey(room, {}, {}, 7);
  int near = 0;
  int inside = 0;
  for (const Landmark& landmark : database.landmarks()) {
    double nearest_m = 1e9;
    Point3 error = Point3::Zero();
    for (const auto& point : room.points()) {
      if ((point.p_map - landmark.p_map).norm() < nearest_m) {
        nearest_m = (point.p_map - landmark.p_map).norm();
        error = point.p_map - landmark.p_map;
      }
    }
    near += nearest_m < 0.10 ? 1 : 0;
    inside += error.dot(landmark.information * error) < 11.345 ? 1 : 0;
  }
  EXPECT_GT(near, 0.97 * static_cast<double>(database.size()));
  EXPECT_GT(inside, 0.90 * static_cast<double>(database.size())) << "covariances state the errors";
}

TEST(Survey, RefusesPosesThatCannotBe) {
  SurveyBuilder builder({}, {});
  Sighting sighting;
  sighting.map_T_eye.x_m = std::nan("");
  ASSERT_FALSE(builder.add(sighting));
  EXPECT_EQ(builder.add(sighting).error().code, Errc::kInvalidArgument);
  sighting.map_T_eye = {5e6, 0.0, 0.0};
  ASSERT_FALSE(builder.add(sighting));
  EXPECT_THAT(builder.add(sighting).error().message, HasSubstr("origin"));
  EXPECT_EQ(builder.database().sightings(), 0U);
}

}  // namespace
}  // namespace seeker::localize
