#include <gtest/gtest.h>

#include "ring_trip.hpp"
#include "rooms.hpp"
#include "server/slam/line_slam.hpp"

namespace seeker::slam {
namespace {

/// The map of the ring, and of a room that lies so far to the north-east of it.
LineMap ring_and_room(double away_m) {
  Trip trip(9);
  LineSlam mapper({}, trip.truth());
  drive(trip, mapper, 60.0);
  LineMap map = mapper.map();
  const MapNode last = map.nodes.back();
  const Pose2 far{away_m, away_m, 0.0};
  map.nodes.push_back({last.id + 1, far, last.created});
  map.edges.push_back({last.id, last.id + 1, inverse(last.map_T_node) * far, Matrix3::Identity(), false, true});
  Rng rng(1);
  for (const Pose2& node_T_base : {Pose2{2.0, 2.0, 0.3}, Pose2{6.0, 3.0, 2.0}}) {
    map.keyframes.push_back(pack_keyframe(scan_at(furnished_room(), node_T_base, 0.0, rng), last.id + 1, node_T_base));
  }
  return map;
}

void drive_until_found(Trip& trip, LineSlam& slam, int metres) {
  for (int metre = 0; metre < metres && slam.estimate().quality != LocalisationQuality::kLocalised; ++metre) {
    ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 1.0));
  }
}

TEST(LineSlamPlaces, ANamedPlaceIsFoundHoweverLargeTheMap) {
  LineSlam slam;
  ASSERT_TRUE(slam.load(ring_and_room(5000.0), MapUse::kLocalise));
  Trip trip(10, {5.0, 1.0, 0.0});
  ASSERT_TRUE(slam.relocalise(trip.truth()));
  ASSERT_NO_FATAL_FAILURE(drive_until_found(trip, slam, 4));
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.2);
}

TEST(LineSlamPlaces, WhereItStoodIsFoundHoweverLargeTheMap) {
  LineSlam slam;
  ASSERT_TRUE(slam.load(ring_and_room(5000.0), MapUse::kLocalise));
  Trip trip(10, {5.0, 1.0, 0.0});
  ASSERT_TRUE(slam.look_where_it_stood(trip.truth()));
  ASSERT_NO_FATAL_FAILURE(drive_until_found(trip, slam, 2));
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.2);
}

TEST(LineSlamPlaces, ARobotIsFoundAnywhereInAMapThatIsTooLargeForTheFinestSearch) {
  LineSlamParams params;
  params.relocalise.map.pyramid.max_bytes = 20'000'000;  // of the 150 MB that the map would need
  LineSlam slam(params);
  ASSERT_TRUE(slam.load(ring_and_room(100.0), MapUse::kLocalise));
  Trip trip(10, {15.0, 3.0, 1.4});
  ASSERT_NO_FATAL_FAILURE(drive_until_found(trip, slam, 10));
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.2);
}

TEST(LineSlamPlaces, AMapTooLargeForAnySearchSaysThatAPlaceHasToBeNamed) {
  LineSlam slam;
  ASSERT_TRUE(slam.load(ring_and_room(5000.0), MapUse::kLocalise));
  Trip trip(10, {15.0, 3.0, 1.4});
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 1.0));
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kUnknown);
  EXPECT_NE(slam.estimate().cause.find("name the robot's place"), std::string::npos) << slam.estimate().cause;
}

TEST(LineSlamPlaces, ANamedPlaceThatTheMapDoesNotShowIsSaidToBeNone) {
  LineSlam slam;
  ASSERT_TRUE(slam.load(ring_and_room(100.0), MapUse::kLocalise));
  Trip trip(10, {5.0, 1.0, 0.0});
  ASSERT_TRUE(slam.relocalise(Pose2{-90.0, 0.0, 0.0}));
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 1.0));
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kUnknown);
  EXPECT_NE(slam.estimate().cause.find("shows nothing about the place"), std::string::npos) << slam.estimate().cause;
}

