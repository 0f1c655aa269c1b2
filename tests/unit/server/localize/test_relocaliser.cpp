// The search of the whole database for the place of one view.

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/localize/landmark_map.hpp"
#include "server/localize/relocaliser.hpp"
#include "tests/unit/server/localize/landmark_room.hpp"

namespace seeker::localize {
namespace {

using ::testing::HasSubstr;
using testing::LandmarkRoom;
using testing::surveyed;
using testing::ViewNoise;

/// Verdict of single views from places all over a room of 10 m.
std::map<RelocaliseVerdict, int> verdicts(const LandmarkMap& map, const LandmarkRoom& seen, int views,
                                          double& worst_m) {
  Rng rng(31);
  const LocaliserParams params;
  std::map<RelocaliseVerdict, int> counts;
  for (int i = 0; i < views; ++i) {
    const Pose2 truth{rng.uniform(1.5, 8.5), rng.uniform(1.5, 8.5), rng.uniform(-kPi, kPi)};
    const auto features = seen.view(truth, {}, {}, rng);
    const auto lifted = lift({}, features, params);
    const RelocaliseAnswer answer = relocalise({}, map, features, lifted, params, rng);
    ++counts[answer.verdict];
    if (answer.verdict == RelocaliseVerdict::kFound) {
      worst_m = std::max(worst_m, distance_m(answer.belief.map_T_eye, truth));
    }
  }
  return counts;
}

TEST(Relocalisation, FindsAlmostEveryPlaceOfTheSurveyedRoom) {
  const LandmarkRoom room(2, 900);
  const LandmarkMap map(surveyed(room, 2), 0.01);
  double worst_m = 0.0;
  const auto counts = verdicts(map, room, 40, worst_m);
  EXPECT_GE(counts.at(RelocaliseVerdict::kFound), 38);
  EXPECT_LT(worst_m, 0.5);
}

TEST(Relocalisation, RefusesEveryViewOfAForeignRoom) {
  const LandmarkMap map(surveyed(LandmarkRoom(2, 600), 2), 0.01);
  double worst_m = 0.0;
  const auto counts = verdicts(map, LandmarkRoom(77, 600), 60, worst_m);
  EXPECT_FALSE(counts.contains(RelocaliseVerdict::kFound));
}

/// One poster of many points, hung `walls` times, in an otherwise bare room.
LandmarkRoom poster_room(const std::vector<int>& walls, int others) {
  LandmarkRoom room(5, others);
  Rng rng(8);
  for (int i = 0; i < 80; ++i) {
    const auto look = testing::random_look(rng);
    const double along_m = rng.uniform(-1.2, 1.2);
    const double height_m = rng.uniform(-0.8, 0.8);
    for (const int wall : walls) {
      // Walls 2 and 3 run in the opposite direction: the same picture hangs on all of them.
      const bool turned = wall >= 2;
      room.add(wall, 5.0 + (turned ? -along_m : along_m), height_m, look);
    }
  }
  return room;
}

TEST(Relocalisation, APosterThatHangsTwiceIsRefused) {
  LocaliserParams params;
  const Pose2 truth{5.0, 4.5, -kPi / 2.0};  // looks at wall 0
  for (const auto& [walls, verdict] :
       std::vector<std::pair<std::vector<int>, RelocaliseVerdict>>{{{0}, RelocaliseVerdict::kFound},
                                                                   {{0, 2}, RelocaliseVerdict::kAmbiguous},
                                                                   {{0, 1, 2, 3}, RelocaliseVerdict::kAmbiguous}}) {
    const LandmarkRoom room = poster_room(walls, 20);
    DatabaseParams database;
    database.sparsity.inner_radius_m = 0.02;
    database.sparsity.outer_radius_m = 0.02;
    const LandmarkMap map(surveyed(room, 2, database), 0.01);
    Rng rng(3);
    int right = 0;
    for (int i = 0; i < 5; ++i) {
      const auto features = room.view(truth, {}, {}, rng);
      const auto answer = relocalise({}, map, features, lift({}, features, params), params, rng);
      right += answer.verdict == verdict ? 1 : 0;
    }
    EXPECT_EQ(right, 5) << walls.size() << " posters";
  }
}

// Seven metres away there is only one wall to see, and a near object was moved.
TEST(Relocalisation, APlaceThatLeansOnOneMatchIsNotFoundWrongly) {
  const Pose2 truth{1.2, 2.6, 0.5 * kPi};
  constexpr double kMoved_m = 0.4;
  constexpr double kWrong_m = 0.3;
  LandmarkRoom room(91, 1500);
  const LocaliserParams params;
  const LandmarkMap map(surveyed(room, 92), params.landmark_sigma_floor_m);
  LandmarkRoom far = room;
  std::erase_if(far.points(), [](const auto& point) { return point.p_map.y() < 9.99 || point.p_map.x() > 2.6; });
  constexpr std::size_t kFar = 30;
  far.points().resize(kFar);
  int near = 0;
  Rng rng(93);
  for (const auto& point : room.points()) {
    if (point.p_map.x() > 0.01 || point.p_map.y() < 4.4 || point.p_map.y() > 6.0) {
      continue;
    }
    LandmarkRoom changed = far;
    changed.points().push_back(point);
    changed.points().back().p_map.x() += kMoved_m;
    ViewNoise noise;
    noise.detection = 1.0;
    const auto features = changed.view(truth, {}, noise, rng);
    const auto answer = relocalise({}, map, features, lift({}, features, params), params, rng);
    EXPECT_FALSE(answer.verdict == RelocaliseVerdict::kFound && distance_m(answer.belief.map_T_eye, truth) > kWrong_m)
        << answer.reason << ", " << distance_m(answer.belief.map_T_eye, truth) << " m off";
    ++near;
  }
  EXPECT_GT(near, 10);
}

TEST(Relocalisation, AMatchOfAnotherScaleIsNone) {
  const LandmarkRoom room(2, 900);
  const LandmarkMap map(surveyed(room, 2), 0.01);
  const LocaliserParams params;
  Rng rng(6);
  auto features = room.view({5.0, 4.5, -kPi / 2.0}, {}, {}, rng);
  EXPECT_EQ(relocalise({}, map, features, lift({}, features, params), params, rng).verdict, RelocaliseVerdict::kFound);
  for (vision::StereoFeature& feature : features) {
    feature.left.scale_px *= 2.0F;
  }
  const auto answer = relocalise({}, map, features, lift({}, features, params), params, rng);
  EXPECT_EQ(answer.verdict, RelocaliseVerdict::kNothing);
  EXPECT_EQ(answer.candidates, 0);
}

TEST(Relocalisation, ManyMatchesThatAreHardlyAlikeAreNotEnough) {
  const LandmarkRoom room(2, 900);
  const LandmarkMap map(surveyed(room, 2), 0.01);
  LocaliserParams params;
  Rng rng(6);
  const auto features = room.view({5.0, 4.5, -kPi / 2.0}, {}, {}, rng);
  const auto lifted = lift({}, features, params);
  const auto found = relocalise({}, map, features, lifted, params, rng);
  ASSERT_EQ(found.verdict, RelocaliseVerdict::kFound);
  params.relocalise.min_likeness = 1.01 * found.likeness;
  EXPECT_EQ(relocalise({}, map, features, lifted, params, rng).verdict, RelocaliseVerdict::kFound)
      << "most of the matches agree";
  params.relocalise.many_share = 1.0;
  const auto refused = relocalise({}, map, features, lifted, params, rng);
  EXPECT_EQ(refused.verdict, RelocaliseVerdict::kNothing);
  EXPECT_THAT(refused.reason, HasSubstr("hardly alike"));
}

TEST(Relocalisation, AnEmptyFrameIsNothing) {
  const LandmarkMap map(surveyed(LandmarkRoom(2, 200), 2), 0.01);
  Rng rng(1);
  EXPECT_EQ(relocalise({}, map, {}, {}, {}, rng).verdict, RelocaliseVerdict::kNothing);
}

}  // namespace
}  // namespace seeker::localize
