#include "server/slam/place_recogniser.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "rooms.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::slam {
namespace {

using testing::Pose2Near;

std::vector<Wall> shifted(std::vector<Wall> walls, double x_m) {
  for (auto& [a, b] : walls) {
    a.x() += x_m;
    b.x() += x_m;
  }
  return walls;
}

std::vector<Wall> both(std::vector<Wall> walls, const std::vector<Wall>& more) {
  walls.insert(walls.end(), more.begin(), more.end());
  return walls;
}

/// What a robot saw from these places, looking all around.
std::vector<SeenPoints> seen_from(const std::vector<Wall>& walls, const std::vector<Pose2>& poses, Rng& rng) {
  std::vector<SeenPoints> seen;
  for (const Pose2& pose : poses) {
    seen.push_back(transform(pose, seen_points(scan_at(walls, pose, 0.0, rng, kTwoPi))));
  }
  return seen;
}

const std::vector<Pose2> kViews{{1.5, 1.5, 0.0}, {2.5, 4.5, 1.0}, {6.0, 3.0, 2.0},
                                {8.5, 5.0, 3.0}, {8.0, 1.5, 0.5}, {4.5, 3.0, 0.0}};

std::vector<Pose2> shifted(std::vector<Pose2> poses, double x_m) {
  for (Pose2& pose : poses) {
    pose.x_m += x_m;
  }
  return poses;
}

/// The furnished room is nearly the same rotated by 180 degrees; a real one has more in it.
std::vector<Wall> office() {
  std::vector<Wall> walls = furnished_room();
  for (const auto& piece : {box(0.0, 5.0, 1.8, 6.0), box(9.2, 0.0, 10.0, 2.2), box(5.2, 5.5, 6.8, 6.0)}) {
    walls.insert(walls.end(), piece.begin(), piece.end());
  }
  return walls;
}

PlaceMap room_map(Rng& rng) { return *PlaceMap::build(seen_from(office(), kViews, rng)); }

std::vector<Wall> corridor() { return box(0.0, 0.0, 40.0, 2.0); }

PlaceMap corridor_map(Rng& rng) {
  std::vector<Pose2> poses;
  for (int k = 1; k < 20; ++k) {
    poses.push_back({2.0 * k, 1.0, 0.0});
  }
  return *PlaceMap::build(seen_from(corridor(), poses, rng));
}

/// People: `share` of the beams end on bodies of about 0.4 m, one to two metres away.
LaserScan with_people(LaserScan scan, double share, Rng& rng) {
  const std::size_t beams = scan.ranges_m.size();
  std::size_t hidden = 0;
  std::vector<bool> taken(beams, false);
  while (static_cast<double>(hidden) < share * static_cast<double>(beams)) {
    const auto range_m = static_cast<float>(rng.uniform(1.0, 2.0));
    const auto width = static_cast<std::size_t>(0.4 / (range_m * scan.angle_step_rad));
    const std::size_t first = rng.below(beams - width);
    for (std::size_t k = first; k < first + width; ++k) {
      if (!taken[k] && range_m < scan.ranges_m[k]) {
        taken[k] = true;
        ++hidden;
        scan.ranges_m[k] = range_m + static_cast<float>(rng.normal(0.01));
      }
    }
  }
  return scan;
}

TEST(PlaceRecogniser, FindsItselfInAFurnishedRoomWhateverTheScannersView) {
  Rng rng(1);
  const PlaceMap map = room_map(rng);
  for (const double fov_deg : {360.0, 240.0, 180.0}) {
    int unique = 0;
    constexpr int kQueries = 25;
    for (int k = 0; k < kQueries; ++k) {
      const Pose2 truth{rng.uniform(1.0, 3.5), rng.uniform(1.0, 5.0), rng.uniform(-kPi, kPi)};
      const auto answer =
          PlaceRecogniser().locate(map, {seen_points(scan_at(office(), truth, 1.0, rng, deg_to_rad(fov_deg)))});
      if (answer.verdict == PlaceVerdict::kUnique) {
        ++unique;
        EXPECT_THAT(answer.candidates.front().match.map_T_base, Pose2Near(truth, 0.05, 0.02)) << fov_deg;
      }
    }
    // A scanner that does not look behind itself sees bare walls from some places: these must not be guessed.
    EXPECT_GE(unique, fov_deg > 300.0 ? kQueries - 2 : kQueries / 3) << fov_deg;
  }
}

TEST(PlaceRecogniser, ASearchThatWasCutShortExcludesNoOtherPlace) {
  Rng rng(1);
  const PlaceMap map = room_map(rng);
  const SeenPoints seen = seen_points(scan_at(office(), {2.0, 3.0, 0.5}, 1.0, rng));
  ASSERT_EQ(PlaceRecogniser().locate(map, {seen}).verdict, PlaceVerdict::kUnique);
  PlaceParams params;
  bool cut_with_a_place = false;
  for (params.search.max_expansions = 1; params.search.max_expansions < 2'000'000; params.search.max_expansions *= 2) {
    const bool complete = GlobalMatcher(params.search).search(map.pyramid(), seen.points).complete;
    const PlaceAnswer answer = PlaceRecogniser(params).locate(map, {seen});
    ASSERT_TRUE(complete || answer.verdict != PlaceVerdict::kUnique) << params.search.max_expansions;
    cut_with_a_place |= !complete && !answer.candidates.empty();
  }
  EXPECT_TRUE(cut_with_a_place) << "no search was cut after it had found a place";
}

TEST(PlaceRecogniser, TwoEqualRoomsAreAmbiguous) {
  Rng rng(2);
  const auto walls = both(furnished_room(), shifted(furnished_room(), 14.0));
  auto poses = kViews;
  for (const Pose2& pose : shifted(kViews, 14.0)) {
    poses.push_back(pose);
  }
  const auto map = PlaceMap::build(seen_from(walls, poses, rng));
  ASSERT_TRUE(map);
  for (const double x_m : {3.0, 17.0}) {
    const Pose2 truth{x_m, 3.2, 0.7};
    const auto answer = PlaceRecogniser().locate(*map, {seen_points(scan_at(walls, truth, 1.0, rng, kTwoPi))});
    EXPECT_EQ(answer.verdict, PlaceVerdict::kAmbiguous) << answer.reason;
    ASSERT_GE(answer.candidates.size(), 2U);
    std::vector<double> found{answer.candidates[0].match.map_T_base.x_m, answer.candidates[1].match.map_T_base.x_m};
    std::sort(found.begin(), found.end());
    EXPECT_NEAR(found[0], 3.0, 0.05);
    EXPECT_NEAR(found[1], 17.0, 0.05);
  }
}

TEST(PlaceRecogniser, OneCupboardDistinguishesTwoRooms) {
  Rng rng(3);
  const auto other = shifted(both(furnished_room(), box(0.0, 4.6, 1.0, 6.0)), 14.0);
  const auto walls = both(furnished_room(), other);
  auto poses = kViews;
  for (const Pose2& pose : shifted(kViews, 14.0)) {
    poses.push_back(pose);
  }
  const auto map = PlaceMap::build(seen_from(walls, poses, rng));
  ASSERT_TRUE(map);
  const Pose2 truth{17.0, 3.2, 0.7};
  const auto answer = PlaceRecogniser().locate(*map, {seen_points(scan_at(walls, truth, 1.0, rng, kTwoPi))});
  ASSERT_FALSE(answer.candidates.empty());
  EXPECT_THAT(answer.candidates.front().match.map_T_base, Pose2Near(truth, 0.05, 0.02));
}

TEST(PlaceRecogniser, LargerCellsOfALargeMapCostNoPrecision) {
  Rng rng(3);
  const std::vector<SeenPoints> seen = seen_from(office(), kViews, rng);
  const Pose2 truth{2.0, 3.0, 0.5};
  const SeenPoints query = seen_points(scan_at(office(), truth, 1.0, rng));
  const PlaceMap fine = *PlaceMap::build(seen);
  EXPECT_FALSE(fine.coarse());
  EXPECT_FALSE(fine.detail_about({0.0, 0.0}, 10.0));
  const PlaceAnswer expected = PlaceRecogniser().locate(fine, {query});
  ASSERT_EQ(expected.verdict, PlaceVerdict::kUnique) << expected.reason;
  for (const double share : {0.5, 0.2, 0.1}) {
    PlaceMapParams params;
    params.pyramid.max_bytes = static_cast<std::size_t>(share * static_cast<double>(fine.pyramid().bytes()));
    const auto map = PlaceMap::build(seen, params);
    ASSERT_TRUE(map) << share;
    EXPECT_TRUE(map->coarse());
    EXPECT_LE(map->pyramid().bytes(), params.pyramid.max_bytes);
    const PlaceAnswer answer = PlaceRecogniser().locate(*map, {query});
    EXPECT_EQ(answer.verdict, PlaceVerdict::kUnique) << share << " " << answer.reason;
    ASSERT_FALSE(answer.candidates.empty());
    EXPECT_THAT(answer.candidates.front().match.map_T_base, Pose2Near(truth, 0.03, 0.02)) << share;
    // Walls lie otherwise in the cells of the detail.
    EXPECT_NEAR(answer.candidates.front().fit.all, expected.candidates.front().fit.all, 0.1) << share;
  }
  PlaceMapParams tiny;
  tiny.pyramid.max_bytes = 1000;
  EXPECT_EQ(PlaceMap::build(seen, tiny).error().code, Errc::kTooLarge);
}

TEST(PlaceRecogniser, ACorridorIsAmbiguousAlongItself) {
  Rng rng(4);
  const auto walls = corridor();
  const PlaceMap map = corridor_map(rng);
  const auto scan = scan_at(walls, {20.0, 1.1, 0.1}, 1.0, rng, kTwoPi, 8.0);
  const auto answer = PlaceRecogniser().locate(map, {seen_points(scan)});
  EXPECT_EQ(answer.verdict, PlaceVerdict::kAmbiguous) << answer.reason;
  EXPECT_GT(answer.candidates.front().fit.all, 0.8);
}

TEST(PlaceRecogniser, PeopleInFrontOfAThirdOfTheBeamsDoNotHideThePlace) {
  Rng rng(5);
  const PlaceMap map = room_map(rng);
  for (int k = 0; k < 15; ++k) {
    const Pose2 truth{rng.uniform(2.0, 3.5), rng.uniform(2.2, 4.0), rng.uniform(-kPi, kPi)};
    const LaserScan scan = with_people(scan_at(office(), truth, 1.0, rng, kTwoPi), 0.3, rng);
    const auto answer = PlaceRecogniser().locate(map, {seen_points(scan)});
    EXPECT_EQ(answer.verdict, PlaceVerdict::kUnique) << truth << " " << answer.reason;
    ASSERT_FALSE(answer.candidates.empty());
    EXPECT_THAT(answer.candidates.front().match.map_T_base, Pose2Near(truth, 0.08, 0.03));
    EXPECT_GT(answer.candidates.front().agreement.in_free, 0.1);
  }
}

TEST(PlaceRecogniser, AnotherRoomIsNotFound) {
  Rng rng(6);
  const PlaceMap map = room_map(rng);
  auto walls = box(0.0, 0.0, 7.3, 9.1);
  walls = both(both(walls, box(2.0, 5.0, 3.4, 5.8)), box(5.5, 1.0, 6.1, 2.6));
  for (int k = 0; k < 10; ++k) {
    const Pose2 pose{rng.uniform(1.0, 5.0), rng.uniform(1.5, 4.5), rng.uniform(-kPi, kPi)};
    const auto answer = PlaceRecogniser().locate(map, {seen_points(scan_at(walls, pose, 1.0, rng, kTwoPi))});
    EXPECT_NE(answer.verdict, PlaceVerdict::kUnique) << pose;
  }
}

TEST(PlaceRecogniser, AWindowKeepsTheSearchWhereTheRobotMayBe) {
  Rng rng(7);
  const auto walls = both(furnished_room(), shifted(furnished_room(), 14.0));
  auto poses = kViews;
  for (const Pose2& pose : shifted(kViews, 14.0)) {
    poses.push_back(pose);
  }
  const auto map = PlaceMap::build(seen_from(walls, poses, rng));
  ASSERT_TRUE(map);
  const Pose2 truth{17.0, 3.2, 0.7};
  const SearchWindow window{truth * Pose2{1.0, -0.8, 0.3}, 4.0, 0.5};
  const auto answer = PlaceRecogniser().locate(*map, {seen_points(scan_at(walls, truth, 1.0, rng, kTwoPi))}, window);
  EXPECT_EQ(answer.verdict, PlaceVerdict::kUnique) << answer.reason;
  EXPECT_THAT(answer.candidates.front().match.map_T_base, Pose2Near(truth, 0.05, 0.02));
}

TEST(PlaceRecogniser, ARobotThatHasNotMovedIsConfirmedByOneScanOfAMapOfOne) {
  Rng rng(11);
  const auto walls = both(furnished_room(), shifted(furnished_room(), 14.0));
  const Pose2 truth{2.5, 3.2, 0.7};
  const LaserScan seen = scan_at(walls, truth, 0.0, rng, kPi);
  const auto map = PlaceMap::build({transform(truth, seen_points(seen))});
  ASSERT_TRUE(map);
  const std::vector<SeenPoints> now{seen_points(scan_at(walls, truth, 1.0, rng, kPi))};
  const auto answer = PlaceRecogniser().confirm(*map, now, truth * Pose2{0.2, 0.1, -0.1});
  ASSERT_EQ(answer.verdict, PlaceVerdict::kUnique) << answer.reason;
  EXPECT_THAT(answer.candidates.front().match.map_T_base, Pose2Near(truth, 0.05, 0.02));
}

TEST(PlaceRecogniser, ARobotThatRotatedOnIsConfirmedNearby) {
  Rng rng(12);
  const PlaceMap map = room_map(rng);
  const Pose2 truth{2.5, 3.2, 0.7};
  const std::vector<SeenPoints> now{seen_points(scan_at(office(), truth, 1.0, rng, kPi))};
  const auto answer = PlaceRecogniser().confirm(map, now, truth * Pose2{0.5, 0.2, 0.9});
  ASSERT_EQ(answer.verdict, PlaceVerdict::kUnique) << answer.reason;
  EXPECT_THAT(answer.candidates.front().match.map_T_base, Pose2Near(truth, 0.05, 0.02));
}

TEST(PlaceRecogniser, ACorridorKeepsTheRobotWhereItStoodAndSaysHowWellThatIsKnown) {
  Rng rng(13);
  const auto walls = corridor();
  const PlaceMap map = corridor_map(rng);
  const Pose2 truth{20.0, 1.1, 0.1};
  const std::vector<SeenPoints> now{seen_points(scan_at(walls, truth, 1.0, rng, kTwoPi, 8.0))};
  const auto answer = PlaceRecogniser().confirm(map, now, truth);
  ASSERT_EQ(answer.verdict, PlaceVerdict::kUnique) << answer.reason;
  const MatchResult& match = answer.candidates.front().match;
  EXPECT_THAT(match.map_T_base, Pose2Near(truth, 0.3, 0.03));
  EXPECT_GT(match.covariance(0, 0), 10.0 * match.covariance(1, 1)) << "along against across";
  EXPECT_LT(match.covariance(0, 0), 0.3) << "no more than where it stood";
}

TEST(PlaceRecogniser, ARobotThatHasMovedALittleIsFoundAndOtherViewsMustSaySoToo) {
  Rng rng(16);
  const PlaceMap map = room_map(rng);
  const Pose2 truth{2.5, 3.6, 0.7};
  const std::vector<SeenPoints> now{seen_points(scan_at(office(), truth, 1.0, rng, kTwoPi))};
  const PlaceAnswer stands = PlaceRecogniser().confirm(map, now, truth);
  EXPECT_TRUE(stands.expected) << stands.reason;
  const PlaceAnswer moved = PlaceRecogniser().confirm(map, now, truth * Pose2{0.4, -0.3, 0.9});
  ASSERT_EQ(moved.verdict, PlaceVerdict::kUnique) << moved.reason;
  EXPECT_FALSE(moved.expected);
  EXPECT_THAT(moved.candidates.front().match.map_T_base, Pose2Near(truth, 0.05, 0.02));
}

TEST(PlaceRecogniser, ARobotThatWentOnIntoUnseenSpaceIsFoundAboutWhereItWas) {
  Rng rng(15);
  const Pose2 kept{1.5, 1.5, 0.8};
  const auto map = PlaceMap::build({transform(kept, seen_points(scan_at(office(), kept, 0.0, rng, kPi)))});
  ASSERT_TRUE(map);
  const Pose2 truth{3.0, 2.9, 2.2};
  const std::vector<SeenPoints> now{seen_points(scan_at(office(), truth, 1.0, rng, kTwoPi))};
  const auto answer = PlaceRecogniser().confirm(*map, now, kept);
  ASSERT_EQ(answer.verdict, PlaceVerdict::kUnique) << answer.reason;
  EXPECT_FALSE(answer.expected) << "other views must say so, too";
  EXPECT_THAT(answer.candidates.front().match.map_T_base, Pose2Near(truth, 0.05, 0.02));
}

TEST(PlaceRecogniser, ARobotThatWasCarriedAwayIsNotConfirmed) {
  Rng rng(14);
  const PlaceMap map = room_map(rng);
  for (const Pose2& elsewhere : {Pose2{8.3, 4.6, -2.0},
                                 Pose2{5.9, 2.0, 2.6},
                                 Pose2{1.2, 1.2, -2.6},
                                 {3.2, 3.0, 2.5},
                                 {7.0, 3.0, 0.7},
                                 {6.0, 1.5, 1.0},
                                 {3.0, 4.4, -1.0},
                                 {2.0, 3.0, -2.0}}) {
    const std::vector<SeenPoints> now{seen_points(scan_at(office(), elsewhere, 1.0, rng, kPi))};
    const auto answer = PlaceRecogniser().confirm(map, now, {2.5, 3.6, 0.7});
    EXPECT_FALSE(answer.expected) << elsewhere;
    if (answer.verdict == PlaceVerdict::kUnique) {
      EXPECT_THAT(answer.candidates.front().match.map_T_base, Pose2Near(elsewhere, 0.05, 0.02))
          << "it went on a little";
    }
  }
}

TEST(PlaceRecogniser, NothingSeenIsNoPlace) {
  Rng rng(8);
  const PlaceMap map = room_map(rng);
  EXPECT_EQ(PlaceRecogniser().locate(map, {}).verdict, PlaceVerdict::kNone);
  EXPECT_EQ(PlaceRecogniser().locate(map, {SeenPoints{}}).verdict, PlaceVerdict::kNone);
  EXPECT_FALSE(PlaceMap::build({}));
}

TEST(MapAgreement, BeamsThroughAWallAndPointsInTheOpenAreCounted) {
  Rng rng(9);
  const PlaceMap map = room_map(rng);
  const Pose2 truth{3.0, 3.0, 0.0};
  const SeenPoints seen = seen_points(scan_at(office(), truth, 1.0, rng, kTwoPi));
  const Agreement right = agreement_of(map.pyramid(), map.free_space(), {seen}, truth);
  EXPECT_LT(right.disagreement(), 0.02);
  // One metre to the left: beams to the left go through the wall, those to the right end in the room.
  const Agreement wrong = agreement_of(map.pyramid(), map.free_space(), {seen}, {3.0, 4.5, 0.0});
  EXPECT_GT(wrong.through, 0.2);
  EXPECT_GT(wrong.in_free, 0.1);
  EXPECT_EQ(agreement_of(map.pyramid(), map.free_space(), {}, truth).disagreement(), 0.0);
  const Fit fit = fit_of(map.pyramid(), map.free_space(), seen.points, truth);
  EXPECT_GT(fit.all, 0.8);
  EXPECT_LT(fit_of(map.pyramid(), map.free_space(), seen.points, {3.0, 4.5, 0.0}).all, 0.6);
}

TEST(MapAgreement, FreeIsWhereBeamsWentAndSolidIsWhereTheyEnded) {
  Rng rng(10);
  const PlaceMap map = room_map(rng);
  EXPECT_TRUE(map.free_space().is_free({3.0, 3.0}));
  EXPECT_FALSE(map.free_space().is_solid({3.0, 3.0}));
  EXPECT_FALSE(map.free_space().is_free({0.0, 3.0}));
  EXPECT_FALSE(map.free_space().is_free({-5.0, 3.0}));
  EXPECT_FALSE(map.free_space().is_free({500.0, 3.0}));
  int solid = 0;
  for (double y = 0.5; y < 5.5; y += 0.1) {
    solid += map.free_space().is_solid({0.0, y}) || map.free_space().is_solid({-0.05, y}) ? 1 : 0;
  }
  EXPECT_GT(solid, 40);
}

}  // namespace
}  // namespace seeker::slam
