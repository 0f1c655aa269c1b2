#include "server/fleet/picture_pairs.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "server/fleet/map_merger.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/fleet/toy_pictures.hpp"

namespace seeker::fleet {
namespace {

using testing::Pose2Near;

/// A robot that has driven along the corners, with pictures or without.
struct Driven {
  Driven(const std::vector<Wall>& walls, const std::vector<Point2>& corners, std::uint64_t seed)
      : world_T_base(drive(corners)), line_map(toy_map(walls, world_T_base, seed)), map(prepared(line_map)) {}

  void take_pictures(const std::vector<ToyMark>& marks) {
    map.set_pictures(toy_pictures(line_map, world_T_base, marks));
  }
  /// Where the map of another robot truly lies in the map of this one.
  [[nodiscard]] Pose2 truth(const Driven& other) const {
    return inverse(world_T_base.front()) * other.world_T_base.front();
  }

  std::vector<Pose2> world_T_base;
  LineMap line_map;
  PreparedMap map;
};

std::string figures_of(const MergeAnswer& answer) {
  std::ostringstream text;
  text << to_string(answer.verdict) << ", " << answer.reason << '\n';
  for (const MergeHypothesis& h : answer.hypotheses) {
    text << h.a_T_b.a_T_b << ": " << h.pairs.size() << " pairs, " << h.shared_wall_m << " m shared, " << h.weak_wall_m
         << " m across, " << h.contradiction << " denied, alike " << h.pictures.alike << ", unlike "
         << h.pictures.unlike << '\n';
  }
  for (const RejectedPair& pair : answer.rejected) {
    text << (pair.by_pictures ? "pictures" : "scans") << " of " << pair.node_a << " and " << pair.node_b << ": "
         << pair.reason << '\n';
  }
  return text.str();
}

/// Marks look alike from any side here, so that only places near each other may count as similar.
PictureParams near_only() {
  PictureParams params;
  params.views.min_share = 0.6;
  return params;
}

MergeAnswer merge(PreparedMap& a, PreparedMap& b, MergeMethod method = MergeMethod::kPicturesAndLaser) {
  MergeParams params;
  params.method = method;
  params.pictures = near_only();
  return MapMerger(params).merge(a, b);
}

const std::vector<Point2> kBothCorridors{{10.0, 1.0},  {19.0, 1.0},  {-1.0, 1.0},
                                         {-1.0, 11.0}, {19.0, 11.0}, {1.0, 11.0}};

TEST(PicturePairs, ProposeThePoseOfTheOtherRobotAtEachPlaceThatBothHaveSeen) {
  const auto walls = office(1);
  const auto marks = marks_on(walls, 1);
  Driven a(walls, {{1.0, 6.0}, {14.0, 6.0}}, 11);
  Driven b(walls, {{23.0, 6.0}, {8.0, 5.9}}, 12);
  a.take_pictures(marks);
  b.take_pictures(marks);
  const PictureParams params = near_only();
  const PicturePairs pairs(a.map, b.map, params);
  ASSERT_FALSE(pairs.proposals().empty());
  for (const PicturePair& pair : pairs.proposals()) {
    const Pose2 map_a_T_b = pair.map_a_T_base_b() * inverse(pair.b.map_T_base);
    EXPECT_LT(std::abs(wrap_angle(map_a_T_b.theta_rad - a.truth(b).theta_rad)), 0.35);
    EXPECT_LT(distance_m(pair.map_a_T_base_b(), a.truth(b) * pair.b.map_T_base), 3.0);
  }
  const auto at = [&](const Pose2& a_T_b) {
    return [&, a_T_b](std::size_t node) { return a_T_b * b.map.nodes()[node].map_T_node; };
  };
  EXPECT_TRUE(pairs.evidence(at(a.truth(b))).confirms(params));
  // Pictures that were taken up to 3 m apart are similar here, and count as alike within 2 m of where they should be.
  const Pose2 elsewhere = a.truth(b) * Pose2{8.0, 0.0, 0.0};
  EXPECT_TRUE(pairs.evidence(at(elsewhere)).denies(params));
  PictureParams strict = params;
  strict.min_features = 1000;
  const PicturePairs bare(a.map, b.map, strict);
  EXPECT_EQ(bare.evidence(at(elsewhere)).unlike, 0U) << "pictures that show little deny nothing";
}

TEST(PicturePairs, AreComparedOnceWhileMapsGrow) {
  const auto walls = office(1);
  const auto marks = marks_on(walls, 1);
  Driven a(walls, {{1.0, 6.0}, {8.0, 6.0}}, 11);
  Driven b(walls, {{12.0, 6.0}, {6.0, 6.0}}, 12);
  a.take_pictures(marks);
  b.take_pictures(marks);
  const PicturePairs first(a.map, b.map, {});
  EXPECT_EQ(a.map.picture_comparisons().size(), a.map.pictures().size() * b.map.pictures().size());
  a.map.set_pictures({a.map.pictures().front()});
  EXPECT_EQ(a.map.picture_comparisons().size(), b.map.pictures().size()) << "what was dropped is forgotten";
}

TEST(MergeByPictures, TellsWhichOfTwoEqualCorridorsIsMeant) {
  const auto walls = twin_corridors();
  const auto marks = marks_on(walls, 1);
  for (const double y : {1.0, 11.0}) {
    Driven both(walls, kBothCorridors, 11);
    Driven one(walls, {{3.0, y}, {19.0, y}, {2.0, y}}, 12);
    EXPECT_FALSE(merge(both.map, one.map).merged());
    both.take_pictures(marks);
    one.take_pictures(marks);
    const MergeAnswer answer = merge(both.map, one.map);
    ASSERT_FALSE(answer.hypotheses.empty());
    EXPECT_GE(answer.hypotheses.front().pictures.alike, 2U) << figures_of(answer);
    EXPECT_THAT(answer.hypotheses.front().a_T_b.a_T_b, Pose2Near(both.truth(one), 0.3, 0.03)) << figures_of(answer);
  }
}

TEST(MergeByPictures, ProposeTheRightPlaceWhereScansHaveTooLittleInCommon) {
  constexpr int kBuildings = 20;
  int by_scans = 0;
  int by_pictures = 0;
  int undecided = 0;
  for (std::uint64_t building = 1; building <= kBuildings; ++building) {
    const auto walls = office(building);
    const auto marks = marks_on(walls, building);
    Driven a(walls, {{1.0, 6.0}, {9.0, 6.0}}, 11);
    Driven b(walls, {{13.0, 6.0}, {7.0, 6.0}}, 12);
    by_scans += merge(a.map, b.map).merged() ? 1 : 0;
    a.take_pictures(marks);
    b.take_pictures(marks);
    const MergeAnswer answer = merge(a.map, b.map);
    undecided += answer.verdict == MergeVerdict::kInsufficientOverlap ? 1 : 0;
    if (answer.merged() || answer.verdict == MergeVerdict::kAmbiguous) {
      by_pictures += answer.merged() ? 1 : 0;
      EXPECT_THAT(answer.hypotheses.front().a_T_b.a_T_b, Pose2Near(a.truth(b), 0.3, 0.03)) << figures_of(answer);
    }
  }
  EXPECT_GT(by_pictures, by_scans);
  EXPECT_EQ(undecided, 0);
}

/// The second robot believes to have seen at its start what the first one saw at its own.
void inject_false_pair(const Driven& a, Driven& b) {
  NodePictures pictures = b.map.pictures();
  NodePicture copied = *pictures.front();
  copied.features = a.map.pictures().front()->features;
  pictures.push_back(std::make_shared<const NodePicture>(copied));
  b.map.set_pictures(pictures);
}

TEST(MergeByPictures, RefusesAFalsePairAndGoesOnWithTheNextOne) {
  const auto walls = office(1);
  const auto marks = marks_on(walls, 1);
  Driven a(walls, {{1.0, 6.0}, {14.0, 6.0}, {2.0, 6.2}}, 11);
  Driven b(walls, {{23.0, 6.0}, {8.0, 5.9}, {20.0, 6.0}}, 12);
  a.take_pictures(marks);
  b.take_pictures(marks);
  inject_false_pair(a, b);
  const MergeAnswer answer = merge(a.map, b.map);
  ASSERT_TRUE(answer.merged()) << figures_of(answer);
  EXPECT_THAT(answer.hypotheses.front().a_T_b.a_T_b, Pose2Near(a.truth(b), 0.3, 0.03)) << figures_of(answer);
  EXPECT_TRUE(std::any_of(answer.rejected.begin(), answer.rejected.end(),
                          [](const RejectedPair& pair) { return pair.by_pictures; }));
}

TEST(MergeByPictures, AsPrintedTheFirstPairMergesOnWhichIcpAndEq7Agree) {
  const auto walls = office(1);
  const auto marks = marks_on(walls, 1);
  Driven a(walls, {{1.0, 6.0}, {14.0, 6.0}}, 11);
  Driven b(walls, {{8.0, 6.0}, {22.0, 6.0}}, 12);
  EXPECT_EQ(merge(a.map, b.map, MergeMethod::kPrinted).verdict, MergeVerdict::kInsufficientOverlap);
  a.take_pictures(marks);
  b.take_pictures(marks);
  const MergeAnswer answer = merge(a.map, b.map, MergeMethod::kPrinted);
  ASSERT_TRUE(answer.merged()) << figures_of(answer);
  EXPECT_EQ(answer.hypotheses.front().pairs.size(), 1U);
  EXPECT_THAT(answer.hypotheses.front().a_T_b.a_T_b, Pose2Near(a.truth(b), 0.3, 0.03)) << figures_of(answer);
}

TEST(MergeByPictures, DoesNotMergeBuildingsWithTheSameWallpaper) {
  const auto marks = marks_on(office(1), 1);
  Driven a(office(1), {{1.0, 6.0}, {14.0, 6.0}, {2.0, 6.2}}, 11);
  Driven b(office(11), {{23.0, 6.0}, {8.0, 5.9}, {20.0, 6.0}}, 12);
  a.take_pictures(marks);
  b.take_pictures(marks);
  EXPECT_FALSE(merge(a.map, b.map).merged());
}

}  // namespace
}  // namespace seeker::fleet