/// A robot in the open that has seen one face of a pillar, goes round it by its wheels and meets the other.
TEST(LineSlamPlaces, TheBackOfAPillarDoesNotContradictItsFront) {
  const std::vector<Wall> pillar = box(3.0, -0.2, 3.4, 0.2);
  Rng rng(5);
  LineSlam slam;
  double time_s = 0.0;
  const auto go = [&](const Pose2& from, const Pose2& to) {
    constexpr int kSteps = 40;
    for (int k = 1; k <= kSteps; ++k, time_s += 0.1) {
      const double share = static_cast<double>(k) / kSteps;
      const Pose2 truth{from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m),
                        from.theta_rad + share * (to.theta_rad - from.theta_rad)};
      ASSERT_TRUE(slam.predict(truth, robot_time_s(time_s)));
      (void)slam.update(scan_at(pillar, truth, time_s, rng));
      EXPECT_NE(slam.estimate().quality, LocalisationQuality::kLost) << time_s << ": " << slam.estimate().cause;
    }
  };
  const std::vector<Pose2> path{{0.0, 0.0, 0.0},       {1.0, 0.0, 0.0},       {1.0, 0.0, kPi / 2.0},
                                {1.0, 3.0, kPi / 2.0}, {6.0, 3.0, kPi / 2.0}, {6.0, 0.0, kPi / 2.0},
                                {6.0, 0.0, kPi},       {5.5, 0.0, kPi}};
  for (std::size_t k = 1; k < path.size(); ++k) {
    ASSERT_NO_FATAL_FAILURE(go(path[k - 1], path[k]));
  }
  EXPECT_LT(distance_m(slam.estimate().map_T_base, path.back()), 0.3) << "what the wheels may be off by";
}

/// Takes at its word whoever says where the robot stood, whatever the scans say; asked so seldom that no right answers
/// come before the wrong one.
RelocaliseParams gullible() {
  RelocaliseParams params;
  params.every_m = 0.4;
  params.place.judge.max_through = 2.0;
  params.place.kept.min_fit = 0.0;
  params.place.kept.max_disagreement = 2.0;
  params.place.kept.max_m = 10.0;
  params.place.kept.min_lead = 9.0;
  return params;
}

/// A robot that drives round in the furnished room; its wheels are right.
class Rounds {
 public:
  explicit Rounds(std::uint64_t seed) : rng_(seed) {}

  void drive(LineSlam& slam, int scans) {
    for (int k = 0; k < scans; ++k, time_s_ += 0.1) {
      ASSERT_TRUE(slam.predict(truth_, robot_time_s(time_s_)));
      (void)slam.update(scan_at(furnished_room(), truth_, time_s_, rng_));
      truth_ = truth_ * integrate({0.4, 0.28}, 0.1);
    }
  }
  [[nodiscard]] const Pose2& truth() const { return truth_; }

 private:
  Rng rng_;
  Pose2 truth_{2.5, 2.2, 0.0};
  double time_s_ = 0.0;
};

TEST(LineSlamPlaces, ARobotThatWasTakenForSomewhereElseFindsOutAndLooksForItsPlaceAgain) {
  Rounds first(1);
  LineSlam mapper({}, first.truth());
  ASSERT_NO_FATAL_FAILURE(first.drive(mapper, 300));
  Rounds second(2);
  LineSlamParams params;
  params.relocalise = gullible();
  LineSlam slam(params);
  ASSERT_TRUE(slam.load(mapper.map(), MapUse::kLocalise));
  ASSERT_TRUE(slam.look_where_it_stood(second.truth() * Pose2{4.0, 1.0, 2.0}));
  ASSERT_NO_FATAL_FAILURE(second.drive(slam, 40));
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised);
  ASSERT_GT(distance_m(slam.estimate().map_T_base, second.truth()), 1.0) << "this is what is to be found out";
  ASSERT_NO_FATAL_FAILURE(second.drive(slam, 600));
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, second.truth()), 0.1);
}

}  // namespace
}  // namespace seeker::slam
